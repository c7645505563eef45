"""Anticipators: each module has a model that predicts the times of events.

This package depends only on the peg board, cells and the units of the clock. The realizer finds it by entry points.
"""
