"""Finds the motions that could play a behavior: entries of the gesture binding, and the makers that they name."""

import logging
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import suppress
from dataclasses import replace
from functools import partial
from types import MappingProxyType

from reactive_realizer.binding.gesture_binding import GestureBinding
from reactive_realizer.binding.unit_spec import UnitSpec, behavior_attributes
from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.behaviors import REACH, REFERENCE, Head
from reactive_realizer.bml.vocabulary import Influence
from reactive_realizer.engines.animation.candidates import Candidate, Candidates
from reactive_realizer.engines.animation.faults import NoMotionFor, NoUnit
from reactive_realizer.engines.animation.motion_maker import (
    ListingMaker,
    MakerContext,
    MotionMaker,
    MotionRequest,
    PreloadingMaker,
    RefreshingMaker,
)
from reactive_realizer.engines.animation.motion_parameters import (
    REPLACEMENT_GROUP,
    listed,
    missing_joints_fault,
    parameter_values,
    unused_behavior_parameters,
    unused_entry_parameters,
)
from reactive_realizer.engines.animation.motion_unit import FILE, NAME, MotionUnit
from reactive_realizer.engines.animation.motions.controller import ControllerMaker
from reactive_realizer.engines.animation.motions.embr_gesture import EmbrGestureMaker
from reactive_realizer.engines.animation.motions.gaze import DYNAMIC, GazeMaker, HeadDirectionMaker
from reactive_realizer.engines.animation.motions.gesture import GestureMaker
from reactive_realizer.engines.animation.motions.glance import GlanceMaker
from reactive_realizer.engines.animation.motions.greta_gesture import GretaGestureMaker
from reactive_realizer.engines.animation.motions.greta_spine import GretaSpineMaker
from reactive_realizer.engines.animation.motions.key_poses_maker import KeyPosesMaker
from reactive_realizer.engines.animation.motions.keyframe_maker import KeyframeMaker
from reactive_realizer.engines.animation.motions.locomotion import LocomotionMaker
from reactive_realizer.engines.animation.motions.murml import MurmlMaker
from reactive_realizer.engines.animation.motions.noise import NoiseMaker
from reactive_realizer.engines.animation.motions.pointing_maker import PointingMaker
from reactive_realizer.engines.animation.motions.posture import PostureMaker
from reactive_realizer.engines.animation.motions.procedural import ProceduralMotionMaker
from reactive_realizer.engines.animation.motions.release import ReleaseMaker
from reactive_realizer.engines.animation.motions.sequence_maker import SequenceMaker
from reactive_realizer.engines.animation.motions.transition import TransitionMaker
from reactive_realizer.engines.animation.plugin_motions import PluginMakers, plugin_makers
from reactive_realizer.errors import Fault, RealizerError
from reactive_realizer.planunit.parameter import spelled

_SEQUENCE = "Sequence"

MAKERS: Mapping[str, Callable[[MakerContext], MotionMaker]] = MappingProxyType(
    {
        "ProcAnimation": ProceduralMotionMaker,
        "Gesture": GestureMaker,
        "gaze": GazeMaker,
        "dynamic-gaze": partial(GazeMaker, follow=True),
        "eye-gaze": partial(GazeMaker, influence=Influence.EYES),
        "gaze-shift": GazeMaker,
        "rest-gaze": partial(GazeMaker, follow=True),
        "head-direction": HeadDirectionMaker,
        "glance": GlanceMaker,
        "pointing": PointingMaker,
        "release": ReleaseMaker,
        "Keyframe": KeyframeMaker,
        "noise": NoiseMaker,
        "transition": TransitionMaker,
        "key-poses": KeyPosesMaker,
        "MURML": MurmlMaker,
        "EMBRScript": EmbrGestureMaker,
        "GretaGesture": GretaGestureMaker,
        "GretaHead": partial(GretaSpineMaker, part="head"),
        "GretaTorso": partial(GretaSpineMaker, part="torso"),
        "locomotion": LocomotionMaker,
        "posture": PostureMaker,
        "posture-shift": PostureMaker,
        "PhysicalController": ControllerMaker,
        "CompoundController": ControllerMaker,
    }
)
"""Id of a kind of motion -> creates its maker for a figure."""


