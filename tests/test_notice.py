"""NOTICE against what we really ship: data folders, the page's libraries, the notices of the parts."""

import json
import re
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parents[1]
ASSETS = REPOSITORY / "reactive_realizer" / "assets"
NOTICE = (REPOSITORY / "NOTICE").read_text(encoding="utf-8")
ENTRIES = dict(re.findall(r"^reactive_realizer/assets/(\S+) \((.+)\)$", NOTICE, re.MULTILINE))


def shipped_data() -> set[str]:
    """What lies in the assets folder, code left aside."""
    return {path.name for path in ASSETS.iterdir() if path.suffix != ".py" and path.name != "__pycache__"}


def entry(name: str) -> str:
    """What the notice says about a data folder."""
    return NOTICE.split(f"reactive_realizer/assets/{name} ")[1].split("\n\n")[0]


def test_every_data_folder_stands_in_the_notice_and_nothing_else_does() -> None:
    assert set(ENTRIES) == shipped_data()


def test_every_data_folder_has_a_license_that_lets_everyone_use_it() -> None:
    assert set(ENTRIES.values()) <= {"Apache-2.0", "CC0-1.0"}


def test_what_comes_from_elsewhere_carries_its_own_notice() -> None:
    from_elsewhere = [name for name in ENTRIES if "written for this" not in entry(name)]
    assert from_elsewhere == ["avatars", "voices"]
    assert "CC0 1.0" in (ASSETS / "avatars" / "LICENSE.md").read_text(encoding="utf-8")
    assert "Apache License 2.0" in (ASSETS / "voices" / "LICENSE.md").read_text(encoding="utf-8")


def test_every_library_in_the_page_bundle_stands_in_the_notice() -> None:
    package = json.loads((REPOSITORY / "web" / "package.json").read_text(encoding="utf-8"))
    for library in package["dependencies"]:
        assert re.search(rf"^{library}(\.js)? is part of the page bundle", NOTICE, re.MULTILINE), library


def test_the_voice_under_the_gpl_is_named_and_not_shipped() -> None:
    assert "espeak-ng (GPL-3.0-or-later)" in NOTICE
    assert not [path for path in REPOSITORY.glob("reactive_realizer/**/*espeak*") if path.suffix in {".so", ".dll"}]


def test_the_license_is_apache_2() -> None:
    assert "Apache License\n                           Version 2.0" in (REPOSITORY / "LICENSE").read_text(
        encoding="utf-8"
    )
