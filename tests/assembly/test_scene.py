"""A scene is built from its files; errors name the file and the line."""

import os
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest

from reactive_realizer.assembly.assets import PACKAGE_ASSETS, Assets
from reactive_realizer.assembly.human_file import DEFAULT_BINDINGS, read_human_file
from reactive_realizer.assembly.registry import load, names
from reactive_realizer.assembly.scene import DEFAULT_HUMAN, SceneOptions, open_scene
from reactive_realizer.errors import RealizerError
from reactive_realizer.limits import Limits

ALICE = "[character.alice]\n"


@pytest.fixture
def human(tmp_path: Path) -> Callable[[str], Path]:
    def write(text: str) -> Path:
        file = tmp_path / "human.toml"
        file.write_text(text)
        return file

    return write


def test_the_default_has_one_character_and_the_usual_targets() -> None:
    default = read_human_file(DEFAULT_HUMAN)
    assert len(default.characters) == 1
    assert set(default.targets) >= {"viewer", "camera", "bluebox", "greensphere"}
    assert default.limits == Limits()


def test_missing_keys_of_a_character_have_their_defaults(human: Callable[[str], Path]) -> None:
    read = read_human_file(human("[character.alice]\nheading = 90\n[limits]\nclients = 3\n"))
    alice = read.characters["alice"]
    assert (alice.heading, alice.position) == (90.0, (0.0, 0.0, 0.0))
    assert read.limits.clients == 3


async def test_the_viseme_binding_of_an_avatar_is_beside_it(human: Callable[[str], Path], tmp_path: Path) -> None:
    (tmp_path / "me.visemes.toml").write_text("[visemes.aa]\nmorphs = {mouth = 1}\n", encoding="utf-8")
    shutil.copy(PACKAGE_ASSETS / "avatars/male.glb", tmp_path / "me.glb")
    options = SceneOptions(human(ALICE + 'avatar = "me.glb"'), "text", (tmp_path,))
    with pytest.raises(RealizerError, match=r"me\.visemes\.toml: visemes\.aa\.morphs: 'mouth' is not a morph target"):
        async with open_scene(options):
            pass


