"""What every modality is made of: an Engine is a Planner, a plan and a Player, and runs as one asyncio task.

The room knows units and pegs; it knows no modality and no block state.
"""
