"""Procedures over the network: a use is accepted after its definition."""

import pytest

from reactive_realizer.realizer.inputs import BmlText

from .conftest import ALICE, BML, Open, post, wait

BMLT = 'xmlns:bmlt="http://hmi.ewi.utwente.nl/bmlt"'


def define(id_: str) -> str:
    return f'<bmlt:defineproc {BML} {BMLT} id="{id_}"><wait id="w" duration="0.1"/></bmlt:defineproc>'


def use(procedure: str, block: str) -> str:
    return f'<bmlt:useproc {BMLT} procid="{procedure}" bmlid="{block}"/>'


async def test_a_use_of_an_undefined_procedure_is_refused_by_the_server(on_air: Open) -> None:
    async with on_air() as air:
        status, body = await post(air, "/bml", wait("b1") + "\n" + use("nothing", "b2"))
        assert (status, body["error"]["code"], body["error"]["line"]) == (404, "unknown-procedure", 2)
        assert "nothing" in body["error"]["message"]
        assert not air.live.realizer.busy, "nothing of it has entered"


async def test_over_the_socket_the_refused_use_is_not_among_the_accepted_blocks(on_air: Open) -> None:
    async with on_air() as air:
        socket = await air.connect()
        answer = await socket.ask(type="bml", xml=use("nothing", "b1") + wait("b2"))
        assert (answer["type"], answer["code"], answer["blocks"]) == ("error", "unknown-procedure", ["b2"])
        await air.tick()
        assert 'id="b1"' in (await socket.hear_feedback("warningFeedback"))["xml"]
        assert await socket.hear_feedback('"b2:start"')


@pytest.mark.parametrize(
    "documents", [[define("p") + use("p", "b1")], [define("p"), use("p", "b1")]], ids=["in one", "one after the other"]
)
@pytest.mark.parametrize("ticks", [0, 1])
async def test_a_procedure_can_be_used_as_soon_as_its_definition_is_accepted(
    on_air: Open, documents: list[str], ticks: int
) -> None:
    async with on_air() as air:
        socket = await air.connect()
        answer = None
        for document in documents:
            answer = await post(air, "/bml", document)
            for _ in range(ticks):
                await air.tick()
        assert answer == (202, {"blocks": ["b1"], "warnings": []})
        await air.tick_until(0.3)
        assert "DONE" in (await socket.hear_feedback('"b1:end"'))["xml"]


async def test_a_definition_in_a_refused_document_has_no_effect(on_air: Open) -> None:
    async with on_air() as air:
        assert (await post(air, "/bml", define("p") + wait("b1") + wait("b1")))[0] == 409
        assert (await post(air, "/bml", use("p", "b2")))[0] == 404


async def test_a_definition_that_the_realizer_refused_has_no_effect(on_air: Open) -> None:
    async with on_air(ALICE + "[limits]\nprocedures = 1\n") as air:
        air.live.realizer.put(BmlText(define("first")))
        assert (await post(air, "/bml", define("p")))[0] == 202
        await air.tick()
        status, body = await post(air, "/bml", use("p", "b1"))
        assert (status, body["error"]["code"]) == (404, "unknown-procedure")
        assert (await post(air, "/bml", use("first", "b2")))[0] == 202


async def test_procedures_above_the_limit_are_refused_unless_they_replace_others(
    on_air: Open,
) -> None:
    async with on_air(ALICE + "[limits]\nprocedures = 2\n") as air:
        assert await post(air, "/bml", define("p") + define("q")) == (202, {"blocks": [], "warnings": []})
        status, body = await post(air, "/bml", define("r"))
        assert (status, body["error"]["code"]) == (429, "too-many-procedures")
        assert (await post(air, "/bml", define("q")))[0] == 202
        await air.tick()
        assert not air.live.realizer.scheduler.refused
