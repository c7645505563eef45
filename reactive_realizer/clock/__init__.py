"""What time it is, and when to look: seconds with a frame of reference, clocks, ticks.

Nothing outside this room asks the machine what time it is; everybody else gets time as an argument.
"""
