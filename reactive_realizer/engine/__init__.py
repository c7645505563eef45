"""The common parts of all modalities: an Engine has a planner, a plan and a `Player`, and runs as one asyncio task.

This package knows units and pegs. It does not know modalities or the states of blocks.
"""
