"""How fast it is: each module measures one thing, and ``python -m benchmarks`` runs it by the module's name.

A module has ``measure()``, which returns numbers (None where one could not be taken) under fixed names, nested or not,
and ``AIMS``, what some of them are to stay below, by their dotted names. It measures medians of several runs.
"""
