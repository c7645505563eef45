"""Morph targets and expressions of avatar files: names, binds, and what is wrong with them."""

import re
from typing import Any

import pytest

from reactive_realizer.embodiment.morph_targets import MorphTarget, morph_targets_of


def mesh(name: str, *targets: str, where: str = "mesh") -> dict[str, Any]:
    """A mesh whose morph targets are named in its extras, in those of its primitive, or in those of each target."""
    primitive: dict[str, Any] = {"targets": [{} for _ in targets]}
    if where == "target":
        primitive["targets"] = [{"extras": {"name": each}} for each in targets]
    if where == "primitive":
        primitive["extras"] = {"targetNames": list(targets)}
    extras = {"extras": {"targetNames": list(targets)}} if where == "mesh" else {}
    return {"name": name, "primitives": [primitive], **extras}


def vrm_0(*groups: dict[str, Any]) -> dict[str, Any]:
    return {"VRM": {"blendShapeMaster": {"blendShapeGroups": list(groups)}}}


def vrm_1(preset: dict[str, Any], custom: dict[str, Any]) -> dict[str, Any]:
    return {"VRMC_vrm": {"expressions": {"preset": preset, "custom": custom}}}


def test_targets_of_one_name_move_together_and_a_loader_finds_them() -> None:
    found = morph_targets_of({"meshes": [mesh("Head", "jawOpen", "mouthClose"), mesh("Teeth", "jawOpen")]})
    assert found.named == {"jawOpen": (MorphTarget(0, 0), MorphTarget(1, 0)), "mouthClose": (MorphTarget(0, 1),)}
    assert not found.unnamed


@pytest.mark.parametrize("where", ["primitive", "target"])
def test_names_that_a_loader_does_not_read_are_read_too(where: str) -> None:
    found = morph_targets_of({"meshes": [mesh("Head", "A", "I", where=where)]})
    assert found.named == {"A": (MorphTarget(0, 0),), "I": (MorphTarget(0, 1),)}
    assert found.unnamed == {"A", "I"}


def test_a_target_without_a_name_has_that_of_its_mesh_and_its_number() -> None:
    assert [*morph_targets_of({"meshes": [mesh("Face", "", "", where="none")]}).named] == ["Face.0", "Face.1"]


def test_the_presets_of_vrm_0_have_the_names_of_vrm_1_and_weights_in_percent() -> None:
    groups = [
        {"name": "A", "presetName": "a", "binds": [{"mesh": 0, "index": 0, "weight": 60}]},
        {"name": "BrowDownLeft", "presetName": "unknown", "binds": [{"mesh": 0, "index": 1, "weight": 100}]},
    ]
    found = morph_targets_of({"meshes": [mesh("Face", "m0", "m1")], "extensions": vrm_0(*groups)})
    assert found.expressions == {"aa": {"m0": 0.6}, "BrowDownLeft": {"m1": 1.0}}


def test_expressions_of_vrm_1_bind_the_meshes_of_nodes() -> None:
    bind = {"node": 1, "index": 1, "weight": 0.5}
    extensions = vrm_1({"aa": {"morphTargetBinds": [bind]}}, {"wow": {"morphTargetBinds": [bind, bind]}})
    nodes: list[dict[str, Any]] = [{}, {"mesh": 1}]
    scene = {"nodes": nodes, "meshes": [mesh("Body"), mesh("Face", "m0", "m1")], "extensions": extensions}
    assert morph_targets_of(scene).expressions == {"aa": {"m1": 0.5}, "wow": {"m1": 1.0}}


def test_targets_that_an_expression_moves_apart_have_names_of_their_own() -> None:
    group = {"presetName": "a", "binds": [{"mesh": 1, "index": 0, "weight": 100}]}
    found = morph_targets_of({"meshes": [mesh("Body", "x"), mesh("Face", "x")], "extensions": vrm_0(group)})
    assert found.named == {"Body.x": (MorphTarget(0, 0),), "Face.x": (MorphTarget(1, 0),)}
    assert found.expressions == {"aa": {"Face.x": 1.0}}
    assert found.unnamed == {"Body.x", "Face.x"}


@pytest.mark.parametrize(
    ("bind", "note"),
    [
        ({"mesh": 7, "index": 0}, "the expression 'aa' moves mesh 7, which does not exist; this is left out"),
        ({"mesh": 0, "index": 9}, "moves the morph target 9 of the mesh 'Face', which does not exist"),
        ({"mesh": 0, "index": -1}, "moves the morph target -1 of the mesh 'Face', which does not exist"),
        ({"mesh": 0, "index": 0, "weight": float("nan")}, "the expression 'aa' has a weight of nan"),
        ({"index": 0}, r"the expression 'aa' cannot be read \(KeyError\('mesh'\)\)"),
        ("nonsense", "the expression 'aa' cannot be read"),
    ],
)
def test_a_bind_that_cannot_be_used_is_left_out_with_a_note(bind: Any, note: str) -> None:
    good = {"presetName": "o", "binds": [{"mesh": 0, "index": 0, "weight": 100}]}
    extensions = vrm_0({"presetName": "a", "binds": [bind]}, good)
    found = morph_targets_of({"meshes": [mesh("Face", "m0")], "extensions": extensions})
    assert [*found.expressions] == ["oh"]
    (said,) = found.notes
    assert re.search(note, said)


def test_expressions_that_are_no_list_are_left_out_with_a_note() -> None:
    scene = {"meshes": [mesh("Face", "m0")], "extensions": {"VRM": {"blendShapeMaster": {"blendShapeGroups": 3}}}}
    assert morph_targets_of(scene).notes[0].startswith("its expressions cannot be read")


def test_more_than_a_thousand_targets_are_refused() -> None:
    with pytest.raises(ValueError, match="more than 1000 morph targets"):
        morph_targets_of({"meshes": [mesh("Face", *map(str, range(1001)))]})
