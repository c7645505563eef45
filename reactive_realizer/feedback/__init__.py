"""Who is told: the messages of BML 1.0 feedback as data and as XML, and their order within a tick.

The room knows block and behavior ids and times; it knows no peg, no unit and no wire.
"""
