"""Benchmarks: each module measures one thing, and ``python -m benchmarks NAME`` runs it.

A module has ``measure()``, which returns medians of several runs under fixed names, nested or not (None for a number
that could not be measured), and ``AIMS``, upper limits for some of them by their dotted names.
"""
