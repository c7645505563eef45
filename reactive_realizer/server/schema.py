"""The part of JSON Schema (draft 2020-12) that protocol.json is written in."""

import json
import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

Node = Mapping[str, Any]
Check = Callable[[Any, Any], bool]


@dataclass(frozen=True, slots=True)
class Mismatch:
    """Where a value does not keep to a schema.

    Attributes:
        place: path into the value, keys and indices joined by dots; empty for all of it.
        value: what stands there.
        rule: the keyword and its argument; of a pattern, how its node is described.
    """

    place: str
    value: object
    rule: str


class Schema:
    """A schema document with ``$defs``.

    Keywords of another vocabulary than that of `protocol.json` are a KeyError: nothing goes unchecked.
    """

    def __init__(self, document: Node) -> None:
        self.definitions: Mapping[str, Node] = document["$defs"]

    def mismatch(self, value: Any, node: Node, place: str = "") -> Mismatch | None:
        """The first thing that is wrong with a value; None if it keeps to the schema."""
        for keyword, argument in node.items():
            if keyword in _NOTES:
                continue
            if keyword in _NESTED:
                found = next(_NESTED[keyword](self, value, argument, place), None)
            else:
                fits = _CHECKS[keyword](value, argument)
                found = None if fits else Mismatch(place, value, _rule(keyword, node))
            if found is not None:
                return found
        return None

    def _reference(self, value: Any, argument: str, place: str) -> Iterator[Mismatch]:
        yield from self._each([(value, self.definitions[argument.rpartition("/")[2]], place)])

    def _properties(self, value: Any, argument: Mapping[str, Node], place: str) -> Iterator[Mismatch]:
        if isinstance(value, dict):
            yield from self._each(
                (value[name], node, _inside(place, name)) for name, node in argument.items() if name in value
            )

    def _values(self, value: Any, argument: Node, place: str) -> Iterator[Mismatch]:
        if isinstance(value, dict):
            yield from self._each((part, argument, _inside(place, name)) for name, part in value.items())

    def _names(self, value: Any, argument: Node, place: str) -> Iterator[Mismatch]:
        if isinstance(value, dict):
            yield from self._each((name, argument, _inside(place, name)) for name in value)

    def _items(self, value: Any, argument: Node, place: str) -> Iterator[Mismatch]:
        if isinstance(value, list):
            yield from self._each((part, argument, _inside(place, i)) for i, part in enumerate(value))

    def _first_items(self, value: Any, argument: list[Node], place: str) -> Iterator[Mismatch]:
        if isinstance(value, list):
            pairs = enumerate(zip(value, argument, strict=False))
            yield from self._each((part, node, _inside(place, i)) for i, (part, node) in pairs)

    def _any_of(self, value: Any, argument: list[Node], place: str) -> Iterator[Mismatch]:
        """The first alternative is the one that is told of."""
        found = [self.mismatch(value, node, place) for node in argument]
        if None not in found:
            yield from filter(None, found)

    def _one_of(self, value: Any, argument: list[Node], place: str) -> Iterator[Mismatch]:
        yield from self._any_of(value, argument, place)
        if [self.mismatch(value, node, place) for node in argument].count(None) > 1:
            yield Mismatch(place, value, f"oneOf {json.dumps(argument)}")

    def _each(self, parts: Any) -> Iterator[Mismatch]:
        for value, node, place in parts:
            found = self.mismatch(value, node, place)
            if found is not None:
                yield found


def _rule(keyword: str, node: Node) -> str:
    # Few people read patterns.
    return json.dumps(node["description"]) if keyword == "pattern" else f"{keyword} {json.dumps(node[keyword])}"


def _inside(place: str, part: object) -> str:
    return f"{place}.{part}" if place else str(part)


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)


def _is_integer(value: Any) -> bool:
    return _is_number(value) and (isinstance(value, int) or value.is_integer())


_TYPES: Mapping[str, Callable[[Any], bool]] = {
    "object": lambda value: isinstance(value, dict),
    "array": lambda value: isinstance(value, list),
    "string": lambda value: isinstance(value, str),
    "number": _is_number,
    "integer": _is_integer,
    "boolean": lambda value: isinstance(value, bool),
    "null": lambda value: value is None,
}


def _has_type(value: Any, names: str | list[str]) -> bool:
    return any(_TYPES[name](value) for name in ([names] if isinstance(names, str) else names))


def _if(kind: Callable[[Any], bool], check: Check) -> Check:
    """Keywords say something about values of one kind only."""
    return lambda value, argument: not kind(value) or check(value, argument)


_NOTES = frozenset({"title", "description"})
_CHECKS: Mapping[str, Check] = {
    "type": _has_type,
    "const": lambda value, argument: type(value) is type(argument) and value == argument,
    "enum": lambda value, argument: any(type(value) is type(one) and value == one for one in argument),
    "minimum": _if(_is_number, lambda value, least: value >= least),
    "maximum": _if(_is_number, lambda value, most: value <= most),
    "maxLength": _if(_TYPES["string"], lambda value, most: len(value) <= most),
    "pattern": _if(_TYPES["string"], lambda value, pattern: re.search(pattern, value) is not None),
    "minItems": _if(_TYPES["array"], lambda value, least: len(value) >= least),
    "maxItems": _if(_TYPES["array"], lambda value, most: len(value) <= most),
    "maxProperties": _if(_TYPES["object"], lambda value, most: len(value) <= most),
    "required": _if(_TYPES["object"], lambda value, names: all(name in value for name in names)),
}
_NESTED: Mapping[str, Callable[[Schema, Any, Any, str], Iterator[Mismatch]]] = {
    "$ref": Schema._reference,
    "properties": Schema._properties,
    "additionalProperties": Schema._values,
    "propertyNames": Schema._names,
    "items": Schema._items,
    "prefixItems": Schema._first_items,
    "anyOf": Schema._any_of,
    "oneOf": Schema._one_of,
}
