"""What a planner may ask of a scene."""

from collections.abc import Mapping
from typing import Any

from reactive_realizer.assembly.scene import Scene
from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.elements import ELEMENTS, Element
from reactive_realizer.engine.lexicon import words_of
from reactive_realizer.planunit.parameter import Range

Lexemes = Mapping[str, list[str]]
"""The words that play, by element."""


async def capabilities_of(scene: Scene, lexemes: Lexemes) -> dict[str, Any]:
    """Elements with their attributes and sync points, and what stands in the scene's bindings, voice and world."""
    engines = [engine for character in scene.realizer.characters.values() for engine in character.engines]
    realized = frozenset[type[Behavior]]().union(*(engine.behaviors for engine in engines))
    changeable = {behavior: ranges for engine in engines for behavior, ranges in engine.parameters.items()}
    return {
        "elements": {name: _element(element, realized, changeable) for name, element in ELEMENTS.items()},
        "lexemes": lexemes,
        "parameters": {
            name: sorted(changeable[element.behavior])
            for name, element in ELEMENTS.items()
            if changeable.get(element.behavior)
        },
        "voices": await scene.tts.voices(),
        "targets": list(scene.realizer.world.targets),
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


def lexemes_of(scene: Scene) -> Lexemes:
    """The words of a scene that does not play yet: it reads all their files, for which a tick has no time."""
    found: dict[str, set[str]] = {}
    for character in scene.realizer.characters.values():
        for word in words_of(character.engines):
            if word.lexeme and word.problem is None:
                found.setdefault(word.element, set()).add(word.lexeme)
    return {element: sorted(words) for element, words in sorted(found.items())}
