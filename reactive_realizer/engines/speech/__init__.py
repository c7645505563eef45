"""Speech: turns a text into an utterance with the times of its words, marks and phonemes, and phonemes into visemes.

espeak-ng runs in a worker process only, which isolates its license, its crashes and its global state. Visemes are pure
functions of time; the face engine applies them.
"""
