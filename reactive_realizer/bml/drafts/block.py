"""What the drafts wrote otherwise at a block."""

import re
from typing import Final

from reactive_realizer.bml.names import CONTINUOUS
from reactive_realizer.bml.trees import Tree

_START: Final = re.compile(r"([^\s:]+):(relax|end)")
_AFTER: Final = {"relax": "chunkAfter", "end": "appendAfter"}


def modernize_block(tree: Tree) -> None:
    """Rewrite the attributes of a block of a draft, or of a use of a procedure, as BML 1.0 and BMLA, in place.

    ``scheduling`` is its composition; a start at the relax or the end of another block (thesis 12.1.3) is chunkAfter or
    appendAfter.
    """
    if "scheduling" in tree.attrib and "composition" not in tree.attrib:
        tree.set("composition", str(tree.attrib.pop("scheduling")))
    start = _START.fullmatch(tree.get("start", "").strip())
    if start is not None:
        del tree.attrib["start"]
        spellings = [f"{{{namespace}}}{_AFTER[start[2]]}" for namespace in CONTINUOUS]
        after = next((name for name in spellings if name in tree.attrib), spellings[0])
        tree.set(after, ",".join(filter(None, [tree.get(after), start[1]])))
