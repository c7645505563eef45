"""What the drafts spell otherwise wherever it stands."""

from collections.abc import Mapping
from types import MappingProxyType
from typing import Final

SYNC_POINTS: Final[Mapping[str, str]] = MappingProxyType({"stroke_start": "strokeStart", "stroke_end": "strokeEnd"})
"""Sync points: a draft's name to that of BML 1.0."""
