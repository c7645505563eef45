"""Fixtures that read BML."""

from collections.abc import Callable

import pytest

from reactive_realizer.bml.block import BehaviorBlock, Parsed
from reactive_realizer.bml.document import parse
from reactive_realizer.bml.names import BML, BML_EXT, BMLA, BMLT, MURML, OWN
from reactive_realizer.limits import Limits

Read = Callable[[str], Parsed]


@pytest.fixture
def read() -> Read:
    """Reads the content of a block b, with the prefixes ext, bmla, bmlt and rr declared."""

    def read_inside(inside: str) -> Parsed:
        (parsed,) = parse(
            f'<bml xmlns="{BML}" xmlns:ext="{BML_EXT}" xmlns:bmla="{BMLA}" xmlns:bmlt="{BMLT}" xmlns:rr="{OWN}" '
            f'xmlns:murml="{MURML}" id="b">'
            f"{inside}</bml>",
            Limits(),
        )
        return parsed

    return read_inside


@pytest.fixture
def block(read: Read) -> Callable[[str], BehaviorBlock]:
    """The block, which must have no problems."""

    def block_inside(inside: str) -> BehaviorBlock:
        parsed = read(inside)
        assert parsed.block is not None
        assert not parsed.problems
        assert not parsed.failed
        return parsed.block

    return block_inside
