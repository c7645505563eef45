"""Changing a parameter of a behavior along a trajectory. It is not known here who follows it."""