@pytest.mark.parametrize(
    ("text", "mentions"),
    [
        ("[character.alice]\nheight = 2", ["character.alice.height", "heading", "avatar"]),
        (ALICE + "[table]", ["table", "character, target, anticipator, limits"]),
        (ALICE + "[limits]\nblocks = 1", ["limits.blocks", "blocks_alive"]),
        (ALICE + "[target.box]\nplace = [1, 2, 3]", ["target.box.place", "position"]),
        (ALICE + "[target.box]", ["target.box", "position"]),
        (ALICE + "[target.box]\nposition = [1, 2]", ["target.box.position"]),
        (ALICE + "[target.box]\nposition = [1, 2, nan]", ["target.box.position"]),
        (ALICE + "[anticipator.m]\ntempo = 60", ["anticipator.m", "kind"]),
        (ALICE + '[anticipator.m]\nkind = "metronome"\ntempo = "60"', ["anticipator.m.tempo", "'60'"]),
        (ALICE + '[anticipator.events]\nkind = "spacebar"', ["anticipator.events", "reserved"]),
        (ALICE + '[anticipator.e]\nkind = "exercise"\nnames = ["up", 3]', ["anticipator.e.names", "3"]),
        (ALICE + "[limits]\nclients = 1.5", ["limits.clients"]),
        (ALICE + "[limits]\nclients = true", ["limits.clients"]),
        ("[character.alice]\nheading = 'left'", ["character.alice.heading", "left"]),
        ("[target.box]\nposition = [1, 2, 3]", ["character"]),
        ("character = 3", ["character", "table"]),
        ("this is not TOML", ["human.toml"]),
        ("[" * 100_000, ["human.toml"]),
        (ALICE + "heading = 1" + "0" * 400, ["character.alice.heading"]),
        (ALICE + "heading = 1" + "0" * 5000, ["human.toml"]),
        (ALICE + 'bindings = { foo = "x" }', ["character.alice.bindings.foo", "known are gesture, face"]),
        (ALICE + "[target.t]\nposition = [0, 1, 2]\nradius = -0.1", ["target.t.radius", "-0.1 is not from 0 to 100 m"]),
        (ALICE + "[target.t]\nposition = [0, 1e300, 2]", ["target.t.position", "1e+300 is not from -10000 to 10000 m"]),
        (ALICE + "expressivity = { power = 1.5 }", ["character.alice.expressivity.power", "1.5 is not from -1 to 1"]),
        (ALICE + "expressivity = { strength = 1 }", ["expressivity.strength", "unknown", "power", "fluidity"]),
        (ALICE + 'expressivity = { power = "strong" }', ["expressivity.power", "wrong type"]),
        (ALICE + "expressivity = { power = nan }", ["expressivity.power"]),
        (ALICE + "expressivity = 1", ["character.alice.expressivity"]),
        (ALICE + "blink_rate = 61", ["character.alice.blink_rate", "61 is not from 0 to 60 per minute"]),
        (ALICE + "bindings = { gesture = 3 }", ["character.alice.bindings.gesture"]),
        (ALICE + 'engines = ["speech", "wait", "speech"]', ["character.alice.engines", "'speech'", "twice"]),
        (ALICE + "voice = 3", ["character.alice.voice", "3"]),
        (ALICE + "voice = {kokoro = 3}", ["character.alice.voice.kokoro", "3"]),
        (ALICE + "physics = false", ["character.alice.physics", "known are avatar"]),
        (ALICE + "[target.alice]\nposition = [1, 2, 3]", ["target.alice", "a character"]),
        (ALICE + "[limits]\nblocks_alive = -1", ["limits.blocks_alive", "-1"]),
        (ALICE + "[limits]\nclients = 0", ["limits.clients", "less than 1"]),
        (ALICE + "[limits]\ntime_seconds = 0.5", ["limits.time_seconds"]),
    ],
)
def test_the_error_of_an_unknown_or_invalid_key_names_it(
    human: Callable[[str], Path], text: str, mentions: list[str]
) -> None:
    with pytest.raises(RealizerError) as refused:
        read_human_file(human(text))
    assert all(mention in str(refused.value) for mention in mentions)


@pytest.mark.parametrize("id_", ["", "a b", "a:b", "a+b", "a\\u0000", "a\\u007f", "a\\n", "bml", "a" * 201])
@pytest.mark.parametrize("section", ["character", "target", "anticipator"])
def test_an_id_that_cannot_be_referenced_is_refused(human: Callable[[str], Path], section: str, id_: str) -> None:
    with pytest.raises(RealizerError) as refused:
        read_human_file(human(f'[character.alice]\n[{section}."{id_}"]'))
    assert all(part in str(refused.value) for part in ["human.toml", section, "control character"])


def test_a_voice_is_for_all_speech_synthesis_or_one_for_each(human: Callable[[str], Path]) -> None:
    plain = read_human_file(human(ALICE + 'voice = "nl"')).characters["alice"]
    own = read_human_file(human(ALICE + 'voice = {espeak = "nl"}')).characters["alice"]
    none = read_human_file(human(ALICE)).characters["alice"]
    assert [each.voice_of(tts) for each in (plain, own, none) for tts in ("espeak", "kokoro")] == [
        *("nl", "nl"),
        *("nl", None),
        *(None, None),
    ]


def test_a_missing_kind_of_binding_has_its_default(human: Callable[[str], Path]) -> None:
    assert read_human_file(human(ALICE + "bindings = {}")).characters["alice"].bindings == DEFAULT_BINDINGS


def test_every_kind_of_binding_has_a_file_in_the_package() -> None:
    assert all(Assets()(file).is_file() for file in DEFAULT_BINDINGS.values())


