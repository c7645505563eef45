"""The kinds of motions that a binding may name: for each, its `MotionUnit` and the maker that reads its parameters.

Motions know the figure that they are made for. They do not know pegs; the unit that plays them sets their phase.
"""
