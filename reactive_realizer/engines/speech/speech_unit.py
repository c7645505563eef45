"""The plan unit of a speech."""

from collections.abc import Container, Iterable, Iterator, Mapping
from itertools import accumulate, pairwise

from reactive_realizer.bml.speech import LIVELINESS, Speech
from reactive_realizer.bml.vocabulary import InterruptSpeech
from reactive_realizer.clock.units import RESOLUTION, GlobalTime, Time
from reactive_realizer.embodiment.audio import Caption
from reactive_realizer.engine.effects import MovePoints
from reactive_realizer.engine.sound_unit import SoundUnit
from reactive_realizer.engine.tts import PITCH_RANGE, RATE_RANGE, Utterance
from reactive_realizer.engines.speech.speech_options import LIVELINESS_RANGE, is_rigid, liveliness_of, wants_words
from reactive_realizer.engines.speech.spoken_utterance import SpokenUtterance
from reactive_realizer.engines.speech.stretched_utterance import StretchedUtterance, border_after, stretch_limits
from reactive_realizer.errors import Fault
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.pegboard.time_peg import TimePeg
from reactive_realizer.planunit.parameter import Parameter
from reactive_realizer.planunit.sync_point import DuePoint, SyncPoint
from reactive_realizer.planunit.timing import Phase, PhaseKind, Timing, timing_at
from reactive_realizer.reactive.graph import Graph

VOICE = "voice"

_LEAD = 0.05
"""The shortest time from the arrival of a part to its sound, s, in which the lips can get to its first viseme."""
_AHEAD = 0.3
"""How long before it is heard the sound of a stretched speech is made, s: it has to reach clients in time."""
_SLACK = 0.01
"""How far the points of a stretched speech may be from its course, s."""
_LONGEST_PAUSE = 1.0
"""How much longer each pause of a stretched speech may become, s."""


