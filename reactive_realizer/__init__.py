"""A BML realizer whose time is reactive."""

__version__ = "0.1.0"
