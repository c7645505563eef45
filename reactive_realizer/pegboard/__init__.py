"""The peg board: time pegs, which are points in time that depend on each other (thesis 7.3).

This package knows cells and seconds. It does not know BML, behaviors or engines.
"""
