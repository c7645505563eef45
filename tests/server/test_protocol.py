"""The schema of the protocol, and messages that do not satisfy it."""

import json
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from jsonschema import Draft202012Validator

from reactive_realizer.errors import RealizerError
from reactive_realizer.server.protocol import DOCUMENT, check, decode, encode, ref_of

SCHEMA = json.loads(DOCUMENT)
DEFINITIONS = SCHEMA["$defs"]
FROM_CLIENT = Draft202012Validator({"$ref": "#/$defs/ClientMessage", "$defs": DEFINITIONS})
TYPES = [
    DEFINITIONS[one["$ref"].rpartition("/")[2]]["properties"]["type"]["const"]
    for direction in ("ClientMessage", "ServerMessage")
    for one in DEFINITIONS[direction]["oneOf"]
]

leaves = (
    st.none()
    | st.booleans()
    | st.integers(-(10**10), 10**10)
    | st.floats(allow_nan=False, allow_infinity=False)
    | st.text(max_size=5)
    | st.sampled_from(["metronome", "a:b", "x" * 201, "a\n", ""])
)
positions = st.lists(st.floats(-20000, 20000) | leaves, min_size=2, max_size=4)
values = leaves | positions | st.dictionaries(st.text(max_size=3) | st.just("bluebox"), leaves | positions, max_size=3)
fields = sorted({name for node in DEFINITIONS.values() for name in node.get("properties", {})} - {"type"})
messages = st.builds(
    lambda kind, rest: {"type": kind, **rest},
    st.sampled_from(TYPES),
    st.dictionaries(st.sampled_from(fields), values, max_size=4),
)
good_names = st.text("abc-_", min_size=1, max_size=5)
good_numbers = st.floats(-1000, 1000)
nearly_right = st.one_of(
    st.fixed_dictionaries({"type": st.just("bml"), "xml": st.text(max_size=5)}, optional={"ref": values}),
    st.fixed_dictionaries(
        {"type": st.just("predict"), "anticipator": good_names, "sync": good_names | leaves},
        optional={"time": good_numbers | st.none() | leaves, "in": good_numbers, "ref": st.text(max_size=3)},
    ),
    st.fixed_dictionaries(
        {"type": st.just("event"), "anticipator": good_names, "event": good_names},
        optional={"value": good_numbers | values},
    ),
    st.fixed_dictionaries({"type": st.just("camera"), "position": st.lists(good_numbers, min_size=3, max_size=3)}),
    st.fixed_dictionaries({"type": st.just("world"), "set": st.dictionaries(good_names, positions | st.none())}),
)


def accepts(message: Any) -> bool:
    try:
        check(message)
    except RealizerError:
        return False
    return True


@settings(max_examples=300)
@given(messages | nearly_right | values)
def test_messages_are_accepted_if_and_only_if_they_satisfy_the_schema(message: Any) -> None:
    assert accepts(message) == FROM_CLIENT.is_valid(message)


def test_the_schema_is_valid() -> None:
    Draft202012Validator.check_schema(SCHEMA)


def test_every_definition_has_its_own_name_as_title() -> None:
    assert {name: node["title"] for name, node in DEFINITIONS.items()} == {name: name for name in DEFINITIONS}


@pytest.mark.parametrize(
    ("message", "sentence"),
    [
        (
            {"type": "world", "set": {"bluebox": [0, 0, "up"]}},
            'set.bluebox.2: "up" does not satisfy type "number"',
        ),
        (
            {"type": "world", "set": {"bluebox": {"position": [0, 0, 0], "orientation": [1, 0, 0]}}},
            "set.bluebox.orientation: [1, 0, 0] does not satisfy minItems 4",
        ),
        (
            {"type": "world", "set": {"bluebox": {"position": [0, 0, 0], "orientation": [1, 0, 0, "up"]}}},
            'set.bluebox.orientation.3: "up" does not satisfy type "number"',
        ),
        (
            {"type": "world", "set": {"bluebox": {"position": [0, 0], "orientation": [1, 0, 0, 0]}}},
            "set.bluebox.position: [0, 0] does not satisfy minItems 3",
        ),
        ({"type": "world", "set": {"bluebox": {"position": [0, 0, 0]}}}, "set.bluebox: 'orientation' is a required"),
        (
            {"type": "world", "set": {"bluebox": "here"}},
            'set.bluebox: "here" does not satisfy type "array", or "here" does not satisfy type "object", or "here" ',
        ),
        ({"type": "bml"}, "bml: 'xml' is a required property"),
        (
            {"type": "predict", "anticipator": "a:b", "sync": "s", "in": 1},
            'anticipator: "a:b" does not satisfy "A part',
        ),
        ({"type": "camera", "position": [1, 2]}, "position: [1, 2] does not satisfy minItems 3"),
        (
            {"type": "predict", "anticipator": "a", "sync": "s", "time": "x"},
            'time: "x" does not satisfy type "number", or ',
        ),
        ({"type": "predict", "anticipator": "a", "sync": "s"}, "predict: 'time' is a required property, or 'in' is"),
    ],
)
def test_an_error_names_the_field_and_the_rule(message: Any, sentence: str) -> None:
    with pytest.raises(RealizerError) as refused:
        check(message)
    assert refused.value.fault.sentence.startswith(sentence)


def test_an_error_shows_only_the_beginning_of_a_long_value() -> None:
    with pytest.raises(RealizerError) as refused:
        check({"type": "camera", "position": "x" * 10_000})
    assert len(refused.value.fault.sentence) < 200


@given(leaves)
def test_messages_are_read_as_they_were_written(value: Any) -> None:
    assert decode(encode({"value": value})) == {"value": value}


@pytest.mark.parametrize("ref", ["r", 7, ""])
def test_refs_are_strings_or_integers(ref: object) -> None:
    assert ref_of({"ref": ref}) == ref


@pytest.mark.parametrize("ref", [None, 1.5, [], True, "x" * 201])
def test_other_values_are_no_refs(ref: object) -> None:
    assert ref_of({"ref": ref}) is None
