"""What arms and hands do: gestures with their phases, and how a wrist gets to its place."""
