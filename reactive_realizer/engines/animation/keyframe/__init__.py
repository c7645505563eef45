"""Keyframes and motion captures: poses at times, from files or from BML (thesis 2.2.2 and C.1.2).

This package reads files, retargets captures and interpolates poses. It does not know behaviors or pegs.
"""
