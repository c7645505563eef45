"""The running whole: one board, one ticker, one task an engine, for all characters.

The room knows engines by their interface and characters as they are handed in; it knows no file and no wire.
"""
