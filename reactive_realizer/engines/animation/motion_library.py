"""From a behavior to the motions that could play it: the gesture binding, and who makes what it names."""

import logging
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from contextlib import suppress
from dataclasses import replace

from reactive_realizer.binding.gesture_binding import GestureBinding
from reactive_realizer.binding.seen import seen
from reactive_realizer.binding.unit_spec import UnitSpec
from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.behaviors import Head
from reactive_realizer.engines.animation.actor import Actor, LookingMaker, SlowMaker, Wanted
from reactive_realizer.engines.animation.choice import Choice, Choices
from reactive_realizer.engines.animation.gaze.gaze_maker import DYNAMIC
from reactive_realizer.engines.animation.in_vain import GROUP, left_out, listed, named_in_vain, said_in_vain
from reactive_realizer.engines.animation.makers import makers_of
from reactive_realizer.engines.animation.motion_unit import FILE, MotionUnit
from reactive_realizer.engines.animation.values import values_of
from reactive_realizer.errors import Fault, RealizerError, error
from reactive_realizer.planunit.parameter import spelled

_log = logging.getLogger(__name__)


class MotionLibrary:
    """Makes motions for one character.

    Attributes:
        binding: what the entries say.
        extensions: namespaced attributes that it understands.
    """

    extensions = frozenset({DYNAMIC})

    def __init__(self, binding: GestureBinding, actor: Actor) -> None:
        self.binding = binding
        self._makers = makers_of(actor)
        makers: Mapping[str, object] = self._makers
        self._slow = {unit: maker for unit, maker in makers.items() if isinstance(maker, SlowMaker)}
        self._looking = [maker for maker in makers.values() if isinstance(maker, LookingMaker)]
        self._reads = {(spec.behavior, spec.namespace) for spec in binding.specs if spec.unit in self._slow}
        self._noted: set[UnitSpec] = set()
        self._judged: set[UnitSpec] = set()

    def choices(self, behavior: Behavior) -> Choices:
        """The motions that could play a behavior.

        An entry of the binding whose file or unit is not there is passed over; one without constraints is for what no
        entry before it plays.

        Raises:
            RealizerError: no entry fits, or none of those that do can be made: what is wrong with the best one.
        """
        attributes = seen(behavior)
        specs = self.binding.match(behavior.name, behavior.namespace, attributes)
        if not specs:
            said = self.binding.chooses_by(behavior.name, behavior.namespace) & attributes.keys()
            words = " and ".join(f"{name}='{attributes[name]}'" for name in sorted(said))
            raise error("no-motion-for", element=behavior.name, said=f" with {words}" if words else "")
        return Choices(self._made(specs, behavior, attributes))

    def look_again(self) -> None:
        """Files are looked at once for all behaviors of a block: the next ones are of another."""
        for maker in self._looking:
            maker.look_again()

    def _made(self, specs: Iterable[UnitSpec], behavior: Behavior, attributes: Mapping[str, str]) -> Iterator[Choice]:
        refused: dict[UnitSpec, Fault] = {}
        some = False
        for spec in specs:
            if some and not spec.constraints:
                continue
            try:
                choice = self.choice(spec, behavior, attributes)
            except RealizerError as problem:
                refused[spec] = problem.fault
            else:
                some = True
                self._note(refused)
                yield choice
        if not some:
            raise RealizerError(next(iter(refused.values())))
        self._note(refused)

    def readings(self, behavior: Behavior) -> list[Callable[[], object]]:
        """The work of `SlowMaker`s for a behavior; what they cannot make is told when it is made."""
        if (behavior.name, behavior.namespace) not in self._reads:
            return []
        attributes = seen(behavior)
        works: list[Callable[[], object] | None] = []
        for spec in self.binding.match(behavior.name, behavior.namespace, attributes):
            if spec.unit in self._slow:
                with suppress(RealizerError):
                    works.append(self._slow[spec.unit].reading(_wanted(spec, behavior, attributes)))
        return [work for work in works if work is not None]

    def _note(self, refused: Mapping[UnitSpec, Fault]) -> None:
        """Log entries that are passed over, each once."""
        # One without constraints promises nothing: that it has nothing for this behavior is no fault of it.
        new = [spec for spec in refused if spec.constraints and spec not in self._noted]
        for spec in new:
            _log.warning("%s: this entry does not play: %s", spec.place, refused[spec].sentence)
        self._noted.update(new)

    def _judge(self, spec: UnitSpec, motion: MotionUnit) -> None:
        """Log what an entry says in vain, once."""
        self._judged.add(spec)
        if names := named_in_vain(spec, motion):
            lacks, has = listed(names), listed(motion.known)
            _log.warning("%s: the motion of this entry has no parameter %s; it has %s", spec.place, lacks, has)

    def choice(self, spec: UnitSpec, behavior: Behavior, attributes: Mapping[str, str]) -> Choice:
        """The motion that an entry of the binding has for a behavior with these attributes.

        Raises:
            RealizerError: it cannot be made, or what is said for a parameter is none of its values.
        """
        maker = self._makers.get(spec.unit)
        if maker is None:
            raise error("no-unit", unit=spec.unit)
        wanted = _wanted(spec, behavior, attributes)
        motion, parameters = maker(wanted), wanted.parameters
        if behavior.parameters:
            own = _spelled(behavior.parameters, motion.known | {GROUP} | spec.parameter_map.keys())
            if own != behavior.parameters:
                renamed = replace(behavior, parameters=own)
                return self.choice(spec, renamed, seen(renamed))
        if spec not in self._judged and wanted.file == spec.file:
            self._judge(spec, motion)
        group = parameters.get(GROUP)
        yields = group is not None or motion.lasts is not None or behavior.persistent
        notes = filter(None, (said_in_vain(spec, behavior, motion), left_out(spec, behavior, motion)))
        choice = Choice(motion, _names(spec, motion), group, yields, tuple(notes))
        said = {name: parameters[own] for name, own in choice.names.items() if own in parameters}
        values_of(said, {name: choice.range(name) for name in said})
        return choice


def _wanted(spec: UnitSpec, behavior: Behavior, attributes: Mapping[str, str]) -> Wanted:
    parameters = spec.parameters(attributes, behavior.parameters)
    file = parameters.get(FILE, spec.file)
    # Nodding adds to whatever the head does.
    return Wanted(behavior, parameters, file, added=isinstance(behavior, Head))


def _spelled(said: Mapping[str, str], known: Collection[str]) -> Mapping[str, str]:
    """What is said, by names as those spell them who know them."""
    return {spelled(name, known): value for name, value in said.items()}


def _names(spec: UnitSpec, motion: MotionUnit) -> Mapping[str, str]:
    """The motion's parameters as BML calls them."""
    mapped = {own: name for name, own in spec.parameter_map.items()}
    return {mapped.get(own, own): own for own in motion.ranges}
