"""Assembles a scene from a human file, plug-ins and assets.

Only this package resolves names of files and plug-ins.
"""
