"""JSON Schemas with definitions, and readable messages for values that violate them."""

import json
from collections.abc import Mapping
from itertools import islice
from typing import Any

from jsonschema import Draft202012Validator, ValidationError

from reactive_realizer.errors import RealizerError
from reactive_realizer.server.faults import BadMessage

_MOST_SHOWN = 60


class Schema:
    """A schema document with ``$defs``; the validator of each definition is compiled once.

    Attributes:
        definitions: the nodes of ``$defs``, by name.
    """

    def __init__(self, document: Mapping[str, Any]) -> None:
        self.definitions: Mapping[str, Mapping[str, Any]] = document["$defs"]
        self._validators = {
            name: Draft202012Validator({**node, "$defs": self.definitions}) for name, node in self.definitions.items()
        }

    def accepts(self, value: Any, definition: str) -> bool:
        """Whether a value satisfies a definition."""
        return bool(self._validators[definition].is_valid(value))

    def check(self, value: Any, definition: str, name: str) -> None:
        """Checks a value.

        Args:
            value: of any JSON type.
            definition: the name of its definition.
            name: of the value as a whole, for messages.

        Raises:
            RealizerError: "bad-message", with the place of the first error: keys and indices joined by dots.
        """
        error: ValidationError | None = next(self._validators[definition].iter_errors(value), None)
        if error is None:
            return
        errors = _of_alternatives(error) or [error]
        place = ".".join(map(str, errors[0].absolute_path)) or name
        reasons = [_reason(each) for each in errors if each.absolute_path == errors[0].absolute_path]
        raise RealizerError(BadMessage(place=place, reason=", or ".join(dict.fromkeys(reasons))))


def shown(value: object) -> str:
    """A value as JSON, truncated if it is long."""
    text = "".join(islice(json.JSONEncoder().iterencode(value), _MOST_SHOWN + 1))  # a long one is not written whole
    return text if len(text) <= _MOST_SHOWN else text[:_MOST_SHOWN] + "..."


def _of_alternatives(error: ValidationError) -> list[ValidationError]:
    """The errors of the alternatives whose type the value has; of all alternatives if it has no type of theirs."""
    errors: list[ValidationError] = list(error.context or ())
    others = {each.schema_path[0] for each in errors if each.validator == "type" and not each.path}
    return [each for each in errors if each.schema_path[0] not in others] or errors


def _reason(error: ValidationError) -> str:
    if error.validator == "required":
        return str(error.message)
    if error.validator == "pattern":  # the description is easier to read than the pattern
        rule = json.dumps(error.schema["description"])
    else:
        rule = f"{error.validator} {json.dumps(error.validator_value)}"
    return f"{shown(error.instance)} does not satisfy {rule}"
