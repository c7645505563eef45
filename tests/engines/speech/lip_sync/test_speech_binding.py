"""Speech bindings of AsapRealizer: the motion of the jaw for each numbered viseme."""

import math
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.embodiment.joints import JAW
from reactive_realizer.embodiment.quaternion import rotation_vector
from reactive_realizer.errors import RealizerError
from reactive_realizer.testing.pilot import open_pilot

from .test_jaw_joint import with_jaw

OPENS = f"""<ProcAnimation prefDuration="0.2" minDuration="0.01" maxDuration="10">
  <Parameter sid="a" value="0"/>
  <Rotation target="{JAW}" rotation="0.3*a*sin(pi*t); 0; 0"/>
</ProcAnimation>"""


def viseme(number: object, amount: float, motion: str = 'type="ProcAnimation" file="speech/opens.xml"') -> str:
    return (
        f'<VisimeSpec visime="{number}"><parameterdefaults><parameterdefault name="a" value="{amount}"/>'
        f"</parameterdefaults><MotionUnit {motion}/></VisimeSpec>"
    )


def human_file(folder: Path, *entries: str, jaw: bool = True) -> Path:
    (folder / "speech").mkdir()
    (folder / "speech/opens.xml").write_text(OPENS)
    inside = "\n".join(entries)
    (folder / "speechbinding.xml").write_text(f"<speechbinding>\n{inside}\n</speechbinding>")
    if jaw:
        with_jaw(folder / "puppet.glb")
    avatar = 'avatar = "puppet.glb"\n' if jaw else ""
    human = folder / "human.toml"
    human.write_text(f'[character.alice]\n{avatar}idle = false\nbindings = {{ speech = "speechbinding.xml" }}\n')
    return human


@pytest.mark.speech
async def test_the_jaw_opens_for_the_vowels_of_the_binding_and_closes_for_a_p(tmp_path: Path) -> None:
    human = human_file(tmp_path, viseme(0, 0), viseme(2, 1), viseme(21, 0))
    async with open_pilot(SceneOptions(human, "espeak", (tmp_path,))) as pilot:
        pilot.watch()
        pilot.block("b", '<speech id="s"><text>Papa, papa.</text></speech>')
        await pilot.advance(2.5)
        assert pilot.feedback.warnings == []
        opened = np.array([rotation_vector(body.rotation(JAW))[0] for body in pilot.bodies()])
        assert 0.2 < opened.max() < 0.301
        assert sum(one > 0.07 > other for one, other in pairwise(opened)) == 2, "a stressed vowel after a p"
        assert abs(opened[round(50 * pilot.feedback.time("b:s:end")) + 8 :]).max() < math.radians(0.1)


@pytest.mark.parametrize(
    ("entry", "said"),
    [
        (viseme(22, 1), "line 2, <VisimeSpec>: visime='22' is not from 0 to 21"),
        (viseme("o", 1), "line 2, <VisimeSpec>: visime='o' is not a number"),
        (viseme(2, 9), f"line 2, <MotionUnit>: {JAW} turns by 155 degrees; the limit is 45"),
        (viseme(2, 1, 'type="Keyframe" file="a"'), "only motions of the type ProcAnimation play visemes"),
        (viseme(2, 1) + viseme(2, 0), "visime='2' is given twice"),
        ('<VisimeSpec visime="2"/>', "it has no MotionUnit"),
        ("<PictureUnitSpec/>", "line 2, <PictureUnitSpec>: known is VisimeSpec"),
        (viseme(2, 1, 'type="ProcAnimation" file="gone.xml"'), "gone.xml"),
        ("", "it turns no joint of the figure"),
    ],
)
async def test_a_binding_that_cannot_be_used_is_an_error_at_the_start(tmp_path: Path, entry: str, said: str) -> None:
    human = human_file(tmp_path, entry)
    with pytest.raises(RealizerError) as refused:
        async with open_pilot(SceneOptions(human, "text", (tmp_path,))):
            pass
    assert said in str(refused.value)


async def test_a_binding_for_joints_that_the_avatar_lacks_is_an_error(tmp_path: Path) -> None:
    human = human_file(tmp_path, viseme(2, 1), jaw=False)
    with pytest.raises(RealizerError, match="it turns no joint of the figure"):
        async with open_pilot(SceneOptions(human, "text", (tmp_path,))):
            pass


async def test_a_parameter_that_the_motion_lacks_is_logged(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    misspelled = viseme(2, 1).replace(
        "<parameterdefault ", '<parameterdefault name="ampl" value="1"/><parameterdefault '
    )
    human = human_file(tmp_path, viseme(21, 0), misspelled)
    async with open_pilot(SceneOptions(human, "text", (tmp_path,))):
        pass
    assert "speechbinding.xml, line 3: the motion of this entry has no parameter ampl; it has a" in caplog.text
