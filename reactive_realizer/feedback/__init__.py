"""The messages of BML 1.0 feedback as data and as XML, their order within a tick, and their delivery.

The room knows block and behavior ids and times; it knows no peg, no unit and no wire.
"""
