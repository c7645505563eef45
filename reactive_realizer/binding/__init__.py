"""Maps BML behaviors to the units that play them, using tables that a user can edit without programming (thesis 8.6.1).

This package reads the files of bindings, and finds the units that fit the type and attributes of a behavior. It does
not know engines, or how units move the body.
"""
