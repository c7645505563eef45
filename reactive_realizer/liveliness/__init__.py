"""Liveliness: how a speaker's head, face, eyes and hands accompany the words, as an added planner would have them.

It also holds the floor with fillers. Nothing here moves a joint: it sends ordinary BML in blocks that give way to those
of the speaker.
"""
