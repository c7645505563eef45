"""What the body does: gestures, head movements, gaze, breath, and the way back to rest.

Motion here is a function of phase (0..1), parameters and body; which phase it is when, the pegs say. Per-frame motion
is plain floats and tuples; arrays begin where a pose becomes a frame (docs/design.md).
"""
