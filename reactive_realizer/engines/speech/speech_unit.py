"""The plan unit of a speech."""

from collections.abc import Container, Iterator, Mapping
from itertools import accumulate, pairwise

from reactive_realizer.binding.asset_file import parse_boolean
from reactive_realizer.bml.attribute_types import Float
from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.behaviors import FILLER, LIVELINESS, RIGID, WORDS, Speech
from reactive_realizer.bml.vocabulary import InterruptSpeech
from reactive_realizer.clock.units import RESOLUTION, GlobalTime, Time
from reactive_realizer.embodiment.audio import Caption
from reactive_realizer.engine.effects import MovePoint
from reactive_realizer.engine.sound_unit import SoundUnit
from reactive_realizer.engine.tts import Utterance
from reactive_realizer.engines.speech.spoken_utterance import SpokenUtterance
from reactive_realizer.engines.speech.stretched_utterance import StretchedUtterance, pace_of
from reactive_realizer.errors import CreationFault, Fault, RealizerError
from reactive_realizer.limits import Limits
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.planunit.parameter import Parameter, Range
from reactive_realizer.planunit.plan_unit import DuePoint, SyncPoint
from reactive_realizer.planunit.timing import Phase, PhaseKind, Timing, timing_at
from reactive_realizer.reactive.graph import Graph

VOICE = "voice"
LIVELINESS_RANGE = Range(0.0, 1.0)

_LEAD = 0.05
"""The shortest time from the arrival of a part to its sound, s, in which the lips can get to its first viseme."""
_AHEAD = 0.3
"""How long before it is heard the sound of a stretched speech is made, s: it has to reach clients in time."""
_SLACK = 0.01
"""How far the points of a stretched speech may be from its course, s."""
_LONGEST_PAUSE = 1.0
"""How much longer each pause of a stretched speech may become, s."""


class BadLiveliness(CreationFault):
    """A liveliness of a speech that is not a number from 0 to 1."""

    code = "bad-liveliness"
    template = "its liveliness must be a number from {low:g} to {high:g}, not '{value}'"
    value: str
    low: float
    high: float


