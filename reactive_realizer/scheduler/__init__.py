"""When things happen: from the constraints of a block to pegs, and from the states of blocks to starts and ends.

The room knows engines by their interface only, and nothing of what they play.
"""