@pytest.mark.parametrize(
    ("text", "mentions"),
    [
        (ALICE + 'engines = ["speech", "tail"]', ["tail", "speech, wait"]),
        (ALICE + '[anticipator.m]\nkind = "oracle"', ["oracle", "metronome"]),
        (ALICE + '[anticipator.m]\nkind = "metronome"\nspeed = 3', ["human.toml: anticipator.m.speed", "tempo"]),
        (ALICE + '[anticipator.m]\nkind = "metronome"\ntempo = 3', ["human.toml: anticipator.m", "tempo=3"]),
        (ALICE + '[anticipator.m]\nkind = "metronome"\ntempo = ["a"]', ["anticipator.m.tempo", "a number"]),
        (ALICE + '[anticipator.e]\nkind = "exercise"\nnames = 3', ["anticipator.e.names", "a list of names"]),
        (ALICE + '[anticipator.e]\nkind = "exercise"\nnames = ["up", "up"]', ["anticipator.e", "'up'", "once"]),
        (ALICE + '[anticipator.e]\nkind = "exercise"\nrise = 0', ["anticipator.e", "rise=0"]),
        (ALICE + '[anticipator.u]\nkind = "speech_stop"\ncertainty = 1', ["anticipator.u", "certainty=1"]),
        (ALICE + '[anticipator.u]\nkind = "speech_stop"\nmodel = 1', ["u.model", "known are kind, certainty, pause"]),
        (ALICE + 'avatar = "../secret.glb"', ["../secret.glb"]),
        (ALICE + 'avatar = "nobody.glb"', ["nobody.glb"]),
    ],
)
async def test_the_error_of_an_invalid_scene_names_the_cause(
    human: Callable[[str], Path], text: str, mentions: list[str]
) -> None:
    with pytest.raises(RealizerError) as refused:
        async with open_scene(SceneOptions(human(text), voice="text")):
            pass
    assert all(mention in str(refused.value) for mention in mentions)


def test_the_built_in_plug_ins_are_entry_points() -> None:
    assert set(names("engines")) >= {"animation", "face", "speech", "wait"}
    for kind in ("metronome", "remote", "spacebar", "speech_stop", "exercise", "conducting"):
        assert load("anticipators", kind).kind == kind
    with pytest.raises(
        RealizerError, match="the plug-in group engines has no 'nothing'; available: activate, animation"
    ):
        load("engines", "nothing")


# --- assets


@pytest.fixture
def folders(tmp_path: Path) -> tuple[Path, Path]:
    one, two = tmp_path / "one", tmp_path / "two"
    for folder in (one, two):
        (folder / "sub").mkdir(parents=True)
        (folder / "sub" / "both.xml").write_text("")
        (folder / f"only-{folder.name}.xml").write_text("")
    return one, two


def test_a_name_is_searched_in_the_folders_in_order_and_then_in_the_package(folders: tuple[Path, Path]) -> None:
    one, two = folders
    assets = Assets(folders)
    assert assets("sub/both.xml") == one / "sub" / "both.xml"
    assert assets("only-two.xml") == two / "only-two.xml"
    assert assets("gesturebinding.xml") == PACKAGE_ASSETS / "gesturebinding.xml"


def test_leading_folders_of_a_name_are_dropped_one_by_one(folders: tuple[Path, Path]) -> None:
    assert Assets(folders)("Humanoids/shared/sub/both.xml") == folders[0] / "sub" / "both.xml"


def test_a_name_may_be_searched_in_all_folders_of_one_root_before_the_next(folders: tuple[Path, Path]) -> None:
    one, two = folders
    assets = Assets(folders)
    assert assets("**/both.xml") == one / "sub" / "both.xml"
    assert assets("**/only-two.xml") == two / "only-two.xml"
    (two / "deep" / "er").mkdir(parents=True)
    (two / "deep" / "er" / "lone*.xml").write_text("")
    assert Assets(folders)("**/er/lone*.xml") == two / "deep" / "er" / "lone*.xml"
    with pytest.raises(RealizerError, match=r"there is no asset named 'l\*\.xml'"):
        Assets(folders)("**/l*.xml")


def test_files_that_appear_and_disappear_are_noticed(folders: tuple[Path, Path]) -> None:
    assets = Assets(folders)
    added = folders[1] / "sub" / "added.xml"
    with pytest.raises(RealizerError, match=r"no asset named 'added\.xml'"):
        assets("**/added.xml")
    added.write_text("")
    later(added.parent)
    assert assets("**/added.xml") == added
    added.unlink()
    later(added.parent)
    with pytest.raises(RealizerError, match=r"no asset named 'added\.xml'"):
        assets("**/added.xml")


