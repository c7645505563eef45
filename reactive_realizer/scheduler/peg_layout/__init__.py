"""From the times of a plan to pegs: what each peg depends on, so that the plan holds when times from outside move.

Points at fixed offsets from each other share a *root*; between roots lie *edges*, the phases of behaviors; for each
root a *rule* says what its peg depends on.
"""
