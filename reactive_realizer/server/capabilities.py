"""The capabilities of a scene, for `GET /capabilities`."""

from collections.abc import Mapping
from typing import Any

from reactive_realizer.assembly.registry import names
from reactive_realizer.assembly.scene import Scene
from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.elements import ELEMENTS, Element
from reactive_realizer.engine.lexicon import lexicon_of
from reactive_realizer.engine.sound_unit import VOLUME_RANGE
from reactive_realizer.engine.tts import VoiceCapabilities
from reactive_realizer.pegboard.anticipator import Anticipator
from reactive_realizer.planunit.parameter import Range

Found = Mapping[str, object]
"""Parts of the answer that are read from files: `lexemes` by element, `strategies` and `trajectories`."""


async def capabilities_of(scene: Scene, found: Found) -> dict[str, Any]:
    """The answer: elements, lexemes, voices and what they can do, targets, anticipators and plug-ins."""
    engines = [engine for character in scene.realizer.characters.values() for engine in character.engines]
    realized = frozenset[type[Behavior]]().union(*(engine.behaviors for engine in engines))
    changeable = {behavior: ranges for engine in engines for behavior, ranges in engine.parameters.items()}
    return {
        "elements": {name: _element(element, realized, changeable) for name, element in ELEMENTS.items()},
        **found,
        "parameters": {
            name: sorted(changeable[element.behavior])
            for name, element in ELEMENTS.items()
            if changeable.get(element.behavior)
        },
        "voices": await scene.tts.voices(),
        "tts": _tts(await scene.tts.capabilities()),
        "mediaTypes": scene.realizer.dialects.media_types,
        "targets": list(scene.realizer.world.targets),
        "anticipators": {id_: _anticipator(scene, each) for id_, each in scene.realizer.anticipators.items()},
    }


def _element(
    element: Element, realized: frozenset[type[Behavior]], changeable: Mapping[type[Behavior], Mapping[str, Range]]
) -> dict[str, Any]:
    """The entry of an element; ``parameters`` are those that parametervaluechange may change, with their ranges."""
    parameters = changeable.get(element.behavior, {})
    return {
        "namespace": element.namespace,
        "realized": element.behavior in realized,
        "attributes": [attribute.name for attribute in element.attributes],
        "syncPoints": element.sync_points,
        "parameters": {name: _range(range_) for name, range_ in parameters.items()},
    }


def _tts(capabilities: VoiceCapabilities) -> dict[str, Any]:
    """The entry of the text-to-speech system."""
    return {
        "sound": capabilities.sound,
        "languages": capabilities.languages,
        "markup": sorted(capabilities.markup),
        "stretch": _range(capabilities.stretch_range),
        "volume": _range(VOLUME_RANGE),
        "rate": _range(capabilities.rate_range),
        "pitch": _range(capabilities.pitch_range),
    }


def _range(values: Range | None) -> dict[str, float] | None:
    return None if values is None else values._asdict()


def _anticipator(scene: Scene, anticipator: Anticipator) -> dict[str, Any]:
    """The entry of an anticipator; one that declares no points lists those that were named so far."""
    return {
        "kind": anticipator.kind,
        "events": anticipator.events,
        "textEvents": anticipator.heard,
        "points": list(map(str, anticipator.points)) or list(scene.realizer.board.predictions(anticipator.id)),
    }


def found_for(scene: Scene) -> Found:
    """Read the files of a scene before it plays, because this takes longer than a tick."""
    plug_ins = {group: names(group) for group in ("strategies", "trajectories")}
    return {"lexemes": _lexemes(scene), **plug_ins}


def _lexemes(scene: Scene) -> Mapping[str, list[str]]:
    found: dict[str, set[str]] = {}
    for character in scene.realizer.characters.values():
        for entry in lexicon_of(character.engines):
            if entry.lexeme and entry.problem is None:
                found.setdefault(entry.element, set()).add(entry.lexeme)
    return {element: sorted(lexemes) for element, lexemes in sorted(found.items())}
