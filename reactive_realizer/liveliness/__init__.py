"""Liveliness: how a speaker's head, face, eyes and hands accompany the words, as an added planner would have them.

Nothing here moves a joint: it sends ordinary BML in blocks that accompany those of the speaker.
"""
