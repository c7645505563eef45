"""Reads the human file: the characters, targets, anticipators and limits of a scene, as TOML."""

import re
import tomllib
from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass, field, fields, replace
from pathlib import Path
from sys import float_info
from typing import Any, Final, TypeVar

from reactive_realizer.assembly.faults import BadHumanFile
from reactive_realizer.bml.document import parse
from reactive_realizer.bml.expressivity import MOST, Expressivity
from reactive_realizer.bml.names import BLOCK, EVENTS
from reactive_realizer.bml.value_faults import NotAnId
from reactive_realizer.embodiment.vector import ZERO, Vec3
from reactive_realizer.errors import RealizerError
from reactive_realizer.limits import Limits
from reactive_realizer.liveliness.autonomous_behaviors import AutonomousBehavior, Trigger

T = TypeVar("T")

DEFAULT_ENGINES: Final = (
    "speech",
    "audio",
    "animation",
    "face",
    "wait",
    "activate",
    "interrupt",
    "parameter_value_change",
)
DEFAULT_BINDINGS: Final[Mapping[str, str]] = {
    "gesture": "gesturebinding.xml",
    "face": "facebinding.xml",
    "picture": "picturebinding.xml",
}
VISEMES: Final = "visemes"
"""The kind of the binding from sounds to the mouth; that of the package depends on the avatar."""
SPEECH: Final = "speech"
"""The kind of AsapRealizer's bindings from sounds to joints."""

LIGHTEST, HEAVIEST = 1.0, 1000.0
"""Bounds of the weight of a character, kg."""

MOST_BLINKS = 60.0
"""Bound of the rate of blinks, per minute."""

FEWEST_STEPS, MOST_STEPS = 2, 20
"""Bounds of the steps in which a physical body is simulated in each tick."""

WIDEST = 100.0
"""Limit of the radius of a target, m."""

FARTHEST = 10_000.0
"""Limit of the coordinates of characters and targets, m, also for clients that move targets."""

SHORTEST_PERIOD, LONGEST_PERIOD = 0.5, 86_400.0
"""Bounds of the time from one autonomous behavior to the next, s."""

_EVENT: Final = re.compile(r"[^\s:+]+:[^\s:+]+")
"""An anticipator and its point."""

_ID: Final = re.compile(r"[^\s:+\x00-\x1f\x7f]{1,200}")
"""Ids that BML can refer to."""


@dataclass(frozen=True, slots=True)
class CharacterSpec:
    """``[character.ID]``.

    Attributes:
        avatar: name of a GLB file among the assets.
        voice: a name that the text-to-speech binding knows, empty for its default; or one for each binding, by its id.
        position: on the ground, m.
        heading: rotation to its left, degrees; 0 faces +z.
        engines: ids of engines, in rank order.
        idle: degree of its idle animation, 0 to 1; true is 1, and false is 0, for none.
        blink_rate: blinks per minute of idle animation; None for the usual rate.
        liveliness: how lively it is while it speaks, 0 to 1; None for that of the scene.
        expressivity: of its gestures and pointing, by the names of the fields of `Expressivity`.
        weight: of its physical body, kg; None for the usual one of its stature.
        simulation_steps: of its physical body in each tick; None for steps of the usual time.
        bindings: names of files among the assets, by kind; by default `DEFAULT_BINDINGS`.
        autonomous: what it does by itself, by name.
    """

    avatar: str = "avatars/female.glb"
    voice: str | Mapping[str, str] = ""
    position: Vec3 = ZERO
    heading: float = 0.0
    engines: tuple[str, ...] = DEFAULT_ENGINES
    idle: bool | float = 1.0
    blink_rate: float | None = None
    liveliness: float | None = None
    expressivity: Mapping[str, float] = field(default_factory=dict)
    weight: float | None = None
    simulation_steps: int | None = None
    bindings: Mapping[str, str] = field(default_factory=lambda: DEFAULT_BINDINGS)
    autonomous: Mapping[str, AutonomousBehavior] = field(default_factory=dict)

    def voice_of(self, tts: str) -> str | None:
        """The name of its voice of a text-to-speech binding; None for the default of this binding."""
        return (self.voice if isinstance(self.voice, str) else self.voice.get(tts)) or None


@dataclass(frozen=True, slots=True)
class TargetSpec:
    """``[target.ID]``: a place to look at.

    Attributes:
        position: m.
        radius: of the space on the ground that characters walk around, m.
    """

    position: Vec3
    radius: float = 0.0


