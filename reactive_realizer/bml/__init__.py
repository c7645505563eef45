"""The language: reads BML into frozen `BehaviorBlock`s and `Problem`s.

This package knows the document only. It imports no pegs, no clock and no engines.
"""
