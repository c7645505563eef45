"""A BML realizer with reactive timing."""

__version__ = "0.1.0"
