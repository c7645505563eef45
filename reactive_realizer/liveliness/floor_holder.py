"""Holds the floor: has a character say fillers after a speech that asks for them, until its next words arrive.

A speaker who needs time before the next words says so, lest others take the turn (H. H. Clark and J. E. Fox Tree,
"Using uh and um in spontaneous speaking", 2002), and looks away from the listener (A. Kendon, "Some functions of
gaze-direction in social interaction", 1967). The attribute is that of AsapRealizer's incremental speech.
"""

import logging
from collections.abc import Sequence
from random import Random
from typing import Final, NamedTuple
from xml.sax.saxutils import escape, quoteattr

from reactive_realizer.bml.document import parse
from reactive_realizer.bml.names import BML, BMLT
from reactive_realizer.bml.speech import VOICE, Speech
from reactive_realizer.bml.vocabulary import Composition
from reactive_realizer.clock.units import GlobalTime, is_due
from reactive_realizer.engine.effects import Reached
from reactive_realizer.engines.speech.speech_options import holds_floor
from reactive_realizer.limits import Limits
from reactive_realizer.liveliness.fillers import Fillers
from reactive_realizer.liveliness.listeners import Listeners
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.scheduler.bml_block import BMLBlock
from reactive_realizer.scheduler.bml_scheduler import BMLScheduler

logger = logging.getLogger(__name__)

_AWAY: Final = ("UPLEFT", "UPRIGHT", "LEFT", "RIGHT")
_ANGLE: Final = 13
"""How far the eyes look away from the listener, degrees."""


class _Spoken(NamedTuple):
    """A speech that asks for fillers and has been spoken, and when they begin, s."""

    unit: PlanUnit
    due: GlobalTime


class FloorHolder:
    """Sends a block of fillers a moment after a speech that asks for them, unless the character goes on by then.

    The character goes on when another speech of it begins, or when a block starts that comes after others (APPEND,
    REPLACE, appendAfter, chunkAfter) and says nothing. This ends the fillers too.

    Args:
        scheduler: of the blocks.
        listeners: of the characters.
        limits: on the blocks.
        fillers: what is said.
        voices: of the characters, by id; None for the default voice.
    """

    def __init__(
        self,
        scheduler: BMLScheduler,
        listeners: Listeners,
        limits: Limits,
        fillers: Fillers,
        voices: dict[str, str | None],
    ) -> None:
        self._scheduler = scheduler
        self._listeners = listeners
        self._limits = limits
        self._fillers = fillers
        self._voices = voices
        self._spoken: dict[str, _Spoken] = {}
        """By character."""
        self._holding: dict[str, str] = {}
        """The id of the block of fillers by character."""
        self._over: set[tuple[str, str]] = set()
        """Character and id of the blocks of fillers that are to end."""
        if fillers.most:
            scheduler.listen_to_points(self._follow)
            scheduler.listen_to_starts(self._follow_block)

    def advance(self, now: GlobalTime) -> None:
        """Begin a tick: end the fillers that are not needed any more, and send those that are due."""
        self._over = {each for each in self._over if not self._scheduler.withdraw(*each, now)}
        for character, spoken in list(self._spoken.items()):
            if is_due(spoken.due, now):
                del self._spoken[character]
                if not self._speaks_on(character):
                    self._send(spoken.unit)

    def _follow(self, reached: Sequence[Reached]) -> None:
        for unit, sync, time in [(each.unit, each.point.id, each.time) for each in reached]:
            if not isinstance(unit.behavior, Speech) or unit.accompanies:
                continue
            if sync == "start":
                self._go_on(unit.block.character)
            elif sync == "end" and holds_floor(unit.behavior):
                self._spoken[unit.block.character] = _Spoken(unit, GlobalTime(time + self._fillers.wait))

    def _follow_block(self, block: BMLBlock) -> None:
        description = block.description
        comes_after = description.append_after or description.chunk_after
        follows = bool(comes_after) or description.composition is not Composition.MERGE
        speaks = any(isinstance(behavior, Speech) for behavior in description.behaviors)
        if follows and not speaks and not block.gives_way:
            self._go_on(block.key.character)

    def _go_on(self, character: str) -> None:
        """Note that a character goes on: nothing is said instead."""
        self._spoken.pop(character, None)
        if (held := self._holding.pop(character, None)) is not None:
            self._over.add((character, held))

    def _speaks_on(self, character: str) -> bool:
        """Whether a character speaks, or will do so at a known time in a block that plays."""
        playing = (block for block in self._scheduler.blocks.of(character) if block.state.plays and not block.gives_way)
        speeches = (unit for block in playing for unit in block.live_units if isinstance(unit.behavior, Speech))
        return any(unit.time("start") is not None for unit in speeches)

    def _send(self, speech: PlanUnit) -> None:
        """Send a block of fillers, and of a look away that lasts as long."""
        character, block = speech.block
        id_ = f"{block}.{speech.behavior.id}.filler"
        text = self._block_of(id_, speech)
        logger.debug("%s", text)
        for parsed in parse(text, self._limits):
            if parsed.block is None or parsed.problems:
                logger.error("%s: %s", text, parsed.problems)
            else:
                self._holding[character] = id_
                self._scheduler.accompany(parsed.block)

    def _block_of(self, id_: str, speech: PlanUnit) -> str:
        character = speech.block.character
        own = speech.behavior.extensions.get(VOICE)
        seed = f"{id_}:{speech.behavior.text if isinstance(speech.behavior, Speech) else ''}"
        voice = "" if own is None else f" bmlt:voice={quoteattr(own)}"
        start, behaviors = "0", ""
        for number, (words, pause) in enumerate(self._fillers.choose(own or self._voices.get(character), seed), 1):
            behaviors += f'<speech id="filler{number}" start="{start}"{voice}><text>{escape(words)}</text></speech>'
            start = f"filler{number}:end+{pause:.2f}"
        if (listener := self._listeners.of(character)) is not None:
            away = Random(seed).choice(_AWAY)
            behaviors += (
                f'<gaze id="away" start="0" end="{start}" target={quoteattr(listener)} influence="EYES" '
                f'offsetAngle="{_ANGLE}" offsetDirection="{away}"/>'
            )
        names = f"id={quoteattr(id_)} characterId={quoteattr(character)}"
        return f'<bml xmlns="{BML}" xmlns:bmlt="{BMLT}" {names}>{behaviors}</bml>'
