"""Shared by the tests of contracts."""

import pytest


def broken(contract: type, test: str, *arguments: object) -> None:
    """Runs one test of a contract, and expects it to fail."""
    with pytest.raises((AssertionError, ArithmeticError, KeyError)):
        getattr(contract(), test)(*arguments)