@dataclass(frozen=True, slots=True)
class AnticipatorSpec:
    """``[anticipator.ID]``: its kind, and its parameters, which are numbers or lists of names."""

    kind: str
    parameters: Mapping[str, float | tuple[str, ...]] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class HumanFile:
    """The specification of a scene."""

    characters: Mapping[str, CharacterSpec]
    targets: Mapping[str, TargetSpec]
    anticipators: Mapping[str, AnticipatorSpec]
    limits: Limits


def read_human_file(path: Path) -> HumanFile:
    """Reads a human file.

    Raises:
        RealizerError: the file is not TOML; an id is invalid or used twice; a key is unknown; or a value has the wrong
            type or is out of range.
    """
    try:
        table = tomllib.loads(path.read_text(encoding="utf-8"))
    except (ValueError, RecursionError) as problem:
        raise RealizerError(BadHumanFile(file=path.name, key="the file", reason=str(problem))) from problem
    reader = _Reader(path.name)
    reader.know("", table, ("character", "target", "anticipator", "limits"))
    characters = reader.section(table, "character", reader.character)
    if not characters:
        raise RealizerError(BadHumanFile(file=path.name, key="character", reason="there is none"))
    targets = reader.section(table, "target", reader.target)
    for id_ in characters.keys() & targets.keys():
        raise RealizerError(BadHumanFile(file=path.name, key=f"target.{id_}", reason="a character has this id"))
    anticipators = reader.section(table, "anticipator", reader.anticipator)
    return HumanFile(characters, targets, anticipators, reader.limits(table.get("limits", {})))


