"""The messages of BML 1.0 feedback as data and as XML, their order within a tick, and their delivery.

This package knows the ids of blocks and behaviors, and times. It does not know pegs, plan units or the network.
"""
