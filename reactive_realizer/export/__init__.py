"""Writes what was played into files of other tools: motion, annotations and pictures."""
