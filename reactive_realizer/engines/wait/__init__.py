"""Doing nothing for a while."""
