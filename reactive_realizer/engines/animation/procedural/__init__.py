"""Procedural animation: joints and limbs that follow formulas of phase and parameters (thesis 4.2.1).

This package reads and evaluates animation files. It does not know behaviors or pegs.
"""
