"""The plan unit of a speech without sound (thesis 8.11)."""

from collections.abc import Container, Mapping
from itertools import pairwise

from reactive_realizer.bml.vocabulary import InterruptSpeech
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.audio import Caption
from reactive_realizer.engines.speech.course import Course
from reactive_realizer.engines.speech.speech_unit import SpeechUnit
from reactive_realizer.pegboard.time_peg import TimePeg
from reactive_realizer.planunit.sync_point import SyncPoint
from reactive_realizer.planunit.timing import Phase, PhaseKind, Timing


class ElasticSpeech(SpeechUnit):
    """An utterance without sound. Its words are spread evenly between its sync points, also when these move."""

    elastic = True
    _cut_course: Course | None = None

    def position(self, time: GlobalTime) -> float:
        """The position in the utterance that is read at a time, s; 0 before it has started."""
        return 0.0 if self.hearing is None else self._course().position(time)

    def gentle_end(self, time: GlobalTime, speech: InterruptSpeech) -> GlobalTime:
        """The end of the present word or clause: the start of the next one, or the end of the speech."""
        if self.hearing is None:
            return time
        return GlobalTime(self._course().time(self.next_border(time, speech)))

    @property
    def caption(self) -> Caption:
        """Its text, with the times of its words."""
        if not self.points:
            return super().caption
        course = self._course()
        words = self.utterance.words
        return Caption(
            self.utterance.text,
            tuple((course.time(word.start) - course.times[0], word.first, word.last) for word in words),
        )

    @property
    def length(self) -> float:
        """How long it is read, as planned now, s."""
        course = self._course()
        return course.time(self.duration) - course.times[0]

    def detach(self, point: SyncPoint, time: GlobalTime) -> None:
        """As `PlanUnit.detach`, when it is cut; what was read depends on where its points were before."""
        self._cut_course = self._course()
        super().detach(point, time)

    def finish(self, time: GlobalTime, shared: Container[TimePeg]) -> list[SyncPoint]:
        """As `PlanUnit.finish`."""
        self._cut_course = self._course()
        return super().finish(time, shared)

    def _timed(self, offsets: Mapping[str, float]) -> Timing:
        """A timing whose phases can be stretched within the limits of the utterance."""
        least, most = self.utterance.stretch or (1.0, 1.0)
        durations = [end - begin for begin, end in pairwise(offsets.values())]
        phases = (
            Phase(each, PhaseKind.ELASTIC, maximum=most * each, shortest=least * each) if each else Phase(each)
            for each in durations
        )
        return Timing(tuple(offsets), tuple(phases))

    def _course(self) -> Course:
        if self._cut_course is not None:
            return self._cut_course
        positions = dict(zip(self.timing.points, self.timing.offsets, strict=True))
        times = {point.id: point.peg.value for point in self.points}
        known = {sync: time for sync, time in times.items() if time is not None} or {"start": GlobalTime(0.0)}
        return Course([*known.values()], [positions[sync] for sync in known])
