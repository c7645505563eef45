"""Speech: text becomes an utterance with the times of its words, marks and phonemes; phonemes become mouth shapes.

Every voice gives the same frozen `Utterance`. espeak-ng is reached only through a worker process, so that its license,
its crashes and its global state stay outside. The mouth shapes are pure functions of time; who moves a face with them
is not known here.
"""