def makers_of(context: MakerContext, plugins: PluginMakers) -> Mapping[str, MotionMaker]:
    """Return the makers of a figure by the id of their kind. Sequences are made of the motions of the others.

    Raises:
        RealizerError: "two-plugins": a plug-in has the name of a kind of motion of the package.
    """
    makers = plugin_makers(context, plugins, {*MAKERS, _SEQUENCE})
    makers |= {kind: maker(context) for kind, maker in MAKERS.items()}
    makers[_SEQUENCE] = SequenceMaker(context, makers)
    return makers


_log = logging.getLogger(__name__)

LEXEME = "lexeme"
"""The attribute with the word of a behavior."""


class MotionLibrary:
    """Makes motions for one character.

    Attributes:
        binding: with the entries to choose from.
        extensions: namespaced attributes that motions use.
    """

    extensions = frozenset({DYNAMIC, REACH, REFERENCE})

    def __init__(self, binding: GestureBinding, context: MakerContext, plugins: PluginMakers) -> None:
        self.binding = binding
        self._makers = makers_of(context, plugins)
        makers: Mapping[str, object] = self._makers
        self._preloading = {unit: maker for unit, maker in makers.items() if isinstance(maker, PreloadingMaker)}
        self._refreshing = [maker for maker in makers.values() if isinstance(maker, RefreshingMaker)]
        self._preloaded = {(spec.behavior, spec.namespace) for spec in binding.specs if spec.unit in self._preloading}
        self._refused_specs: set[UnitSpec] = set()
        self._checked_specs: set[UnitSpec] = set()

    def candidates(self, behavior: Behavior) -> Candidates:
        """Return the motions that could play a behavior.

        An entry of the binding whose file or unit is missing is skipped; an entry without constraints is used only if
        no entry before it plays.

        Raises:
            RealizerError: no entry fits, or none of those that fit can be made; the error of the best one is raised.
        """
        attributes = behavior_attributes(behavior)
        specs = self.binding.match(behavior.name, behavior.namespace, attributes)
        if not specs:
            raise RealizerError(self._no_motion(behavior, attributes))
        return Candidates(self._made(specs, behavior, attributes))

    def _no_motion(self, behavior: Behavior, attributes: Mapping[str, str]) -> Fault:
        """Return the fault of a behavior that no entry fits."""
        values = self.binding.constrained_values(behavior.name, behavior.namespace)
        named = sorted(values.keys() & attributes.keys())
        conditions = " and ".join(f"{name}='{attributes[name]}'" for name in named)
        return NoMotionFor(
            element=behavior.name,
            condition=f" with {conditions}" if conditions else "",
            words=tuple(
                attributes[name] for name in named if spelled(attributes[name], values[name]) not in values[name]
            ),
            known=tuple(value for name in named for value in values[name]),
        )

    def refresh(self) -> None:
        """Look for changed files. This happens once for all behaviors of a block."""
        for maker in self._refreshing:
            maker.refresh()

    def _made(
        self, specs: Iterable[UnitSpec], behavior: Behavior, attributes: Mapping[str, str]
    ) -> Iterator[Candidate]:
        refused: dict[UnitSpec, Fault] = {}
        some = False
        for spec in specs:
            if some and not spec.constraints:
                continue
            try:
                candidate = self.candidate(spec, behavior, attributes)
            except RealizerError as problem:
                refused[spec] = problem.fault
            else:
                some = True
                self._log_refused(refused)
                yield candidate
        if not some:
            raise RealizerError(next(iter(refused.values())))
        self._log_refused(refused)

    def preloads(self, behavior: Behavior) -> list[Callable[[], object]]:
        """Return the loading work of `PreloadingMaker`s for a behavior.

        Its errors are raised again when the motion is made.
        """
        if (behavior.name, behavior.namespace) not in self._preloaded:
            return []
        attributes = behavior_attributes(behavior)
        works: list[Callable[[], object] | None] = []
        for spec in self.binding.match(behavior.name, behavior.namespace, attributes):
            if spec.unit in self._preloading:
                with suppress(RealizerError):
                    works.append(self._preloading[spec.unit].preload(_request(spec, behavior, attributes)))
        return [work for work in works if work is not None]

    def _log_refused(self, refused: Mapping[UnitSpec, Fault]) -> None:
        """Log skipped entries, each once."""
        # An entry without constraints does not promise to play every behavior.
        new = [spec for spec in refused if spec.constraints and spec not in self._refused_specs]
        for spec in new:
            _log.warning("%s: this entry is skipped: %s", spec.location, refused[spec].sentence)
        self._refused_specs.update(new)

    def _log_unused(self, spec: UnitSpec, motion: MotionUnit) -> None:
        """Log unused parameters of an entry, once."""
        self._checked_specs.add(spec)
        if names := unused_entry_parameters(spec, motion):
            lacks, has = listed(names), listed(motion.parameter_names)
            _log.warning("%s: the motion of this entry has no parameter %s; it has %s", spec.location, lacks, has)

    def names(self, spec: UnitSpec) -> tuple[str, ...] | None:
        """Return the lexemes that an entry for any lexeme plays, if they are those of a library; otherwise None.

        Raises:
            RealizerError: there is no such library, or it is invalid.
        """
        maker: object = self._makers.get(spec.unit)
        if not isinstance(maker, ListingMaker) or LEXEME in spec.constraints or NAME in spec.defaults:
            return None
        return maker.names(spec.file)

    def candidate(self, spec: UnitSpec, behavior: Behavior, attributes: Mapping[str, str]) -> Candidate:
        """Return the motion of an entry for a behavior.

        Args:
            spec: the entry.
            behavior: to play.
            attributes: of the behavior (`behavior_attributes`).

        Raises:
            RealizerError: the motion cannot be made, or a parameter has an invalid value.
        """
        maker = self._makers.get(spec.unit)
        if maker is None:
            raise RealizerError(NoUnit(unit=spec.unit))
        request = _request(spec, behavior, attributes)
        motion, parameters = maker(request), request.parameters
        renamed = _renamed(behavior, spec, motion)
        if renamed is not behavior:
            return self.candidate(spec, renamed, behavior_attributes(renamed))
        if spec not in self._checked_specs and request.file == spec.file:
            self._log_unused(spec, motion)
        group = parameters.get(REPLACEMENT_GROUP)
        yields = group is not None or motion.persists_as is not None or behavior.persistent
        notes = filter(
            None, (unused_behavior_parameters(spec, behavior, motion), missing_joints_fault(spec, behavior, motion))
        )
        candidate = Candidate(motion, _names(spec, motion), group, yields, (*notes, *motion.notes))
        _check_values(candidate, parameters)
        return candidate


