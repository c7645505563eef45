"""The language, as frozen data: BML in, `BehaviorBlock`s and `Problem`s out.

This room knows what was written and where. It knows no pegs, no clock, no engines: when things happen and who does
them is decided above.
"""
