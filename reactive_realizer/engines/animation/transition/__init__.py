"""Transitions: from where some joints are to where the motions after them find them (thesis 4.2.4).

The room knows how bodies move, and nothing of files.
"""