def _check_values(candidate: Candidate, parameters: Mapping[str, str]) -> None:
    """Check that the given values of parameters that may change are within their ranges."""
    given = {name: parameters[own] for name, own in candidate.names.items() if own in parameters}
    parameter_values(given, {name: candidate.range(name) for name in given})


def _request(spec: UnitSpec, behavior: Behavior, attributes: Mapping[str, str]) -> MotionRequest:
    parameters = spec.parameters(attributes, behavior.parameters)
    file = parameters.get(FILE, spec.file)
    # Head movements add to other motion of the head.
    return MotionRequest(behavior, parameters, file, added=isinstance(behavior, Head))


def _renamed(behavior: Behavior, spec: UnitSpec, motion: MotionUnit) -> Behavior:
    """Return the behavior with its parameters in the spelling of the known ones; itself if they are spelled so."""
    if not behavior.parameters:
        return behavior
    known = motion.parameter_names | {REPLACEMENT_GROUP} | spec.parameter_map.keys()
    own = {spelled(name, known): value for name, value in behavior.parameters.items()}
    return behavior if own == behavior.parameters else replace(behavior, parameters=own)


def _names(spec: UnitSpec, motion: MotionUnit) -> Mapping[str, str]:
    """Return the parameters of a motion that may change: name in BML -> name in the motion."""
    mapped = {own: name for name, own in spec.parameter_map.items()}
    return {mapped.get(own, own): own for own in motion.ranges}
