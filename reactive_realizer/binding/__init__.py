"""From a BML behavior to what plays it: tables that a user edits without programming (thesis 8.6.1).

This room reads data files and answers which unit fits a behavior's type and attributes. It knows neither engines nor
how a unit moves anything.
"""
