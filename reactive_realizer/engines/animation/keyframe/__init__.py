"""Motion as it was keyed or captured: poses at times, from files or from BML itself (thesis 2.2.2 and C.1.2).

The room reads its files and plays them. Its maker and its unit know the behavior that is played; all else knows neither
behaviors nor pegs.
"""
