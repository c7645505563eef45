"""Reads face bindings in AsapRealizer's format (thesis 8.6.1): which face unit plays which behavior."""

from dataclasses import dataclass
from pathlib import Path

from reactive_realizer.binding.spec_reader import read_specs
from reactive_realizer.binding.unit_specs import UnitSpecs
from reactive_realizer.file_cache import remembered


@dataclass(frozen=True, slots=True)
class FaceBinding(UnitSpecs):
    """The entries of one or more face bindings, in order."""

    @staticmethod
    @remembered
    def read(*paths: Path) -> "FaceBinding":
        """Read binding files. Entries of earlier files come first.

        Raises:
            RealizerError: "bad-asset", with file, line and element.
            OSError: a file cannot be read.
        """
        return FaceBinding(tuple(spec for path in paths for spec in read_specs(path, "facebinding", "FaceUnit")))
