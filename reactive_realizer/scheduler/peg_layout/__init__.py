"""From the times of a plan to pegs: what hangs on what, so that it stays a plan when times from outside move.

Points at fixed offsets from each other share a *root*; between roots lie *edges*, the phases of behaviors; for each
root a *rule* says what its peg hangs on.
"""
