"""Makes motions of keyframe animations, captures and blends."""

import logging
from collections.abc import Callable, Collection
from functools import lru_cache, partial
from pathlib import Path

from reactive_realizer.binding.asset_file import parse_boolean
from reactive_realizer.bml.extensions import Keyframe
from reactive_realizer.bml.vocabulary import BodyGroup
from reactive_realizer.engines.animation.faults import NoGroup, NoJoints
from reactive_realizer.engines.animation.key_poses.body_groups import group_joints
from reactive_realizer.engines.animation.keyframe.blend_files import AXES, BLEND, BlendFile, read_blend
from reactive_realizer.engines.animation.keyframe.blend_space import BlendSpace
from reactive_realizer.engines.animation.keyframe.clip import Clip
from reactive_realizer.engines.animation.keyframe.clip_files import CLIPS, load_clip, preload_clip
from reactive_realizer.engines.animation.keyframe.clip_mix import ClipMix, relative, seamless
from reactive_realizer.engines.animation.keyframe.keyframe_files import read_interpolator_text
from reactive_realizer.engines.animation.motion_maker import MakerContext, MotionRequest
from reactive_realizer.engines.animation.motion_parameters import parameter_values
from reactive_realizer.engines.animation.motion_unit import (
    ANY_VALUE,
)
from reactive_realizer.engines.animation.motions.blend import BlendMotionUnit
from reactive_realizer.engines.animation.motions.keyframe import (
    ADDITIVE,
    BELOW,
    FADE_IN,
    FADE_OUT,
    FILTER,
    FIXED,
    GROUP,
    LOOP,
    SPEED,
    KeyframeMotionUnit,
)
from reactive_realizer.errors import RealizerError
from reactive_realizer.planunit.parameter import Range

_log = logging.getLogger(__name__)

_RANGES = {FILTER: Range(0.0, 1e6), SPEED: Range(0.05, 20.0), FADE_IN: Range(0.0, 1.0), FADE_OUT: Range(0.0, 1.0)}


