"""Maps BML behaviors to the units that play them, using tables that a user can edit without programming (thesis 8.6.1).

This package reads data files and answers which unit fits the type and attributes of a behavior. It does not know
engines, or how a unit moves anything.
"""