class SpeechUnit(SoundUnit):
    """An utterance. A character speaks one at a time.

    It may begin when its first part is made. It waits for what is not made in time. Its timing is rigid until it is
    loosened: from then on, its sound follows its sync points within limits, until it is cut.

    Attributes:
        speech: the behavior, in the form that is spoken.
        note: what is to be told of it when it is planned, None for nothing.

    Raises:
        RealizerError: "not-a-flag", of the attributes for words and rigid speech, or "bad-liveliness".
    """

    def __init__(
        self,
        block: BlockKey,
        behavior: Speech,
        utterance: Utterance,
        graph: Graph,
        liveliness: float | None = None,
        note: Fault | None = None,
    ) -> None:
        """Make the unit.

        Args:
            block: name of its block.
            behavior: its description.
            utterance: what is known of it.
            graph: of its parameters.
            liveliness: of the character, 0 to 1; None if it has none, so that only the speech itself may ask for some.
            note: what is to be told of it when it is planned.
        """
        liveliness = liveliness_of(behavior, liveliness)
        self.speech = behavior
        self.note = note
        self._words = {} if liveliness is None and not wants_words(behavior) else _word_points(behavior, utterance)
        self._spoken = SpokenUtterance(utterance)
        self._stretched: StretchedUtterance | None = None
        self._follows = True
        self._asked: dict[str, tuple[Time, GlobalTime]] = {}
        self._may_loosen = not is_rigid(behavior)
        offsets = sorted(self._offsets().items(), key=lambda each: each[1])
        timing = self._timed({"start": 0.0, **dict(offsets), "end": utterance.duration})
        super().__init__(block, behavior, timing, self._spoken.sounds, graph, frozenset({VOICE}))
        self.unreported = frozenset() if wants_words(behavior) else frozenset(self._words)
        if liveliness is not None:
            name = LIVELINESS[1]
            self.parameters[name] = Parameter(graph, str(self.key(name)), liveliness, LIVELINESS_RANGE)

    @property
    def utterance(self) -> Utterance:
        """Words and phonemes as far as they are known, with their times; those ahead of what is made may change."""
        return self._spoken.timed if self._stretched is None else self._stretched.timed

    @property
    def loose(self) -> bool:
        """Whether its sound follows its sync points."""
        return self._stretched is not None

    @property
    def duration(self) -> float:
        """How long it lasts as planned now, s."""
        return self.utterance.duration if self.loose else super().duration

    def loose_timing(self, named: Container[str]) -> Timing | None:
        """The timing with the shortest and longest durations of parts; None if it has no sound, or only some of it.

        After the last point that a constraint names, it is spoken at its own pace.
        """
        utterance, points = self._spoken.timed, self.timing.points
        if not (self._may_loosen and utterance.audio and utterance.complete):
            return None
        pace = pace_of(utterance)
        phases = list(self.timing.phases)
        last = max((k for k, sync in enumerate(points) if sync in named), default=0)
        for k, (begin, end) in enumerate(pairwise(self.timing.offsets[: last + 1])):
            phase = phases[k]
            pauses = sum(1 for each in pace.pauses if begin < each <= end)
            longest = pace.most * phase.duration + _LONGEST_PAUSE * pauses
            elastic = Phase(phase.duration, maximum=longest, shortest=pace.least * phase.duration)
            phases[k] = elastic if phase.duration else phase
        return Timing(points, tuple(phases))

    def loosen(self, timing: Timing) -> None:
        """Take a `loose_timing`, and make the sound again, as its sync points ask for."""
        self._stretched = StretchedUtterance(self._spoken.timed)
        self.timing, self.sounds = timing, self._stretched.sounds
        self.shortest = [phase.shortest for phase in timing.phases]

    def make_sound(self, now: GlobalTime) -> None:
        """Make the sound of a stretched speech that will be heard soon."""
        if self._stretched is None or (origin := self.origin) is None:
            return
        if self._follows:
            self._stretched.follow(self._goals(origin))
        self._stretched.make(now - origin + _AHEAD)

    def earliest(self, now: GlobalTime) -> Iterator[tuple[SyncPoint, GlobalTime]]:
        """As `PlanUnit.earliest`: of a stretched speech, what is made stays, and the rest can be hurried."""
        if self._stretched is None or self.hearing is None:
            yield from super().earliest(now)
        elif self._follows:
            for point, position in self._positions_ahead():
                time = GlobalTime(self.hearing.origin + self._stretched.earliest(position))
                if time > now + RESOLUTION:
                    yield point, time

    def misplaced(self, now: GlobalTime) -> Iterator[MovePoint]:
        """The points of a stretched speech that are not where its course has them.

        The course differs from what the pegs say when words are as slow or as fast as they may be, and where the sound
        is made already. A point whose time is unknown comes when its sound does. One that cannot move is not asked for
        again.
        """
        if self._stretched is None or self.hearing is None or not self._follows:
            return
        for point, position in self._positions_ahead():
            heard = GlobalTime(self.hearing.origin + self._stretched.course.time(position))
            time = point.peg.value
            off = heard < now + _AHEAD if time is None else abs(time - heard) > _SLACK
            if off and self._asked.get(point.id) != (time, heard):
                self._asked[point.id] = time, heard
                yield MovePoint(self, point, heard)

    def next_due(self) -> Time:
        """As `PlanUnit.next_due`, or when more of its sound is to be made."""
        due, stretched, origin = super().next_due(), self._stretched, self.origin if self.points else None
        if stretched is None or stretched.complete or origin is None or not self.live:
            return due
        making = GlobalTime(origin + stretched.made - _AHEAD)
        return making if due is None else min(due, making)

    def detach(self, point: SyncPoint, time: GlobalTime) -> None:
        """As `PlanUnit.detach`, when it is cut: its end no longer determines how fast it is spoken."""
        self._follows = False
        super().detach(point, time)

    def reading(self, time: GlobalTime) -> tuple[Utterance, float]:
        """The utterance as it was made, and the position in it that is heard at a time, s."""
        position = self.position(time)
        if self._stretched is None:
            return self.utterance, position
        return self._stretched.utterance, self._stretched.course.position(position)

    def extend(self, utterance: Utterance, now: GlobalTime) -> None:
        """Take the utterance when more of it is made: its times from there on change, and its sound can be heard."""
        if (lacks_from := self.lacks_from()) is not None and lacks_from < now + _LEAD:
            self._spoken.pause(now + _LEAD - lacks_from)
        self._spoken.extend(utterance)
        self._retime()

    def lacks_from(self) -> Time:
        """The time from which on nothing is made, while it plays; None if all is."""
        begin = self._spoken.next_part
        return None if self.hearing is None or begin is None else GlobalTime(self.hearing.origin + begin)

    def wait(self, until: GlobalTime) -> None:
        """Have what is not made not begin before a time."""
        if (lacks_from := self.lacks_from()) is not None and lacks_from < until:
            self._spoken.pause(until - lacks_from)
            self._retime()

    @property
    def caption(self) -> Caption:
        """Its text, with the times of its words."""
        words = tuple((word.start, word.first, word.last) for word in self.utterance.words)
        return Caption(self.utterance.text, words)

    def gentle_end(self, time: GlobalTime, speech: InterruptSpeech) -> GlobalTime:
        """The end of the present word or clause: the start of the next one, or the end of the speech."""
        if self.hearing is None:
            return time
        return GlobalTime(self.hearing.origin + self.next_border(time, speech))

    def next_border(self, time: GlobalTime, speech: InterruptSpeech) -> float:
        """The position of the next word or clause that begins at or after a time, s; the duration if there is none."""
        next_ = self.utterance.next_clause if speech is InterruptSpeech.CLAUSE else self.utterance.next_word
        return next_(self.position(time))

    def due_at_cut(self, now: GlobalTime, *, end: bool = True) -> list[DuePoint]:
        """The due points without a word that would begin with the cut."""
        due = super().due_at_cut(now, end=end)
        return [each for each in due if each.point.id not in self._words or each.time < now - RESOLUTION]

    def details(self, sync: str, time: GlobalTime) -> Mapping[str, str]:
        """Of a word, its index and text; of the end, what was heard: the last word, and the number of characters."""
        if sync in self._words:
            index = self._words[sync]
            return {"word": str(index), "text": self.utterance.words[index].text}
        return self._heard(time) if sync == "end" else {}

    def _offsets(self) -> dict[str, float]:
        """The times of its marks and words, s after its start."""
        utterance = self._spoken.timed
        words = {sync: utterance.words[index].start for sync, index in self._words.items()}
        return {mark.id: utterance.marks[mark.id] for mark in self.speech.marks} | words

    def _retime(self) -> None:
        """Give its points the times that are known now, in their present order."""
        offsets = {"start": 0.0, **self._offsets(), "end": self.utterance.duration}
        points = self.timing.points
        times = accumulate((offsets[sync] for sync in points), max)
        self.timing = self._timed(dict(zip(points, times, strict=True)))
        self.wake()

    def _positions_ahead(self) -> list[tuple[SyncPoint, float]]:
        """The points that have not fired, with their positions in the utterance as it was made, s."""
        positions = dict(zip(self.timing.points, self.timing.offsets, strict=True))
        return [(point, positions[point.id]) for point in self.ahead()]

    def _goals(self, origin: GlobalTime) -> list[tuple[float, float]]:
        """When positions of the utterance are to be heard, s after its start: those of its end, and of tied points."""
        last = self.points[-1]
        return [
            (point.peg.value - origin, position)
            for point, position in self._positions_ahead()
            if (point.tied or point is last) and point.peg.value is not None
        ]

    def _timed(self, offsets: Mapping[str, float]) -> Timing:
        """A timing with its points at these times, s after its start."""
        return timing_at(offsets, PhaseKind.RIGID)

    def _heard(self, time: GlobalTime) -> Mapping[str, str]:
        position = self.position(time)
        begun = self.utterance.words_begun(position)
        if not begun:
            return {"word": "-1", "text": "", "heard": "0"}
        whole = position >= self.utterance.duration - RESOLUTION
        heard = len(self.utterance.text) if whole else begun[-1].last
        return {"word": str(len(begun) - 1), "text": begun[-1].text, "heard": str(heard)}


