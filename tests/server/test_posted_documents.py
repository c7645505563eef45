"""Posted documents: which are accepted, and which are refused."""

from collections.abc import AsyncIterator

import pytest

from .conftest import ALICE, BML, XML, Open, post, wait


async def test_a_document_is_accepted_with_the_ids_of_its_blocks_and_plays(on_air: Open) -> None:
    async with on_air() as air:
        socket = await air.connect()
        assert await post(air, "/bml", wait("b1") + wait("b2")) == (202, {"blocks": ["b1", "b2"], "warnings": []})
        await air.tick_until(0.3)
        assert await socket.hear_feedback('"b2:end"')


@pytest.mark.parametrize(
    ("name", "body", "status", "code", "line"),
    [
        ("malformed XML", f'<bml {BML} id="b1">\n<wait\n</bml>', 400, "malformed-xml", 3),
        ("no block", "", 400, "no-block", 1),
        ("another document", "<html/>", 400, "not-bml", 1),
        ("a block without an id", f"\n<bml {BML}/>", 400, "no-block-id", 2),
        ("a DOCTYPE", f'<!DOCTYPE bml [<!ENTITY a "b">]><bml {BML} id="b1"/>', 400, "doctype", 1),
        ("bytes that are no text", b"\xff\xfe\x00", 400, None, None),
        ("a character who is not there", f'<bml {BML} id="b1" characterId="zoe"/>', 404, "unknown-character", 1),
    ],
)
async def test_a_document_that_cannot_be_parsed_is_refused(
    on_air: Open, name: str, body: str | bytes, status: int, code: str | None, line: int | None
) -> None:
    async with on_air() as air:
        answered, body_ = await post(air, "/bml", body)
        assert answered == status, name
        fault = body_["error"]
        assert fault["message"]
        assert set(fault) == {"code", "message", "line", "column"}
        if code is not None:
            assert (fault["code"], fault["line"]) == (code, line)
        assert not air.live.realizer.busy, "nothing of it has entered"


async def test_a_document_is_accepted_as_a_whole_or_not_at_all(on_air: Open) -> None:
    async with on_air() as air:
        await post(air, "/bml", wait("b1", 9))
        await air.tick()
        status, body = await post(air, "/bml", wait("b2") + "\n" + wait("b1"))
        assert (status, body["error"]["code"], body["error"]["line"]) == (409, "duplicate-block", 2)
        assert not air.live.realizer.busy


async def test_each_block_of_a_document_is_checked_against_those_before_it(on_air: Open) -> None:
    async with on_air() as air:
        status, body = await post(air, "/bml", wait("b1") + "\n" + wait("b1"))
        assert (status, body["error"]["code"], body["error"]["line"]) == (409, "duplicate-block", 2)
        assert not air.live.realizer.busy


async def test_blocks_before_a_replace_in_a_document_do_not_count_against_the_limit(on_air: Open) -> None:
    async with on_air(ALICE + "[limits]\nblocks_alive = 2\n") as air:
        socket = await air.connect()
        await post(air, "/bml", wait("q1", 9) + wait("q2", 9))
        await air.tick()
        replace = f'<bml {BML} id="x" composition="REPLACE"/>'
        assert await post(air, "/bml", replace + wait("q1")) == (202, {"blocks": ["x", "q1"], "warnings": []})
        await air.tick_until(0.3)
        assert "INTERRUPTED" in (await socket.hear_feedback('"q1:end"'))["xml"]
        assert "DONE" in (await socket.hear_feedback('"q1:end"'))["xml"]
        assert not air.live.realizer.scheduler.refused


async def test_earlier_blocks_of_a_document_count_against_the_limit(on_air: Open) -> None:
    async with on_air(ALICE + "[limits]\nblocks_alive = 2\n") as air:
        await post(air, "/bml", wait("b1", 9))
        await air.tick()
        status, body = await post(air, "/bml", wait("b2") + wait("b3"))
        assert (status, body["error"]["code"]) == (429, "too-many-blocks")


async def test_a_replace_does_not_affect_the_limit_for_blocks_of_another_character(on_air: Open) -> None:
    async with on_air(ALICE + "[character.bert]\n") as air:
        await post(air, "/bml", wait("b1", 9))
        await air.tick()
        replace = f'<bml {BML} id="x" characterId="bert" composition="REPLACE"/>'
        assert (await post(air, "/bml", replace + wait("b1")))[0] == 409


async def test_the_id_of_a_block_that_fails_at_once_can_be_used_again(on_air: Open) -> None:
    async with on_air() as air:
        fails = f'<bml {BML} id="b1"><required><wait id="w" duration="soon"/></required></bml>'
        assert (await post(air, "/bml", fails + wait("b1")))[0] == 202
        await air.tick()
        assert not air.live.realizer.scheduler.refused


SPEECH = f'<bml {BML} id="b1"><speech id="s"><text>d\u00e9j\u00e0 vu</text></speech></bml>'


