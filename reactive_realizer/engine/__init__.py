"""The common parts of all modalities: an Engine has a planner, a plan and a `Player`, and runs as one asyncio task.

This package knows units and pegs, but no modality and no block state.
"""
