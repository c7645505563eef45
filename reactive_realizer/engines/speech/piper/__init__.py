"""Piper voices: files that the user provides, one network each, with the pronunciation of espeak-ng."""
