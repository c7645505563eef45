"""Kokoro-82M, a natural voice: a neural network in a worker process, with the pronunciation of espeak-ng."""
