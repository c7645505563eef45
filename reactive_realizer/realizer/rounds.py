"""Plays the rounds of a tick: blocks enter, start and end, and engines play, until nothing changes any more."""

from collections.abc import Callable

from reactive_realizer.clock.ticker import Tick, first_tick
from reactive_realizer.clock.units import GlobalTime, Time, is_due
from reactive_realizer.embodiment.audio import AudioChange
from reactive_realizer.engine.effects import Output
from reactive_realizer.engine.engine_task import EngineTasks
from reactive_realizer.pegboard.pegboard import PegBoard
from reactive_realizer.reactive.cell import Source
from reactive_realizer.scheduler.bml_scheduler import BMLScheduler

_MOST_ROUNDS = 100


class Rounds:
    """Plays ticks."""

    def __init__(
        self,
        board: PegBoard,
        time: Source[GlobalTime],
        scheduler: BMLScheduler,
        leading: EngineTasks,
        following: EngineTasks,
        publish_audio: Callable[[AudioChange], None],
    ) -> None:
        """Prepare to play.

        Args:
            board: of the pegs.
            time: the cell of the present tick's time.
            scheduler: of the blocks.
            leading: the engines that play first in each round, because they request effects on other behaviors.
            following: the others.
            publish_audio: is called with the changes of audio, in the order of engines.
        """
        self._board = board
        self._time = time
        self._scheduler = scheduler
        self._leading = leading
        self._following = following
        self._publish_audio = publish_audio

    async def play(self, tick: Tick) -> list[Output]:
        """Play rounds of the tick until nothing changes, then show its frame, if one is due; the outputs."""
        for _ in range(_MOST_ROUNDS):
            if await self._play_round(tick):
                continue
            shown = self._following.show(tick) if tick.frame else []
            if not self._scheduler.apply([output.effects for output in shown], tick.time):
                return shown
        self._scheduler.fail_restless(_MOST_ROUNDS, tick.time)
        return self._following.show(tick) if tick.frame else []

    async def catch_up(self, tick: Tick, check: Callable[[GlobalTime], None]) -> None:
        """Play the skipped ticks in which something was due, in order and without output.

        Args:
            tick: before which ticks may have been skipped.
            check: is called with the time of each skipped tick that was played.
        """
        due = self._next_due(tick.previous) if tick.left_out else None
        number = tick.left_out.start
        while due is not None and (number := max(number, first_tick(due))) in tick.left_out:
            missed = Tick.on_time(number)
            self._board.begin(missed)
            await self.play(missed)
            check(missed.time)
            due = self._next_due(missed.time)
            number += 1

    def _next_due(self, after: GlobalTime) -> Time:
        """The earliest known time after ``after`` at which a block or an engine has something to do."""
        times = (self._scheduler.next_start, self._leading.next_due, self._following.next_due)
        if any(is_due(time, after) for time in times):  # it hides later ones
            return self._scheduler.next_due(after)
        return min((time for time in times if time is not None), default=None)

    async def _play_round(self, tick: Tick) -> bool:
        """Play one round; whether anything changed."""
        self._scheduler.advance(tick.time)
        self._write_time(tick.time)
        if self._scheduler.apply(await self._leading.play(tick), tick.time):
            return True
        plays = await self._following.play(tick)
        changed = self._scheduler.apply(plays, tick.time)
        for play in plays:
            for change in play.audio:
                self._publish_audio(change)
        return changed or self._scheduler.advance(tick.time)

    def _write_time(self, now: GlobalTime) -> None:
        """Move the cells that depend on the time, if there are any."""
        if self._time.dependents:
            with self._board.graph.transaction("time"):
                self._time.set(now)
