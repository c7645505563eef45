"""Anticipators: each module has a model that predicts the times of events.

This package knows the peg board, cells and the clock's units; the realizer finds it by its entry points.
"""
