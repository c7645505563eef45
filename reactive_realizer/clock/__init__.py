"""Time: seconds with a frame of reference, clocks and ticks.

Only this package reads the machine's clock; all other code gets the time as an argument.
"""
