"""The strategy `convex`: phase durations by a convex problem, starts by longest paths.

A block becomes *roots* (points at fixed distances from each other, one unknown each), *spans* between them (phases with
a cost) and *rows* (inequalities). It knows points, ties and preferences, and nothing of modalities.
"""
