"""What the engines of a scene would make of a block, without any of it being played."""

import logging
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.block import BehaviorBlock
from reactive_realizer.bml.procedure import DefineProc
from reactive_realizer.engine.engine import Engine
from reactive_realizer.errors import Fault, RealizerError
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.scheduler.cast import Cast

logger = logging.getLogger(__name__)


@dataclass(frozen=True, slots=True)
class Rehearsal:
    """What would come of the behaviors of a block.

    Attributes:
        engines: who would play each, by its id; nobody plays those that are not there.
        units: what they made, by id.
        faults: why they could not make the others.
    """

    engines: Mapping[str, Engine]
    units: Mapping[str, PlanUnit]
    faults: Sequence[Fault]


async def rehearse(block: BehaviorBlock | DefineProc, cast: Cast) -> Rehearsal:
    """Have the engines of its character make what they can of a block, in document order.

    What earlier blocks leave behind, they do not know. Nobody plays for a character that is not there.
    """
    character = (isinstance(block, BehaviorBlock) and block.character) or cast.characters[0]
    played = cast.engines_for(character, block.behaviors) if character in cast.characters else {}
    units: dict[str, PlanUnit] = {}
    faults: list[Fault] = []
    for id_, (behavior, engine) in played.items():
        place = behavior.location
        try:
            units[id_] = await _unit(BlockKey(character, block.id), behavior, engine)
        except RealizerError as refused:
            faults.append(refused.fault.located(place.line, place.column))
        except Exception as failure:
            logger.exception("%s could not be made", id_)
            faults.append(Fault("work-failed", {"reason": failure}, place.line, place.column))
    return Rehearsal({id_: engine for id_, (_, engine) in played.items()}, units, faults)


async def _unit(block: BlockKey, behavior: Behavior, engine: Engine) -> PlanUnit:
    """A unit for the best of its forms that can be made.

    Raises:
        RealizerError: none can; what is wrong with the behavior itself.
    """
    forms = [form for form in behavior.forms if engine.supports(form)]
    work = engine.prepare(forms[0])
    prepared = None if work is None else await work
    for form in forms[:-1]:
        with suppress(RealizerError):
            return engine.plan(block, form, prepared)
    return engine.plan(block, forms[-1], prepared)