class KeyframeMaker:
    """Makes motions of keyframes in BML or in files.

    Parameters are `mirror`, then `joints`, a selection (thesis C.1.2), `group` or `below`; `filter`, a low-pass, Hz
    (3.2.2.2); `speed`, `fadeIn` and `fadeOut`; `loop` and `additive`; and those of a blend, `x`, `y` and `z`.
    """

    def __init__(self, context: MakerContext) -> None:
        self._context = context
        self._skeleton = context.humanoid.avatar.skeleton

    def __call__(self, request: MotionRequest) -> KeyframeMotionUnit | BlendMotionUnit:
        """Make a motion."""
        values = parameter_values(request.parameters, _RANGES)
        fades = values.get(FADE_IN, 0.0), values.get(FADE_OUT, 0.0)
        speed, rest = values.get(SPEED, 1.0), self._context.rest.body
        loops, adds = (parse_boolean(name, request.parameters.get(name, "false")) for name in (LOOP, ADDITIVE))
        blend = self._blend(request)
        if blend is None and not loops and not adds:
            clip, lacking = self._fitted(self._clip(request), request)
            return KeyframeMotionUnit(clip, rest, lacking, fades, speed)
        clips = [self._clip(request)] if blend is None else [self._loaded(file, request) for file in blend.files]
        fitted = [self._fitted(clip, request) for clip in clips]
        changed = [_changed(clip, loops=loops, adds=adds) for clip, _ in fitted]
        space = BlendSpace([()]) if blend is None else blend.space
        return BlendMotionUnit(
            ClipMix.of(changed, None if blend is None else blend.marks(changed)),
            space,
            rest,
            _place(request, space),
            loops=loops,
            adds=adds,
            speed=speed,
            fades=fades,
            fixed=FIXED,
            lacking=frozenset().union(*(lacking for _, lacking in fitted)),
        )

    def _fitted(self, clip: Clip, request: MotionRequest) -> tuple[Clip, frozenset[str]]:
        """Return a clip as it is requested, for the joints that the figure has, and the joints that are lacking."""
        clip = clip.mirrored() if request.mirror else clip
        chosen = request.joints or self._group(request, clip)
        clip, lacking = clip.only(chosen), chosen.difference(clip.joints)
        clip = clip.folded(self._skeleton.joints)
        lacking |= frozenset(clip.joints).difference(self._skeleton.joints)
        wanted = self._below(request)
        there = [joint for joint in clip.joints if joint in wanted]
        if not there:
            raise RealizerError(NoJoints(joints=tuple(sorted(lacking)), element=request.behavior.name))
        if lacking:
            _log_once(clip.name, ", ".join(sorted(lacking)))
        return clip.only(there), lacking

    def _below(self, request: MotionRequest) -> Collection[str]:
        """Return the joints of the figure to which a motion is restricted: a joint and all below it, or all.

        Raises:
            RealizerError: "no-joints": the figure lacks the joint.
        """
        name = request.parameters.get(BELOW)
        if name is None:
            return self._skeleton.joints
        if name not in self._skeleton:
            raise RealizerError(NoJoints(joints=(name,), element=request.behavior.name))
        return self._skeleton.carried([name])

    def _group(self, request: MotionRequest, clip: Clip) -> frozenset[str]:
        """Return the joints of the clip that are in the requested group, by default all.

        Raises:
            RealizerError: there is no such group, or the clip has none of its joints.
        """
        name = request.parameters.get(GROUP)
        if name is None:
            return frozenset(clip.joints)
        if name not in tuple(BodyGroup):
            raise RealizerError(NoGroup(group=name, known=tuple(BodyGroup)))
        joints = frozenset(group_joints(BodyGroup(name), self._skeleton))
        return joints & frozenset(clip.joints) or joints

    def preload(self, request: MotionRequest) -> Callable[[], object] | None:
        """Return the loading work; None for keyframes in BML, which are short."""
        if _inline_keyframes(request):
            return None
        blend = self._blend(request)
        files = [self._file(request)] if blend is None else map(self._context.asset, blend.files)
        works = [partial(preload_clip, file, self._skeleton, _cutoff(request)) for file in files]
        return lambda: [work() for work in works]

    def _blend(self, request: MotionRequest) -> BlendFile | None:
        """Return the blend that is requested, if it is one and not a clip."""
        if _inline_keyframes(request):
            return None
        path = self._file(request)
        return read_blend(path) if path.name.endswith(f".{BLEND}") else None

    def _loaded(self, file: str, request: MotionRequest) -> Clip:
        return load_clip(self._context.asset(file), self._skeleton, _cutoff(request))

    def _clip(self, request: MotionRequest) -> Clip:
        if inline := _inline_keyframes(request):
            return read_interpolator_text(inline, request.behavior.id).filtered(_cutoff(request) or 0.0)
        return load_clip(self._file(request), self._skeleton, _cutoff(request))

    def _file(self, request: MotionRequest) -> Path:
        return self._context.file_of(request, *CLIPS, BLEND)


def _changed(clip: Clip, *, loops: bool, adds: bool) -> Clip:
    clip = seamless(clip) if loops else clip
    return relative(clip) if adds else clip


def _place(request: MotionRequest, space: BlendSpace) -> dict[str, float]:
    """Return the values of the parameters of a blend: without any, the place of its first motion; else 0 for others."""
    axes = AXES[: space.size]
    given = parameter_values(request.parameters, dict.fromkeys(axes, ANY_VALUE))
    usual = dict.fromkeys(axes, 0.0) if given else dict(zip(axes, space.places[0], strict=True))
    return usual | given


@lru_cache
def _log_once(clip: str, lacking: str) -> None:
    """Log missing joints once."""
    _log.warning("%s: joints that the clip or the figure lacks are left out: %s", clip, lacking)


def _inline_keyframes(request: MotionRequest) -> str | None:
    """Return the animation inside the behavior, if any."""
    return request.behavior.interpolator if isinstance(request.behavior, Keyframe) else None


def _cutoff(request: MotionRequest) -> float | None:
    return parameter_values(request.parameters, _RANGES).get(FILTER)
