"""Lip-sync: from the phonemes of an utterance to the mouth of an avatar, as weights of its morph targets over time.

A binding says which mouth shape (viseme) each sound has on an avatar. Sounds that lie close together shape each other
(co-articulation, by dominance functions), except where lips or teeth must touch.
"""
