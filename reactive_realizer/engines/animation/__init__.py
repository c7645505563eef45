"""Body animation: gestures, head movements, gaze, posture, and idle animation.

A motion is a function of phase (0 to 1), parameters and body; pegs determine its phase. Per-frame motion uses plain
floats and tuples; arrays start where a pose becomes a frame (docs/design.md).
"""
