"""What arms and hands do: gestures with their phases, and pointing, which finds its own way to each target.

It knows procedural animations, and the body at rest. When to move it is told as phases; of legs and gaze it knows
nothing.
"""
