"""The capabilities of a scene, for `GET /capabilities`."""

from collections.abc import Mapping
from typing import Any

from reactive_realizer.assembly.registry import names
from reactive_realizer.assembly.scene import Scene
from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.elements import ELEMENTS, Element
from reactive_realizer.engine.lexicon import words_of
from reactive_realizer.pegboard.anticipator import Anticipator
from reactive_realizer.planunit.parameter import Range

Found = Mapping[str, object]
"""What was found on disk: `lexemes`, the words that play, by element; `strategies` and `trajectories`, by name."""


async def capabilities_of(scene: Scene, found: Found) -> dict[str, Any]:
    """Elements and what is known of them; what stands in the scene's bindings, voice and world; who predicts what."""
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
        "targets": list(scene.realizer.world.targets),
        "anticipators": {id_: _anticipator(scene, each) for id_, each in scene.realizer.anticipators.items()},
    }


def _element(
    element: Element, realized: frozenset[type[Behavior]], changeable: Mapping[type[Behavior], Mapping[str, Range]]
) -> dict[str, Any]:
    """As ``parameters``: what of it parametervaluechange may change, and from where to where."""
    parameters = changeable.get(element.behavior, {})
    return {
        "namespace": element.namespace,
        "realized": element.behavior in realized,
        "attributes": [attribute.name for attribute in element.attributes],
        "syncPoints": element.sync_points,
        "parameters": {name: range_._asdict() for name, range_ in parameters.items()},
    }


def _anticipator(scene: Scene, anticipator: Anticipator) -> dict[str, Any]:
    """One that has no points of its own tells those that somebody has named so far."""
    return {
        "kind": anticipator.kind,
        "events": anticipator.events,
        "textEvents": anticipator.heard,
        "points": anticipator.points or list(scene.realizer.board.predictions(anticipator.id)),
    }


def found_for(scene: Scene) -> Found:
    """For a scene that does not play yet: all its files are read, for which a tick has no time."""
    plug_ins = {group: names(group) for group in ("strategies", "trajectories")}
    return {"lexemes": _lexemes(scene), **plug_ins}


def _lexemes(scene: Scene) -> Mapping[str, list[str]]:
    found: dict[str, set[str]] = {}
    for character in scene.realizer.characters.values():
        for word in words_of(character.engines):
            if word.lexeme and word.problem is None:
                found.setdefault(word.element, set()).add(word.lexeme)
    return {element: sorted(words) for element, words in sorted(found.items())}
