"""From a document to its blocks."""

from collections.abc import Iterator
from itertools import islice

from reactive_realizer.bml.block import Parsed, Problem
from reactive_realizer.bml.block_reader import BlockReader
from reactive_realizer.bml.decode import decode
from reactive_realizer.bml.names import BLOCK
from reactive_realizer.bml.root_reader import read_roots
from reactive_realizer.errors import RealizerError, error
from reactive_realizer.limits import Limits


def parse(text: str | bytes, limits: Limits) -> list[Parsed]:
    """Reads BML 1.0, and documents without a namespace as if it were theirs.

    A document may hold several blocks; comments, processing instructions and XML declarations may stand before and
    between them. Each block, and each thing that is none, has its entry in the answer, in document order, which is
    never empty. Nothing raises.

    Args:
        text: the document.
        limits: what is too much.
    """
    try:
        parsed = list(islice(_read(text, limits), limits.blocks_alive + 1))
    except RealizerError as refused:
        return [_refused(refused)]
    if len(parsed) > limits.blocks_alive:
        parsed[-1] = _refused(error("too-many-roots", limit=limits.blocks_alive))
    return parsed or [_refused(error("no-block", line=1, column=1))]


def _read(text: str | bytes, limits: Limits) -> Iterator[Parsed]:
    size = len(text) if isinstance(text, bytes) else len(text.encode("utf-8", "surrogatepass"))
    if size > limits.bml_bytes:
        raise error("too-many-bytes", size=size, limit=limits.bml_bytes, line=1, column=1)
    for root in read_roots(text if isinstance(text, str) else decode(text), limits):
        yield Parsed(None, (root,)) if isinstance(root, Problem) else BlockReader(root, limits).read()


def _refused(refused: RealizerError) -> Parsed:
    return Parsed(None, (Problem(refused.fault, BLOCK),))