class _Reader:
    """Reads tables into data classes; every mistake names its key."""

    def __init__(self, file: str) -> None:
        self._file = file

    def section(self, table: Mapping[str, Any], name: str, read: Callable[[str, Any], T]) -> dict[str, T]:
        own = table.get(name, {})
        if not isinstance(own, dict):
            raise self._bad(name, "expected a table")
        for id_ in own:
            if id_ == BLOCK or not _ID.fullmatch(id_):
                raise self._bad(f"{name}.{id_!r}", RealizerError(NotAnId()).fault.sentence)
        return {id_: read(f"{name}.{id_}", entry) for id_, entry in own.items()}

    def character(self, key: str, table: Any) -> CharacterSpec:
        spec = self.read(CharacterSpec, key, table)
        self.know(f"{key}.bindings", spec.bindings, (*DEFAULT_BINDINGS, VISEMES, SPEECH))
        if spec.weight is not None and not LIGHTEST <= spec.weight <= HEAVIEST:
            raise self._bad(f"{key}.weight", f"{spec.weight:g} is not from {LIGHTEST:g} to {HEAVIEST:g} kg")
        if spec.blink_rate is not None and not 0.0 <= spec.blink_rate <= MOST_BLINKS:
            raise self._bad(f"{key}.blink_rate", f"{spec.blink_rate:g} is not from 0 to {MOST_BLINKS:g} per minute")
        if not 0.0 <= spec.idle <= 1.0:
            raise self._bad(f"{key}.idle", f"{spec.idle:g} is not from 0 to 1")
        if spec.liveliness is not None and not 0.0 <= spec.liveliness <= 1.0:
            raise self._bad(f"{key}.liveliness", f"{spec.liveliness:g} is not from 0 to 1")
        self.know(f"{key}.expressivity", spec.expressivity, Expressivity._fields)
        for name, value in spec.expressivity.items():
            if not -MOST <= value <= MOST:
                raise self._bad(f"{key}.expressivity.{name}", f"{value:g} is not from {-MOST:g} to {MOST:g}")
        steps = spec.simulation_steps
        if steps is not None and not FEWEST_STEPS <= steps <= MOST_STEPS:
            raise self._bad(f"{key}.simulation_steps", f"{steps} is not from {FEWEST_STEPS} to {MOST_STEPS}")
        for rank, engine in enumerate(spec.engines):
            if engine in spec.engines[:rank]:
                raise self._bad(f"{key}.engines", f"{engine!r} is listed twice")
        return replace(spec, bindings={**DEFAULT_BINDINGS, **spec.bindings})

    def autonomous(self, key: str, table: Any) -> AutonomousBehavior:
        spec = self.read(AutonomousBehavior, key, table)
        if spec.trigger not in tuple(Trigger):
            raise self._bad(f"{key}.trigger", f"{spec.trigger!r} is not one of {', '.join(Trigger)}")
        if not SHORTEST_PERIOD <= spec.every <= LONGEST_PERIOD:
            raise self._bad(f"{key}.every", f"{spec.every:g} is not from {SHORTEST_PERIOD:g} to {LONGEST_PERIOD:g} s")
        if (spec.trigger == Trigger.EVENT) is not bool(_EVENT.fullmatch(spec.event)):
            raise self._bad(f"{key}.event", "the trigger event needs an anticipator and a point, as in 'partner:nod'")
        found = parse(spec.document("", "autonomous"), Limits())
        for problem in (problem for parsed in found for problem in parsed.problems):
            raise self._bad(f"{key}.behavior", problem.fault.sentence)
        if len(found) != 1 or found[0].block is None or not found[0].block.behaviors:
            raise self._bad(f"{key}.behavior", "it must be one or more behaviors of BML")
        return spec

    def target(self, key: str, table: Any) -> TargetSpec:
        spec = self.read(TargetSpec, key, table)
        if not 0.0 <= spec.radius <= WIDEST:
            raise self._bad(f"{key}.radius", f"{spec.radius:g} is not from 0 to {WIDEST:g} m")
        return spec

    def limits(self, table: Any) -> Limits:
        limits = self.read(Limits, "limits", table)
        for name, value in asdict(limits).items():
            if value < 1:
                raise self._bad(f"limits.{name}", f"{value} is less than 1")
        return limits

    def anticipator(self, key: str, table: Any) -> AnticipatorSpec:
        if not isinstance(table, dict) or not isinstance(table.get("kind"), str):
            raise self._bad(key, "expected a table with a kind")
        if key == f"anticipator.{EVENTS}":
            raise self._bad(key, "this id is reserved for the events that behaviors emit")
        kinds = {name: tuple[str, ...] if isinstance(value, list) else float for name, value in table.items()}
        rest = {name: self._value(f"{key}.{name}", table[name], kinds[name]) for name in table if name != "kind"}
        return AnticipatorSpec(table["kind"], rest)

    def read(self, cls: Callable[..., T], key: str, table: Any) -> T:
        if not isinstance(table, dict):
            raise self._bad(key, "expected a table")
        kinds = {own.name: own.type for own in fields(cls)}  # type: ignore[arg-type]
        self.know(key, table, tuple(kinds))
        values = {name: self._value(f"{key}.{name}", value, kinds[name]) for name, value in table.items()}
        try:
            return cls(**values)
        except TypeError as problem:
            raise self._bad(key, str(problem)) from problem

    def know(self, key: str, table: Mapping[str, Any], known: tuple[str, ...]) -> None:
        for name in table:
            if name not in known:
                raise self._bad(f"{key}.{name}".lstrip("."), f"unknown; known are {', '.join(known)}")

    def _coordinate(self, key: str, value: Any) -> float:
        coordinate: float = self._value(key, value, float)
        if abs(coordinate) > FARTHEST:
            raise self._bad(key, f"{coordinate:g} is not from {-FARTHEST:g} to {FARTHEST:g} m")
        return coordinate

    def _value(self, key: str, value: Any, kind: Any) -> Any:
        """The value, if it has the type of the field."""
        number = isinstance(value, int | float) and not isinstance(value, bool) and abs(value) <= float_info.max
        if number and kind in (float, float | None):
            return float(value)
        if number and kind in (type(value), type(value) | None):
            return value
        if kind == bool | float and (number or isinstance(value, bool)):
            return float(value)
        if kind in (str, bool) and isinstance(value, kind):
            return value
        if kind == Vec3 and isinstance(value, list) and len(value) == 3:
            return tuple(self._coordinate(key, part) for part in value)
        if kind == tuple[str, ...] and isinstance(value, list):
            return tuple(self._value(key, part, str) for part in value)
        if kind == Mapping[str, float] and isinstance(value, dict):
            return {name: self._value(f"{key}.{name}", part, float) for name, part in value.items()}
        if kind == Mapping[str, AutonomousBehavior] and isinstance(value, dict):
            return self.section({key: value}, key, self.autonomous)
        if kind == str | Mapping[str, str] and isinstance(value, str):
            return value
        if kind in (Mapping[str, str], str | Mapping[str, str]) and isinstance(value, dict):
            return {name: self._value(f"{key}.{name}", part, str) for name, part in value.items()}
        raise self._bad(key, f"{value!r} has the wrong type")

    def _bad(self, key: str, reason: str) -> Exception:
        return RealizerError(BadHumanFile(file=self._file, key=key, reason=reason))
