"""Reads picture bindings in AsapRealizer's format: which pictures show which behavior."""

from dataclasses import dataclass
from pathlib import Path

from reactive_realizer.binding.spec_reader import read_specs
from reactive_realizer.binding.unit_specs import UnitSpecs
from reactive_realizer.file_cache import remembered


@dataclass(frozen=True, slots=True)
class PictureBinding(UnitSpecs):
    """The entries of one or more picture bindings, in order."""

    @staticmethod
    @remembered
    def read(*paths: Path) -> "PictureBinding":
        """Read binding files. Entries of earlier files come first.

        Raises:
            RealizerError: "bad-asset", with file, line and element.
            OSError: a file cannot be read.
        """
        return PictureBinding(
            tuple(spec for path in paths for spec in read_specs(path, "picturebinding", "PictureUnit"))
        )