@pytest.mark.parametrize(
    ("charset", "body"),
    [
        ("iso-8859-1", SPEECH.encode("iso-8859-1")),
        ("ISO-8859-1", f'<?xml version="1.0" encoding="UTF-8"?>{SPEECH}'.encode("iso-8859-1")),
        ("iso-8859-1", SPEECH.encode("utf-8-sig")),
        ("utf-8", f'<?xml version="1.0" encoding="ISO-8859-1"?>{SPEECH}'.encode()),
        ("utf-16", SPEECH.encode("utf-16")),
        ("utf-16", SPEECH.encode("utf-16-be")),
        ("utf-16le", SPEECH.encode("utf-16-le")),
    ],
)
async def test_a_charset_overrides_the_declaration_and_a_byte_order_mark_overrides_both(
    on_air: Open, charset: str, body: bytes
) -> None:
    async with on_air() as air:
        socket = await air.connect()
        assert (await post(air, "/bml", body, {"Content-Type": f"text/xml; charset={charset}"}))[0] == 202
        await air.tick()
        assert "d\u00e9j\u00e0 vu" in (await socket.hear_feedback("predictionFeedback"))["xml"]


@pytest.mark.parametrize("charset", ["klingon", "utf-7", "zlib", "rot13", '""'])
async def test_an_unsupported_charset_is_refused(on_air: Open, charset: str) -> None:
    async with on_air() as air:
        status, body = await post(air, "/bml", wait(), {"Content-Type": f"text/xml; charset={charset}"})
        assert (status, body["error"]["code"]) == (415, "wrong-charset")


@pytest.mark.parametrize(
    ("charset", "body", "code"),
    [("us-ascii", SPEECH.encode(), "malformed-xml"), ("utf-16", b"<bml/>?", "bad-encoding")],
)
async def test_bytes_that_are_invalid_in_their_charset_are_refused(
    on_air: Open, charset: str, body: bytes, code: str
) -> None:
    async with on_air() as air:
        status, answer = await post(air, "/bml", body, {"Content-Type": f"text/xml; charset={charset}"})
        assert (status, answer["error"]["code"]) == (400, code)


async def test_a_document_above_the_limit_of_bytes_is_refused(on_air: Open) -> None:
    async with on_air(ALICE + f"[limits]\nbml_bytes = {len(wait())}\n") as air:
        assert (await post(air, "/bml", wait()))[0] == 202
        status, body = await post(air, "/bml", wait() + " ")
        assert (status, body["error"]["code"]) == (413, "too-many-bytes")


async def test_a_body_above_the_limit_is_not_read_further(on_air: Open) -> None:
    spaces = iter([b" " * 100_000] * 1000)

    async def body() -> AsyncIterator[bytes]:
        for some in spaces:
            yield some

    async with on_air(ALICE + "[limits]\nbml_bytes = 1000\n") as air:
        async with air.client.post("/bml", data=body(), headers=XML) as answer:
            assert answer.status == 413
        assert len(list(spaces)) > 100, "most of it was never asked for"


async def test_blocks_above_the_limit_are_refused_until_others_are_stopped(on_air: Open) -> None:
    async with on_air(ALICE + "[limits]\nblocks_alive = 1\n") as air:
        await post(air, "/bml", wait("b1", 9))
        await air.tick()
        status, body = await post(air, "/bml", wait("b2"))
        assert (status, body["error"]["code"]) == (429, "too-many-blocks")
        await post(air, "/stop", "")
        await air.tick()
        assert (await post(air, "/bml", wait("b2")))[0] == 202


async def test_a_document_may_have_the_media_type_of_bml_and_need_no_ids(on_air: Open) -> None:
    async with on_air() as air:
        for number in (1, 2):
            text = '<bml><head type="NOD"/></bml>'
            status, body = await post(air, "/bml", text, {"Content-Type": "application/bml+xml"})
            assert (status, body) == (202, {"blocks": [f"document{number}"], "warnings": []})


@pytest.mark.parametrize(
    ("media_type", "text"),
    [
        (
            "application/vnd.smartbody+xml",
            '<act><participant id="alice"/><bml><sbm:noise/><head type="NOD"/></bml></act>',
        ),
        ("application/vnd.greta+xml", '<fml-apml><bml><head lexeme="NOD"/></bml><fml/></fml-apml>'),
    ],
)
async def test_what_smartbody_and_greta_write_has_media_types_of_its_own(
    on_air: Open, media_type: str, text: str
) -> None:
    async with on_air() as air:
        status, body = await post(air, "/bml", text, {"Content-Type": media_type})
        assert (status, body["blocks"]) == (202, ["document1"])
        async with air.client.get("/capabilities") as answer:
            assert media_type in (await answer.json())["mediaTypes"]


@pytest.mark.parametrize("media_type", ["text/plain", "application/json", "application/x-www-form-urlencoded"])
async def test_bml_that_is_not_sent_as_xml_is_refused(on_air: Open, media_type: str) -> None:
    async with on_air() as air:
        status, body = await post(air, "/bml", wait(), {"Content-Type": media_type})
        assert (status, body["error"]["code"]) == (415, "wrong-media-type")
