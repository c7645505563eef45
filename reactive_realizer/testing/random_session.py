"""Random sessions: blocks that refer to each other, and wrong, late and withdrawn predictions."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from random import Random
from typing import TypeVar

from reactive_realizer.bml.names import BML
from reactive_realizer.limits import Limits
from reactive_realizer.testing.pilot import RealizerPilot, block

CHARACTERS = ("alice", "bob", "carol")
HUMAN = (
    "".join(f"[character.{name}]\nposition = [{x}, 0, 0]\n" for x, name in enumerate(CHARACTERS))
    + """
[target.bluebox]
position = [-1.2, 1.2, 1.5]
[anticipator.metronome]
kind = "metronome"
tempo = 90
[anticipator.spacebar]
kind = "spacebar"
"""
)
"""The human file of the scene in which the sessions play."""

T = TypeVar("T")

_SPEECH = '<speech id="{id}"{ties}><text>Well <sync id="m"/>then, my friend.</text></speech>'
_BEHAVIORS = {
    _SPEECH: ("start", "end"),
    '<head id="{id}" lexeme="NOD"{ties}/>': ("start", "stroke", "end"),
    '<head id="{id}" lexeme="SHAKE" repetition="2"{ties}/>': ("start", "end"),
    '<gesture id="{id}" lexeme="BEAT" mode="RIGHT_HAND"{ties}/>': ("start", "ready", "stroke", "relax", "end"),
    '<gesture id="{id}" lexeme="OFFER" mode="LEFT_HAND"{ties}/>': ("start", "strokeStart", "stroke", "end"),
    '<pointing id="{id}" target="bluebox"{ties}/>': ("start", "ready", "relax", "end"),
    '<gaze id="{id}" target="bluebox"{ties}/>': ("start", "ready", "relax", "end"),
    '<gazeShift id="{id}" target="bluebox"{ties}/>': ("start", "end"),
    '<postureShift id="{id}"{ties}><stance type="STANDING"/><pose part="ARMS" lexeme="ARMS_CROSSED"/></postureShift>': (
        "start",
        "end",
    ),
    '<faceLexeme id="{id}" lexeme="RAISE_BROWS"{ties}/>': ("start", "attackPeak", "end"),
    '<wait id="{id}" duration="0.4"{ties}/>': ("start", "end"),
    '<wait id="{id}" max-wait="0.8"{ties}/>': ("start", "end"),
    '<wait id="{id}" event="asked" max-wait="1.2"{ties}/>': ("start",),
    '<wait id="{id}" event="told"{ties}/>': ("start",),
    '<bmla:emit id="{id}" event="asked"{ties}/>': ("start",),
    '<bmla:emit id="{id}" event="told"{ties}/>': ("start",),
    '<bmla:activate id="{id}" target="{other}"{ties}/>': ("start",),
    '<bmla:interrupt id="{id}" target="{other}"{ties}/>': ("start",),
    '<bmla:interrupt id="{id}" target="{other}" include="p q"{ties}/>': ("start",),
    '<bmla:interrupt id="{id}" target="{other}" exclude="p" speech="word"{ties}/>': ("start",),
    '<bmla:parametervaluechange id="{id}" target="{other}:p" paramId="volume"{ties}>'
    '<bmla:trajectory type="linear" targetValue="90"/></bmla:parametervaluechange>': ("start", "end"),
    '<bmla:parametervaluechange id="{id}" target="q" paramId="amount"{ties}>'
    '<bmla:trajectory type="instant" targetValue="0.5"/></bmla:parametervaluechange>': ("start", "end"),
}
"""The behaviors, each with the points of it that may be tied."""

_PLANNING = Limits().planning_per_tick
_IDS = ("p", "q", "r", "s")
_SIZES = (0, 1, 1, 2, 2, 3, 4)
_REMOTE = ("hit", "go")
_ANTICIPATED = (
    *(f"anticipators:t:{sync}" for sync in _REMOTE * 2),
    "anticipators:events:asked",
    "anticipators:spacebar:press",
    "anticipators:spacebar:release",
    *(f"anticipators:metronome:tick{number}" for number in (2, 5, 9)),
)
_OFFSETS = ("", "", "", "+0.2", "-0.2", "+1", "-1")
_TIMES = ("0", "0.3", "1", "-0.2")
_PAUSES = (0.0, 0.0, 0.01, 0.03, 0.1, 0.25, 0.5)
_AHEAD = (None, -0.5, -0.03, 0.0, 0.05, 0.2, 0.5, 1.0, 2.0)
_COMPOSITIONS = ("MERGE",) * 6 + ("APPEND",) * 3 + ("REPLACE",)
_DISTANCES = (1, 1, 1, 2, 2, 3, 4, -1, -2)
"""How many blocks ago the other block of a reference was sent."""
_OWN_POINTS = ("ready", "strokeStart", "stroke", "strokeEnd")
"""Sync points that a block may define."""
_JOINS = ("appendAfter", "chunkAfter", "prependBefore", "chunkBefore", "interrupt", "onStart")


@dataclass(frozen=True, slots=True)
class Block:
    """A block, in parts that can be left out one by one.

    Attributes:
        attributes: of BML and of BMLA, by name.
        parts: its behaviors and constraints.
        draft: whether it is written in a draft of BML, in which a gaze without an end persists.
    """

    id: str
    attributes: dict[str, str]
    parts: tuple[str, ...]
    draft: bool = False

    def send(self, pilot: RealizerPilot) -> None:
        """Send it."""
        text = block(self.id, "".join(self.parts), **self.attributes)
        if self.draft:
            text = text.replace(f' xmlns="{BML}"', ' bmlt:allowexternalrefs="true"')
        pilot.perform(text)


@dataclass(frozen=True, slots=True)
class RandomPrediction:
    """A prediction of a point of the anticipator ``t``, s from now; None withdraws it."""

    sync: str
    ahead: float | None

    def send(self, pilot: RealizerPilot) -> None:
        """Send it."""
        pilot.predict("t", self.sync, None if self.ahead is None else pilot.now + self.ahead)


@dataclass(frozen=True, slots=True)
class RandomEvent:
    """An event of an anticipator of the scene."""

    anticipator: str
    name: str
    value: float | None = None

    def send(self, pilot: RealizerPilot) -> None:
        """Send it."""
        pilot.event(self.anticipator, self.name, self.value)


_EVENTS = (
    RandomEvent("spacebar", "press"),
    RandomEvent("spacebar", "release"),
    RandomEvent("events", "asked"),
    RandomEvent("metronome", "tempo", 40),
    RandomEvent("metronome", "tempo", 150),
)


@dataclass(frozen=True, slots=True)
class SessionStep:
    """An input after a pause, s, and before a tick that leaves out some others because it is late."""

    pause: float
    left_out: int
    input: Block | RandomPrediction | RandomEvent


@dataclass(frozen=True, slots=True)
class Session:
    """The inputs of a session in order.

    Attributes:
        planning: work of planning in a tick, as in the limits; with little, blocks are planned over many ticks.
    """

    steps: tuple[SessionStep, ...]
    planning: int = _PLANNING

    @property
    def blocks(self) -> int:
        """Number of blocks."""
        return sum(isinstance(step.input, Block) for step in self.steps)


class _Mix:
    """What a session is made of: only some kinds of behaviors, events, pauses and so on.

    Sessions that leave features out find more than sessions that mix all of them (A. Groce et al., "Swarm testing",
    2012).
    """

    def __init__(self, random: Random) -> None:
        def some(each: Sequence[T]) -> list[T]:
            return random.sample(each, random.randint(1, len(each)))

        self.kinds = some([*_BEHAVIORS])
        self.anticipated = some(_ANTICIPATED)
        self.characters = some(CHARACTERS)
        self.compositions = some(_COMPOSITIONS)
        self.joins = some(_JOINS)
        self.offsets = some(_OFFSETS)
        self.distances = some(_DISTANCES)
        self.orders = some(("before", "after", "synchronize"))
        self.pauses = some(_PAUSES)
        self.left_out = random.choice(((0,), (0,), (0, 0, 0, 3, 20)))
        self.events = some(_EVENTS)
        self.ahead = some(_AHEAD)
        self.moving = random.choice((0.2, 0.35, 0.75))
        shares = (random.choice((0.0, 0.15, 0.4)) for _ in range(6))
        self.joined, self.preplanned, self.required, self.draft, self.own_points, self.crossed = shares
        self.planning = random.choice((_PLANNING,) * 2 + (200, 20))


def random_session(random: Random, blocks: int = 25) -> Session:
    """A session with a number of blocks, and with predictions and events between them."""
    mix = _Mix(random)
    steps: list[SessionStep] = []
    kinds: list[dict[str, str]] = []
    for _ in range(blocks):
        while random.random() < mix.moving:
            predicts = random.random() < 0.75
            drawn = (
                RandomPrediction(random.choice(_REMOTE), random.choice(mix.ahead))
                if predicts
                else random.choice(mix.events)
            )
            steps.append(SessionStep(random.choice(mix.pauses), random.choice(mix.left_out), drawn))
        kinds.append(dict(zip(_IDS, random.choices(mix.kinds, k=random.choice(_SIZES)), strict=False)))
        steps.append(
            SessionStep(random.choice(mix.pauses), random.choice(mix.left_out), _BlockDraw(random, mix, kinds).block())
        )
    return Session(tuple(steps), mix.planning)


class _BlockDraw:
    """Draws one block, which refers to its own points, to those of the blocks before it, and to anticipators.

    Args:
        random: that draws.
        mix: of the session.
        kinds: behaviors of the blocks so far, by id; the last ones are those of this block.
    """

    def __init__(self, random: Random, mix: _Mix, kinds: Sequence[Mapping[str, str]]) -> None:
        self._random = random
        self._mix = mix
        self._number = len(kinds) - 1
        self._kinds = kinds

    def block(self) -> Block:
        """The block."""
        random = self._random
        # An id can be used again once its block has ended.
        number = self._number if random.random() < 0.9 else max(0, self._number - random.choice((1, 3, 6)))
        own = self._kinds[-1]
        parts = [self._behavior(id_, kind) for id_, kind in own.items()]
        parts += [self._constraint() for _ in range(random.choice((0, 0, 0, 1, 2)) if own else 0)]
        if random.random() < self._mix.required:
            parts = [f"<required>{part}</required>" for part in parts]
        return Block(f"b{number}", self._attributes(), tuple(parts), random.random() < self._mix.draft)

    def _attributes(self) -> dict[str, str]:
        random = self._random
        attributes = {
            "characterId": random.choice(self._mix.characters),
            "composition": random.choice(self._mix.compositions),
        }
        if random.random() < self._mix.joined:
            names = dict.fromkeys(self._other() for _ in range(random.choice((1, 1, 2))))
            attributes[f"bmla:{random.choice(self._mix.joins)}"] = ",".join(names)
        if random.random() < self._mix.preplanned:
            attributes["bmla:preplan"] = "true"
        if random.random() < 0.05:
            attributes["start"] = self._outside() + random.choice(self._mix.offsets)
        if (own := self._kinds[-1]) and random.random() < self._mix.own_points:
            attributes[random.choice(_OWN_POINTS)] = self._point(own, random.choice([*own]))
        return attributes

    def _behavior(self, id_: str, kind: str) -> str:
        points = self._random.sample(_BEHAVIORS[kind], min(len(_BEHAVIORS[kind]), self._random.choice((0, 1, 1, 2))))
        references = [self._reference(id_) for _ in points]
        if len(points) == len(_REMOTE) and self._random.random() < self._mix.crossed:
            references = [f"anticipators:t:{sync}" for sync in _REMOTE]  # which may change their order while it plays
        ties = "".join(f' {point}="{reference}"' for point, reference in zip(points, references, strict=True))
        return kind.format(id=id_, ties=ties, other=self._other())

    def _constraint(self) -> str:
        random = self._random
        behavior = random.choice([*self._kinds[-1]])
        ref, sync = self._reference(behavior), self._point(self._kinds[-1], behavior) + random.choice(self._mix.offsets)
        if random.random() < 0.15:
            sync = random.choice(_TIMES)  # of the block: it may have to start later
        order = random.choice(self._mix.orders)
        if order == "synchronize":
            return f'<constraint><synchronize><sync ref="{ref}"/><sync ref="{sync}"/></synchronize></constraint>'
        return f'<constraint><{order} ref="{ref}"><sync ref="{sync}"/></{order}></constraint>'

    def _reference(self, besides: str) -> str:
        """A time, or a point of another behavior or of an anticipator, with or without an offset."""
        random = self._random
        others = [id_ for id_ in self._kinds[-1] if id_ != besides]
        if others and random.random() < 0.5:
            return self._point(self._kinds[-1], random.choice(others)) + random.choice(self._mix.offsets)
        return random.choice(_TIMES) if random.random() < 0.15 else self._outside() + random.choice(self._mix.offsets)

    def _outside(self) -> str:
        """A point of an anticipator, or of another block or its behavior."""
        random = self._random
        if random.random() < 0.5:
            return random.choice(self._mix.anticipated)
        number = self._other_number()
        kinds = self._kinds[number] if number < len(self._kinds) else {}
        if not kinds or random.random() < 0.3:
            return f"b{number}:{random.choice(('start', 'relax', 'end', 'ready', 'stroke'))}"
        return f"b{number}:{self._point(kinds, random.choice([*kinds]))}"

    def _other(self) -> str:
        return f"b{self._other_number()}"

    def _other_number(self) -> int:
        """The number of a block that was sent shortly before this one, or comes next."""
        return max(0, self._number - self._random.choice(self._mix.distances))

    def _point(self, kinds: Mapping[str, str], id_: str) -> str:
        kind = kinds[id_]
        points = (*_BEHAVIORS[kind], "m") if kind is _SPEECH else _BEHAVIORS[kind]
        return f"{id_}:{self._random.choice(points)}"
