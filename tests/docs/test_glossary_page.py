"""docs/glossary.md names classes that exist, in the modules that define them."""

import re

from .conftest import REPOSITORY, page

PACKAGE = REPOSITORY / "reactive_realizer"
ROW = re.compile(r"^\| ([^|]+) \| [^|]+ \| `([^|]*)` \|$", re.MULTILINE)


def test_every_class_of_the_glossary_is_defined_in_its_module() -> None:
    named = [(name, module) for term, module in ROW.findall(page("docs/glossary.md")) for name in classes(term)]
    assert len(named) > 20
    assert [(name, module) for name, module in named if not defines(module, name)] == []


def classes(term: str) -> list[str]:
    return re.findall(r"`([A-Z]\w+)`", term)


def defines(module: str, name: str) -> bool:
    text = (PACKAGE / module).read_text(encoding="utf-8")
    return re.search(rf"^(class {name}\b|{name} = )", text, re.MULTILINE) is not None