class SpeechUnit(SoundUnit):
    """An utterance. A character speaks one at a time.

    It may begin when its first part is made. It waits for what is not made in time. It is heard as the voice speaks it
    until its points have to be met by stretching, or its rate or pitch is changed: from then on, its sound is made
    again, shortly before it is heard, until it is cut.

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
        self._elastic = 0
        """The number of phases that may be stretched to meet constraints."""
        self._follows = True
        self._asked: dict[str, tuple[Time, GlobalTime]] = {}
        self._may_loosen = not is_rigid(behavior)
        offsets = sorted(self._offsets(utterance).items(), key=lambda each: each[1])
        timing = self._timed({"start": 0.0, **dict(offsets), "end": utterance.duration})
        super().__init__(block, behavior, timing, self._spoken.sounds, graph, frozenset({VOICE}))
        self.unreported = frozenset() if wants_words(behavior) else frozenset(self._words)
        if liveliness is not None:
            name = LIVELINESS[1]
            self.parameters[name] = Parameter(graph, str(self.key(name)), liveliness, LIVELINESS_RANGE)
        self._rate = Parameter(graph, str(self.key("rate")), 1.0, RATE_RANGE)
        self._pitch = Parameter(graph, str(self.key("pitch")), 1.0, PITCH_RANGE)
        if utterance.audio:
            self.parameters |= {"rate": self._rate, "pitch": self._pitch}

    @property
    def utterance(self) -> Utterance:
        """Words and phonemes as far as they are known, with their times; those ahead of what is made may change."""
        return self._heard_as.timed

    @property
    def _heard_as(self) -> SpokenUtterance | StretchedUtterance:
        return self._spoken if self._stretched is None else self._stretched

    @property
    def loose(self) -> bool:
        """Whether its sound is made shortly before it is heard, as its points, its rate and its pitch say."""
        return self._stretched is not None

    @property
    def heard_by(self) -> Iterable[TimePeg]:
        """As `SoundUnit.heard_by`; what is made or read as its sync points ask for depends on all of them."""
        return (point.peg for point in self.points) if self.loose or self.elastic else super().heard_by

    @property
    def duration(self) -> float:
        """How long it lasts as planned now, s."""
        return self.utterance.duration if self.loose else super().duration

    def loose_timing(self, named: Container[str]) -> Timing | None:
        """The timing with the shortest and longest durations of parts; None if it has no sound.

        After the last point that a constraint names, it is spoken at its own pace.
        """
        if not (self._may_loosen and self.utterance.audio):
            return None
        return self._loosened(max((k for k, sync in enumerate(self.timing.points) if sync in named), default=0))

    def loosen(self, timing: Timing) -> None:
        """Take a `loose_timing`, and make the sound again, as its sync points ask for."""
        elastic = (k for k, phase in enumerate(timing.phases, 1) if phase.kind is not PhaseKind.RIGID)
        self._elastic = max(elastic, default=0)
        self._take_timing(timing)
        self._stretched = StretchedUtterance(self._spoken.utterance)
        self.sounds = self._stretched.sounds

    def steer(self, now: GlobalTime) -> None:
        """Have what is not made follow its sync points, its rate and its pitch."""
        changed = (self._rate.value, self._pitch.value) != (1.0, 1.0)
        if not (self.live and self._follows and (self.loose or changed)):
            return
        if self._stretched is None:
            self._stretched = self._taken_over(now)
            self.sounds = self._stretched.sounds
        self._stretched.pitch = self._pitch.value
        self._follow(self._stretched)

    def make_sound(self, now: GlobalTime) -> None:
        """As `SoundUnit.make_sound`, if it is not heard as the voice speaks it."""
        self.steer(now)
        if self._stretched is None:
            return
        if (origin := self.origin) is not None:
            self._stretched.make(now - origin + _AHEAD)
        elif self.timing.rigid:
            self._stretched.make(_AHEAD)

    def earliest(self, now: GlobalTime) -> Iterator[tuple[SyncPoint, GlobalTime]]:
        """As `PlanUnit.earliest`: of a stretched speech, what is made stays, and the rest can be hurried."""
        if self._stretched is None or self.hearing is None or self.timing.rigid:
            yield from super().earliest(now)
        elif self._follows:
            for point, position in self._positions_ahead(self._stretched):
                time = GlobalTime(self.hearing.origin + self._stretched.earliest(position))
                if time > now + RESOLUTION:
                    yield point, time

    def misplaced(self, now: GlobalTime) -> MovePoints | None:
        """The request that points come when their sounds do, if they are not planned for that.

        The course differs from what the pegs say when words are as slow or as fast as they may be, where the sound is
        made already, when more is made, and after a change of the rate. A point whose time is unknown comes when its
        sound does. One that cannot move is not asked for again.
        """
        origin, playing = self.origin, self.hearing is not None
        if self._stretched is None or origin is None or not self._follows or not (playing or self.timing.rigid):
            return None
        ahead = self._positions_ahead(self._stretched)
        times = {point.id: GlobalTime(origin + self._stretched.course.time(position)) for point, position in ahead}
        slack = RESOLUTION if self.timing.rigid else _SLACK
        off = {each.id: each.peg.value for each, _ in ahead if _is_off(each.peg.value, times[each.id], now, slack)}
        asked = {sync: (time, times[sync]) for sync, time in off.items()}
        if all(self._asked.get(sync) == each for sync, each in asked.items()):
            return None
        self._asked |= asked
        return MovePoints(self, times if self.timing.rigid else {sync: times[sync] for sync in off}, now)

    def next_due(self) -> Time:
        """As `PlanUnit.next_due`, or when more of its sound is to be made."""
        due, origin = super().next_due(), self.origin if self.points else None
        begin = None if self._stretched is None else self._stretched.makes_next
        if begin is None or origin is None or not self.live:
            return due
        making = GlobalTime(origin + begin - _AHEAD)
        return making if due is None else min(due, making)

    def awaited(self) -> list[TimePeg]:
        """As `PlanUnit.awaited`; its sound is made ahead of its start also before its block plays."""
        return super().awaited() or [point.peg for point in self.points[:1]]

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
            self._pause(GlobalTime(now + _LEAD))
        self._heard_as.extend(utterance)
        self._retime()

    def lacks_from(self) -> Time:
        """The time from which on nothing is made, while it plays; None if all is."""
        begin = self._heard_as.next_part
        return None if self.hearing is None or begin is None else GlobalTime(self.hearing.origin + begin)

    def wait(self, until: GlobalTime) -> None:
        """Have what is not made not begin before a time."""
        if (lacks_from := self.lacks_from()) is not None and lacks_from < until:
            self._pause(until)
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

    def _offsets(self, utterance: Utterance) -> dict[str, float]:
        """The times of its points in an utterance, s after its start; its own points keep their order."""
        words = {sync: utterance.words[index].start for sync, index in self._words.items()}
        return {mark.id: utterance.marks[mark.id] for mark in self.speech.marks} | words

    def _ordered(self, utterance: Utterance) -> dict[str, float]:
        """The times of all its points in an utterance, s after its start, in their present order."""
        offsets = {"start": 0.0, **self._offsets(utterance), "end": utterance.duration}
        points = self.timing.points
        return dict(zip(points, accumulate((offsets[sync] for sync in points), max), strict=True))

    def _retime(self) -> None:
        """Give its points the times that are known now; those of a changed pace are asked for (`misplaced`)."""
        if self._stretched is None:
            self.timing = self._timed(self._ordered(self.utterance))
        else:
            self._follow(self._stretched)
            self._take_timing(self._loosened(self._elastic))
        self.wake()

    def _follow(self, stretched: StretchedUtterance) -> None:
        """Have what is not made follow its sync points and its rate."""
        before, origin = stretched.course, self.origin
        if self._follows and (origin is not None or self.timing.rigid):
            stretched.follow(() if origin is None else self._goals(origin), self._rate.value)
            if stretched.course is not before:
                self._take_timing(self._loosened(self._elastic))

    def _take_timing(self, timing: Timing) -> None:
        self.timing = timing
        self.shortest = [phase.shortest for phase in timing.phases]

    def _loosened(self, count: int) -> Timing:
        """A timing of which some phases, the first ones, can be stretched within limits; the others are as planned."""
        utterance = self._heard_as.utterance
        limits, spoken = stretch_limits(utterance), self._ordered(utterance)
        phases = list(timing_at(self._ordered(self.utterance), PhaseKind.RIGID).phases)
        for k, (begin, end) in enumerate(pairwise([*spoken.values()][: count + 1])):
            pauses = sum(1 for each in limits.pauses if begin < each <= end)
            longest = limits.most * (end - begin) + _LONGEST_PAUSE * pauses
            elastic = Phase(end - begin, maximum=longest, shortest=limits.least * (end - begin))
            phases[k] = elastic if end > begin else Phase(0.0, PhaseKind.RIGID)
        return Timing(tuple(spoken), tuple(phases))

    def _taken_over(self, now: GlobalTime) -> StretchedUtterance:
        """What goes on, from the next word that no client has heard of yet, instead of what the voice has made."""
        heard, spoken = 0.0 if (origin := self.origin) is None else now - origin + _AHEAD, self._spoken
        if heard <= 0.0 or (self.hearing is None and origin is None):
            return StretchedUtterance(spoken.utterance)
        begin = border_after(spoken.timed, heard)
        if spoken.next_part is not None:
            begin = min(begin, spoken.next_part)
        spoken.sounds[:] = [each._replace(until=begin) for each in spoken.sounds]
        return StretchedUtterance(spoken.utterance, spoken.course, begin, spoken.sounds)

    def _pause(self, until: GlobalTime) -> None:
        """Have what is not made not begin before a time."""
        if self.hearing is not None:
            self._heard_as.pause(until - self.hearing.origin)

    def _positions_ahead(self, stretched: StretchedUtterance) -> list[tuple[SyncPoint, float]]:
        """The points that have not fired, with their positions in the utterance as it was made, s."""
        positions = self._ordered(stretched.utterance)
        return [(point, positions[point.id]) for point in self.ahead()]

    def _goals(self, origin: GlobalTime) -> list[tuple[float, float]]:
        """When positions of the utterance are to be heard, s after its start: those of points that constraints name."""
        if self._stretched is None or self.timing.rigid:
            return []
        return [
            (point.peg.value - origin, position)
            for point, position in self._positions_ahead(self._stretched)
            if point.tied and point.peg.value is not None
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


def _is_off(planned: Time, heard: GlobalTime, now: GlobalTime, slack: float) -> bool:
    """Whether a point is to come when it is heard, instead of when it is planned; ``slack`` in s."""
    return heard < now + _AHEAD if planned is None else abs(planned - heard) > slack


def _word_points(behavior: Speech, utterance: Utterance) -> dict[str, int]:
    """The indices of words by their sync points; a mark keeps its name."""
    marks = {mark.id for mark in behavior.marks}
    points = {f"word{index}": index for index in range(len(utterance.words))}
    return {sync: index for sync, index in points.items() if sync not in marks}
