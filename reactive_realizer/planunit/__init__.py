"""Plan units: behaviors in a plan, with sync points on pegs and a preferred timing, in any modality.

This package knows pegs and BML descriptions, but no engines and no scheduler.
"""
