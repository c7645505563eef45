"""The language: reads BML into frozen `BehaviorBlock`s and `Problem`s.

This package knows only the document. It does not import pegs, clocks or engines.
"""
