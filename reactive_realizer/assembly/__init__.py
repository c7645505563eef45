"""Assembles a scene from a human file, plug-ins and assets.

Only this room uses names of files and plug-ins.
"""
