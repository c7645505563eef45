"""Looking: how trunk, head and eyes share a turn toward something, and what the eyes make of all there is to look at.

It knows targets as places in the figure's frame. When to look it is told as phases; of pegs and plans it knows nothing.
"""
