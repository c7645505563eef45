"""Faults of human files, plug-ins and asset names."""

from reactive_realizer.errors import CreationFault, Fault


class BadHumanFile(Fault):
    """A key of a human file that is missing, unknown or has a bad value."""

    code = "bad-human-file"
    template = "{file}: {key}: {reason}"
    file: str
    key: str
    reason: str


class NoCharacter(Fault):
    """A human file has no character with the id."""

    code = "no-character"
    template = "{file} has no character '{name}'; available: {known}"
    unknown = "name"
    file: str
    name: str
    known: tuple[str, ...]


class NoPlugin(Fault):
    """No plug-in of a group has the name."""

    code = "no-plugin"
    template = "the plug-in group {group} has no '{name}'; available: {known}"
    unknown = "name"
    group: str
    name: str
    known: tuple[str, ...]


class BrokenPlugin(Fault):
    """A plug-in that cannot be imported, or is not what its group contains."""

    code = "broken-plugin"
    template = "'{name}' in the plug-in group {group} cannot be used: {source}: {reason}"
    group: str
    name: str
    source: str
    reason: str


class NoFolder(Fault):
    """A folder of assets that does not exist."""

    code = "no-folder"
    template = "there is no folder {folder}"
    folder: str


class ForbiddenPath(CreationFault):
    """A name that would lead out of the asset folders."""

    code = "forbidden-path"
    template = "'{name}' is not a valid asset name: it must be a relative path inside the asset folders"
    name: str


class TwoAssets(CreationFault):
    """A name that several files have."""

    code = "two-assets"
    template = "several assets are named '{name}': {known}; name more of the path"
    name: str
    known: tuple[str, ...]
