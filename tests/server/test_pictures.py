"""The pictures of characters: the stream that tells them, and their files."""

from pathlib import Path
from typing import Any

from .conftest import BML, Open, Socket

EXAMPLE = Path("examples/pictures")
SMILE = f'<bml {BML} id="b"><faceLexeme id="f" lexeme="SMILE" start="0.5" end="1"/></bml>'


async def pictures(socket: Socket) -> list[dict[str, Any]]:
    """The messages about pictures until now."""
    await socket.say(type="clock")
    heard = []
    while (message := await socket.hear("pictures", "clock"))["type"] != "clock":
        heard.append(message)
    return heard


async def test_pictures_are_told_when_they_change_and_can_be_fetched(on_air: Open) -> None:
    async with on_air((EXAMPLE / "human.toml").read_text(encoding="utf-8"), assets=(EXAMPLE,)) as air:
        page, planner = await air.connect("?streams=pictures"), await air.connect("?streams=")
        await planner.ask(type="bml", xml=SMILE)
        await air.tick_until(2.0)
        told = await pictures(page)
        assert [message["files"][1:] for message in told] == [
            ["faces/rest.png"],
            ["faces/rest.png", "faces/smile.png"],
            ["faces/rest.png"],
        ]
        assert [message["character"] for message in told] == ["paula"] * 3
        assert told[1]["time"] - told[0]["time"] > 0.4
        late = await air.connect("?streams=pictures")
        await air.tick_until(2.1)
        (first,) = await pictures(late)
        assert first["files"] == ["faces/head.png", "faces/rest.png"]
        async with air.client.get("/pictures/faces/head.png") as answer:
            assert answer.content_type == "image/png"
            assert await answer.read() == (EXAMPLE / "faces" / "head.png").read_bytes()


async def test_a_page_that_comes_back_learns_that_pictures_are_gone(on_air: Open, tmp_path: Path) -> None:
    (tmp_path / "smile.png").touch()
    human = '[character.alice]\nengines = ["picture"]\n'
    image = '<addImage xmlns="http://hmi.ewi.utwente.nl/pictureengine" id="i" fileName="smile.png"/>'
    async with on_air(human, assets=(tmp_path,)) as air:
        page, planner = await air.connect("?streams=pictures"), await air.connect("?streams=")
        await planner.ask(type="bml", xml=f'<bml {BML} id="b">{image}</bml>')
        await air.tick_until(0.5)
        assert [message["files"] for message in await pictures(page)] == [["smile.png"]]
        await page.raw.close()
        await air.tick_until(2.0)
        again = await air.connect("?streams=pictures")
        await air.tick_until(2.1)
        assert [message["files"] for message in await pictures(again)] == [[]]


async def test_a_picture_may_be_a_link_to_a_file_with_another_name(on_air: Open, tmp_path: Path) -> None:
    (tmp_path / "stored").write_bytes(b"picture")
    (tmp_path / "link.png").symlink_to(tmp_path / "stored")
    async with on_air(assets=(tmp_path,)) as air, air.client.get("/pictures/link.png") as answer:
        assert (answer.status, answer.content_type) == (200, "image/png")
        assert await answer.read() == b"picture"
