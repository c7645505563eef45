"""Voices of Piper: files of the user, one network each, with the pronunciation of espeak-ng."""
