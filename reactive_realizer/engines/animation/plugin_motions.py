"""Kinds of motion of plug-ins, whose failures cost only their own behaviors."""

import logging
import math
from collections.abc import Callable, Collection, Mapping

from reactive_realizer.embodiment.pose import LayerKind
from reactive_realizer.engine.faults import TwoPlugins
from reactive_realizer.engines.animation.faults import BadMotion
from reactive_realizer.engines.animation.motion_maker import MakerContext, MotionMaker, MotionRequest
from reactive_realizer.engines.animation.motion_unit import MotionUnit
from reactive_realizer.errors import RealizerError

_log = logging.getLogger(__name__)

PluginMakers = Mapping[str, Callable[[MakerContext], MotionMaker]]
"""Kind of motion -> creates its maker for a figure."""


def plugin_makers(context: MakerContext, plugins: PluginMakers, own: Collection[str]) -> dict[str, MotionMaker]:
    """Return the makers of plug-ins for a figure. One that cannot be created is logged and left out.

    Args:
        context: of the figure.
        plugins: the kinds of motion.
        own: the kinds of the package, which no plug-in may have.

    Raises:
        RealizerError: "two-plugins".
    """
    makers: dict[str, MotionMaker] = {}
    for kind, create in plugins.items():
        if kind in own:
            raise RealizerError(TwoPlugins(name=kind, group="motions", known=("the package", "a plug-in")))
        try:
            makers[kind] = _CheckedMaker(kind, create(context))
        except Exception:
            _log.exception("the kind of motion '%s' of a plug-in cannot be created, and is left out", kind)
    return makers


class _CheckedMaker:
    """Checks what the maker of a plug-in makes: the engine plays it together with the motions of others."""

    def __init__(self, kind: str, maker: MotionMaker) -> None:
        self._kind = kind
        self._maker = maker

    def __call__(self, request: MotionRequest) -> MotionUnit:
        """Make a motion.

        Raises:
            RealizerError: "bad-motion", or what the maker raises.
        """
        motion: object = self._maker(request)
        if not isinstance(motion, MotionUnit):
            raise self._bad(f"is made as {type(motion).__name__}, which is no MotionUnit")
        if not isinstance(motion.kind, LayerKind):
            raise self._bad(f"has the layer {motion.kind!r}, which is no LayerKind")
        if not 0.0 < motion.preferred_duration < math.inf:
            raise self._bad(f"has the preferred duration {motion.preferred_duration:g} s")
        return motion

    def _bad(self, reason: str) -> RealizerError:
        return RealizerError(BadMotion(kind=self._kind, reason=reason))
