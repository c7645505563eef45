"""A scene from its specification: the human file, the registries of plug-ins, assets, and what they make together.

Only this room knows names of files and of plug-ins; nothing below does.
"""
