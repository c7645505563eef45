"""The strategy `convex`: phase durations by a convex problem, starts by longest paths.

A block becomes *spans* (phases with a cost), *groups* of points at fixed offsets from each other (one variable each)
and inequalities between these. The strategy knows points, constraints and preferences, and nothing of modalities.
"""
