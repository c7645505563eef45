"""Procedural animation: joints and limbs that follow formulas of phase and parameters (thesis 4.2.1).

The room reads its files and plays them; it does not know behaviors or pegs.
"""
