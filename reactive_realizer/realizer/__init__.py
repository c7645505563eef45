"""The realizer: one peg board, one ticker and one task per engine, for all characters.

This package knows engines by their interface and gets its characters; it knows no files and no network.
"""
