"""The scripts of SmartBody's own examples."""

import json
from pathlib import Path

import pytest

from .reading import read

NOT_WHOLE = {
    "SBBmlProcessor.cpp": "unexpected text",
    "FacialMovementDemo.py": "unexpected text",
    "InitCharacterBehaviorBMLMapping.py": "start='$ready_time' of <faceFacs>",
    "locomotionBlendCEGUI.py": "y=''+str(turnAngle)+'' of <blend>",
}
"""Pieces of programs that are no BML as they stand, and what is said of them."""


WITHOUT_COUNTERPART = {
    "KinectSimpleDemo.py": "x, y",
    "OgreDemo.js": "x, y",
}
"""Attributes in SmartBody's examples that nothing here corresponds to."""


def test_the_scripts_of_smartbody_are_read(shared_cases: Path, subtests: pytest.Subtests) -> None:
    said = NOT_WHOLE | WITHOUT_COUNTERPART
    for line in (shared_cases / "smartbody" / "snippets.jsonl").read_text().splitlines():
        script = json.loads(line)
        name = script["source"].rpartition("/")[2]
        with subtests.test(script["bml"]):
            parsed = read(f"<act>{script['bml']}</act>")
            assert parsed.block is not None
            for problem in parsed.problems:
                assert problem.fault.sentence.startswith(said[name])
