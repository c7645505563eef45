"""Writes docs/errors.md from the faults that the packages define."""

from collections.abc import Iterable
from importlib import import_module
from itertools import groupby
from pathlib import Path
from pkgutil import walk_packages

import anticipators
import reactive_realizer
from reactive_realizer.errors import FAULTS, Fault
from reactive_realizer.server.statuses import CLOSE_CODES, STATUSES

PAGE = Path(__file__).with_name("errors.md")

_HEAD = """\
# Errors

Each rejection, warning and failure has a code, which does not change, and a sentence, in which the words in braces are
filled in. [Plug-ins](plugins.md#a-fault) can add their own. `make docs` generates this page from the subclasses of
`Fault`; the packages of the code define them. A sentence about an unknown name ends with the nearest known one, if one
is near: *did you mean 'BEAT'?*

The column *warning* is the `type` of the `<warningFeedback>`, *HTTP* is the status of the answer to a request if it is
not 400, and *close* is the code with which the socket is closed. A row with none of these appears on stderr, in an
`error` message of the socket, or as the reason inside another sentence.
"""

_TABLE = """
## {title}

| code | sentence | warning | HTTP | close |
|---|---|---|---|---|
"""

_TITLES = {
    "errors": "Common",
    "bml": "Reading BML",
    "pegboard": "Pegs and predictions",
    "embodiment": "Avatars and poses",
    "binding": "Bindings and assets",
    "planunit": "Plan units",
    "physics": "Controllers",
    "engine": "Engines",
    "engines": "Behaviors",
    "scheduler": "Scheduling",
    "liveliness": "Liveliness",
    "realizer": "Running and replaying a session",
    "assembly": "Assembling a scene",
    "server": "The server",
    "export": "Using a performance elsewhere",
    "client": "Clients",
    "bridges": "Bridges",
    "conformance": "Conformance",
    "cli": "The command line",
    "anticipators": "Anticipators",
}
"""Titles of the sections by the package that defines the faults, in the order of the page."""

_STATUS_OF = {kind.code: status.value for status, kinds in STATUSES.items() for kind in kinds}
_CLOSE_CODE_OF = {kind.code: code.value for kind, code in CLOSE_CODES.items()}


def page() -> str:
    """The page as Markdown."""
    for package in (anticipators, reactive_realizer):
        for module in walk_packages(package.__path__, f"{package.__name__}."):
            if not module.name.endswith("__main__"):
                import_module(module.name)
    order = list(_TITLES)
    own = (kind for kind in FAULTS.values() if _is_own(kind))
    faults = sorted(own, key=lambda kind: (order.index(_package(kind)), kind.__module__))
    return _HEAD + "".join(_section(package, kinds) for package, kinds in groupby(faults, _package))


def _section(package: str, kinds: Iterable[type[Fault]]) -> str:
    return _TABLE.format(title=_TITLES[package]) + "".join(map(_row, kinds))


def _is_own(kind: type[Fault]) -> bool:
    return kind.__module__.startswith(("reactive_realizer.", "anticipators."))


def _package(kind: type[Fault]) -> str:
    top, package, *_ = kind.__module__.split(".")
    return top if top == "anticipators" else package


def _row(kind: type[Fault]) -> str:
    shown = (kind.warning, _STATUS_OF.get(kind.code), _CLOSE_CODE_OF.get(kind.code))
    cells = (f"`{kind.code}`", _escaped(kind.template), *("" if value is None else str(value) for value in shown))
    return f"| {' | '.join(cells)} |\n"


def _escaped(sentence: str) -> str:
    """Escapes angle brackets, which Markdown reads as HTML, and bars, which separate cells."""
    return sentence.replace("<", "&lt;").replace(">", "&gt;").replace("|", "\\|")


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
