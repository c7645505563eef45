"""Procedural animation: joints and limbs that follow formulas of phase and parameters (thesis 4.2.1).

The room reads its files and plays them. Its maker reads what a behavior wants; all else knows neither behaviors nor
pegs.
"""
