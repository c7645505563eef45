"""When things happen, and what is tied to what: time pegs on one board.

The room knows cells and seconds; it knows no BML, no behavior and no engine.
"""
