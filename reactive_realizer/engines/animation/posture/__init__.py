"""Postures: how the figure stands, sits and lies, poses of arms and legs, and feet that stay in place.

This package reads posture files. Other motion of the body is known only as layers.
"""