def later(folder: Path) -> None:
    """Set its modification time 1 s later, because file systems may not distinguish changes within a few ms."""
    at = folder.stat().st_mtime_ns + 10**9
    os.utime(folder, ns=(at, at))


def test_folders_are_walked_once_for_several_names(folders: tuple[Path, Path], monkeypatch: pytest.MonkeyPatch) -> None:
    walks = []
    walk = os.walk

    def counted(folder: Path) -> object:
        walks.append(folder)
        return walk(folder)

    monkeypatch.setattr(os, "walk", counted)
    assets = Assets(folders)
    walked_at_first = [*walks]
    for _ in range(10):
        assets("**/only-two.xml")
        with pytest.raises(RealizerError):
            assets("**/none.xml")
    assert walks == walked_at_first, "a lookup, which may come in a tick, does not walk"
    Assets(folders[:1])("**/only-one.xml")
    assert [each for each in walks if each != PACKAGE_ASSETS] == [*folders, folders[0]]
    assert walks.count(PACKAGE_ASSETS) <= 1, "all scenes share that of the package"


def test_a_name_of_several_files_of_one_root_is_refused_with_all_of_them(folders: tuple[Path, Path]) -> None:
    (folders[0] / "both.xml").write_text("")
    with pytest.raises(RealizerError, match=r"several assets are named 'both\.xml': both\.xml, sub/both\.xml"):
        Assets(folders)("**/both.xml")


def test_a_search_does_not_find_a_link_that_leads_out_of_its_folder(folders: tuple[Path, Path], tmp_path: Path) -> None:
    (tmp_path / "secret.xml").write_text("")
    (folders[0] / "link.xml").symlink_to(tmp_path / "secret.xml")
    with pytest.raises(RealizerError, match=r"no asset named 'link\.xml'"):
        Assets(folders)("**/link.xml")


@pytest.mark.parametrize(
    "name",
    ["../one/only-one.xml", "**/../only-one.xml", "sub/../only-one.xml", "/etc/passwd", "..", "sub\\both.xml", "", "."],
)
def test_a_name_that_leaves_the_folders_is_refused(folders: tuple[Path, Path], name: str) -> None:
    with pytest.raises(RealizerError) as refused:
        Assets(folders)(name)
    assert refused.value.fault.code == "forbidden-path"


def test_a_path_does_not_follow_a_link_that_leads_out_of_its_folder(folders: tuple[Path, Path], tmp_path: Path) -> None:
    (tmp_path / "secret.xml").write_text("")
    (folders[0] / "link.xml").symlink_to(tmp_path / "secret.xml")
    (folders[0] / "inner.xml").symlink_to(folders[0] / "only-one.xml")
    assets = Assets(folders)
    assert assets("inner.xml") == folders[0] / "only-one.xml"
    with pytest.raises(RealizerError, match=r"no asset named 'link\.xml'"):
        assets("link.xml")


@pytest.mark.parametrize("name", ["nothing.xml", "sub", "x" * 1000, "a\0b", "**", "**/sub", "**/a\0b", "**/**"])
def test_an_unknown_or_invalid_name_is_refused(folders: tuple[Path, Path], name: str) -> None:
    with pytest.raises(RealizerError):
        Assets(folders)(name)


def test_the_error_of_a_missing_folder_names_it(tmp_path: Path) -> None:
    with pytest.raises(RealizerError, match="nowhere"):
        Assets((tmp_path / "nowhere",))


async def test_an_avatar_that_does_not_exist_is_named_with_its_key_and_file(tmp_path: Path) -> None:
    human = tmp_path / "human.toml"
    human.write_text('[character.anna]\navatar = "avatars/anna.glb"')
    said = r"human\.toml: character\.anna\.avatar: there is no asset named 'avatars/anna\.glb'"
    with pytest.raises(RealizerError, match=said):
        async with open_scene(SceneOptions(human, voice="text")):
            pass
