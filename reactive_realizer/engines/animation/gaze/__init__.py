"""Gaze: how trunk, head and eyes share a turn toward a target, and how the eyes combine all gazes.

Targets are points in the figure's frame; phases say when to look. This package does not know pegs or plans.
"""
