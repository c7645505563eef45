"""Scheduling: turns the constraints of blocks into pegs, and takes blocks from their arrival to their end.

The package knows engines only by their interface.
"""
