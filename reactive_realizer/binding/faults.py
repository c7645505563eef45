"""Faults of asset files and bindings."""

from reactive_realizer.errors import CreationFault


class NoAsset(CreationFault):
    """No asset has the name, or any of several names."""

    code = "no-asset"
    template = "there is no asset named '{name}'"
    unknown = "files"
    name: str
    files: tuple[str, ...] = ()
    known: tuple[str, ...] = ()


class AssetTooBig(CreationFault):
    """A file over the size limit, in bytes."""

    code = "asset-too-big"
    template = "{file} is {size} bytes; the limit is {limit}"
    file: str
    size: int
    limit: int


class BadAsset(CreationFault):
    """A part of an asset file that cannot be used; ``row`` is its line."""

    code = "bad-asset"
    template = "{file}, line {row}, <{element}>: {reason}"
    file: str
    row: int | None
    element: str
    reason: str


class NotABoolean(CreationFault):
    """A value that is neither true nor false."""

    code = "not-a-flag"
    template = "{name}='{value}' must be true or false"
    name: str
    value: str


class NotInLibrary(CreationFault):
    """A library of gestures, movements or faces, one file for all of them, that has none with the name."""

    code = "not-in-library"
    template = "{file} has no {element} '{name}'; available: {known}"
    unknown = "name"
    file: str
    element: str
    name: str
    known: tuple[str, ...]