def wants_words(behavior: Behavior) -> bool:
    """Whether the words of a speech are sync points.

    Raises:
        RealizerError: "not-a-flag".
    """
    return parse_boolean(WORDS[1], behavior.extensions.get(WORDS, "false"))


def holds_floor(behavior: Behavior) -> bool:
    """Whether the character says fillers after a speech, until its next words arrive.

    Raises:
        RealizerError: "not-a-flag".
    """
    return parse_boolean(FILLER[1], behavior.extensions.get(FILLER, "false"))


def is_rigid(behavior: Behavior) -> bool:
    """Whether a speech is never stretched.

    Raises:
        RealizerError: "not-a-flag".
    """
    return parse_boolean(RIGID[1], behavior.extensions.get(RIGID, "false"))


def liveliness_of(behavior: Behavior, default: float | None) -> float | None:
    """How lively a speech is to be, 0 to 1: as it says itself, or else a default.

    Raises:
        RealizerError: "bad-liveliness".
    """
    if (text := behavior.extensions.get(LIVELINESS)) is None:
        return default
    low, high = LIVELINESS_RANGE
    try:
        return Float(low, high).read(text, Limits())
    except RealizerError as problem:
        raise RealizerError(BadLiveliness(value=text, low=low, high=high)) from problem


def _word_points(behavior: Speech, utterance: Utterance) -> dict[str, int]:
    """The indices of words by their sync points; a mark keeps its name."""
    marks = {mark.id for mark in behavior.marks}
    points = {f"word{index}": index for index in range(len(utterance.words))}
    return {sync: index for sync, index in points.items() if sync not in marks}
