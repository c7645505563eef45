"""Motion as it was keyed or captured: poses at times, from files or from BML itself (thesis 2.2.2 and C.1.2).

The room reads its files and plays them; it does not know behaviors' pegs or what else plays.
"""
