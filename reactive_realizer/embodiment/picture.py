"""Pictures that show a character in place of its body."""

from typing import Final, NamedTuple

PICTURE_SUFFIXES: Final = (".gif", ".jpeg", ".jpg", ".png", ".webp")


class Picture(NamedTuple):
    """A picture on a layer.

    Attributes:
        layer: pictures with a greater one cover others.
        file: its name among the assets.
    """

    layer: float
    file: str


def is_picture(file: str) -> bool:
    """Return whether the suffix of a file's name is that of a picture."""
    return file.lower().endswith(PICTURE_SUFFIXES)
