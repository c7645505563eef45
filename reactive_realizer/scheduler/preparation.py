"""The slow part of planning a block: what its engines need first."""

from collections.abc import Callable, Mapping

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.engine.engine import Engine
from reactive_realizer.errors import RealizerError, error
from reactive_realizer.scheduler.workshop import Result, Workshop


class Preparation:
    """Waits for the slow work of all behaviors of a block."""

    def __init__(self, engines: Mapping[str, tuple[Behavior, Engine]], workshop: Workshop) -> None:
        self.engines = engines
        self._results: dict[str, Result] = {}
        self._workshop = workshop
        self._cancels: list[Callable[[], None]] = []

    @property
    def complete(self) -> bool:
        """Whether nothing is outstanding."""
        return len(self._results) == len(self.engines)

    def begin(self) -> None:
        """Request the work."""
        for id_, (behavior, engine) in self.engines.items():
            try:
                work = engine.prepare(next(form for form in behavior.forms if engine.supports(form)))
            except Exception as failure:
                self._results[id_] = failure
                continue
            if work is None:
                self._results[id_] = None
            else:
                self._cancels.append(self._workshop.request(f"{engine.name} {id_}", work, self._receiver(id_)))

    def result(self, id_: str) -> object:
        """What the work for a behavior gave, None where it needed none.

        Raises:
            RealizerError: the work failed.
        """
        result = self._results[id_]
        if isinstance(result, RealizerError):
            raise result
        if isinstance(result, Exception):
            raise error("work-failed", reason=result) from result
        return result

    def cancel(self) -> None:
        """Give the work up."""
        for cancel in self._cancels:
            cancel()

    def _receiver(self, id_: str) -> Callable[[Result, GlobalTime], None]:
        def receive(result: Result, now: GlobalTime) -> None:
            self._results[id_] = result

        return receive
