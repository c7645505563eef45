"""Scheduling: turns the constraints of blocks into pegs, and takes blocks from their arrival to their end.

The room knows engines by their interface, and nothing of what they play.
"""
