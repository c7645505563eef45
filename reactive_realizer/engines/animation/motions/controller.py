"""Controllers as motions: they move joints by forces and show no pose of their own (thesis C.1.4)."""

import logging
from collections.abc import Iterator
from pathlib import Path

from reactive_realizer.binding.asset_file import XmlElement, asset_error, attribute, read_xml
from reactive_realizer.bml.names import BMLT
from reactive_realizer.embodiment.body import Body, Skeleton
from reactive_realizer.embodiment.pose import LayerKind
from reactive_realizer.engines.animation.motion_maker import MakerContext, MotionRequest
from reactive_realizer.engines.animation.motion_parameters import parameter_values
from reactive_realizer.engines.animation.motion_unit import FILE, NAME, Moment, MotionPose, MotionUnit
from reactive_realizer.errors import RealizerError
from reactive_realizer.physics.controllers.catalog import new_controller
from reactive_realizer.physics.controllers.compound import CompoundController
from reactive_realizer.physics.controllers.controller import PhysicalController
from reactive_realizer.physics.faults import SimulationFailed
from reactive_realizer.planunit.parameter import Range

CLASS = "class"
"""Parameter for the kind of controller."""

_COMPOUND = "CompoundController"

_NO_POSE = MotionPose({})

_log = logging.getLogger(__name__)


class ControllerMotionUnit(MotionUnit):
    """Has a controller act on the figure while it plays.

    Attributes:
        controller: that acts.
    """

    kind = LayerKind.POSTURE
    preferred_duration = 1.0

    def __init__(self, controller: PhysicalController) -> None:
        self.controller = controller
        self.parameters = dict(controller.parameters)
        self.ranges = {name: Range(*limits) for name, limits in controller.ranges.items()}
        self.fixed = controller.fixed | {CLASS, NAME, FILE}
        self.joints = controller.joints | controller.desired

    def start(self, body: Body) -> None:
        """Start; the simulation goes on from the pose and the velocities of the figure."""

    def pose(self, moment: Moment) -> MotionPose:
        """Return no rotations, and give the controller the present values of its parameters.

        Raises:
            RealizerError: "simulation-failed".
        """
        if self.controller.failed:
            raise RealizerError(SimulationFailed())
        values = dict(self.parameters)
        if values != self.controller.parameters:
            self.controller.parameters = values
        return _NO_POSE


class ControllerMaker:
    """Makes controllers by the class that a behavior or the binding names.

    A compound controller is read from the file that the binding or the behavior names.
    """

    def __init__(self, context: MakerContext) -> None:
        self._context = context

    def __call__(self, request: MotionRequest) -> ControllerMotionUnit:
        """Make a motion."""
        controller = self._controller(request)
        controller.parameters = {
            **controller.parameters,
            **parameter_values(
                request.parameters, {name: Range(*limits) for name, limits in controller.ranges.items()}
            ),
        }
        return ControllerMotionUnit(controller)

    def _controller(self, request: MotionRequest) -> PhysicalController:
        skeleton, kind = self._context.humanoid.avatar.skeleton, request.parameters.get(CLASS, _COMPOUND)
        if kind.rpartition(".")[2] == _COMPOUND:
            return read_compound(self._context.file_of(request, "xml"), skeleton)
        return new_controller(kind, request.parameters, skeleton)


def read_compound(path: Path, skeleton: Skeleton) -> CompoundController:
    """Read a compound controller (thesis figure 4.2). A desired part that cannot be made is left out and logged.

    Args:
        path: of its file.
        skeleton: of the figure.

    Raises:
        RealizerError: "bad-asset", with file, line and element: the file or a required part is wrong.
        OSError: the file cannot be read.
    """
    root = read_xml(path, _COMPOUND)
    return CompoundController(dict(_parts(root, "required", skeleton)), dict(_parts(root, "desired", skeleton)))


def _parts(root: XmlElement, need: str, skeleton: Skeleton) -> Iterator[tuple[str, PhysicalController]]:
    for element in root.iterfind(f"{need}/Controller"):
        try:
            yield attribute(element, "id"), _part(element, skeleton)
        except RealizerError as problem:
            if need == "required":
                raise
            _log.warning("%s; it is left out", problem.fault.sentence)


def _part(element: XmlElement, skeleton: Skeleton) -> PhysicalController:
    given = {attribute(each, "name"): attribute(each, "value") for each in element.iterfind(f"{{{BMLT}}}parameter")}
    try:
        controller = new_controller(attribute(element, "class"), given, skeleton)
        own = parameter_values(given, {name: Range(*limits) for name, limits in controller.ranges.items()})
    except RealizerError as problem:
        raise asset_error(element, problem.fault.sentence) from problem
    controller.parameters = {**controller.parameters, **own}
    return controller
