"""The names that mean something in one block."""

from collections import defaultdict
from collections.abc import Iterator
from dataclasses import replace
from functools import partial
from itertools import count

from reactive_realizer.bml.drafts.spelling import SYNC_POINTS
from reactive_realizer.bml.names import ANTICIPATORS, BML, BML_EXT
from reactive_realizer.bml.sync_ref import SyncRef
from reactive_realizer.bml.trees import Tree, name_of, namespace_of
from reactive_realizer.errors import error
from reactive_realizer.limits import Limits


class BlockNames:
    """Knows the ids of a block, its behaviors and its marks before any of them is read.

    Attributes:
        draft: whether it is of before BML 1.0, where sync points are spelled otherwise.
        external: whether references may name behaviors of other blocks.
    """

    def __init__(self, block: Tree) -> None:
        self.draft = namespace_of(block) not in {BML, BML_EXT}
        self.external = True
        self._block = block.get("id", "").strip()
        self._behaviors = {id_.strip() for each in _behaviors_in(block) if (id_ := each.get("id"))}
        self._marks = frozenset(id_ for mark in block.iter("{*}sync", "{*}tm") if (id_ := mark.get("id")))
        self._numbers: defaultdict[str, Iterator[int]] = defaultdict(partial(count, 1))

    def give(self, behavior: Tree) -> None:
        """Give a behavior the first free id of its element: activate1."""
        element = name_of(behavior)
        ids = (f"{element}{number}" for number in self._numbers[element])
        free = next(id_ for id_ in ids if id_ not in self._behaviors)
        behavior.set("id", free)
        self._behaviors.add(free)

    def ref(self, text: str, limits: Limits) -> SyncRef:
        """What a reference names here.

        Raises:
            RealizerError: it is none, or a draft does not say that it may name a behavior of another block.
        """
        ref = SyncRef.parse(text, limits, self._marks).read_in(self._block, self._behaviors)
        if self.draft and ref.sync not in self._marks:
            ref = replace(ref, sync=SYNC_POINTS.get(ref.sync or "", ref.sync))
        outside = ref.behavior is not None and ref.block not in {None, self._block, ANTICIPATORS}
        if outside and not self.external:
            raise error("external-reference")
        return ref


def _behaviors_in(block: Tree) -> Iterator[Tree]:
    """Those that can be read and those that cannot: neither is another block."""
    holders = [block, *block.iter("{*}required")]
    return (child for holder in holders for child in holder if name_of(child) not in {"constraint", "required"})
