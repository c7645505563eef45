"""The realizer: one peg board, one ticker and one task per engine, for all characters.

This package knows engines by their interface, and receives assembled characters. It does not know files or the network.
"""
