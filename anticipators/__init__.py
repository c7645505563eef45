"""What predicts: each module is one model of when something is going to happen.

The package knows the peg board, cells and the clock's units; the realizer knows it by the names of its entry points.
"""
