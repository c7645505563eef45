"""Plan units: behaviors in a plan, with sync points on pegs and a preferred timing, in any modality.

This package knows pegs and the BML of behaviors. It does not know engines or the scheduler.
"""
