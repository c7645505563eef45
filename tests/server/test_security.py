"""Access control: origins, host names and tokens."""

from pathlib import Path

import aiohttp
import pytest

from reactive_realizer.errors import RealizerError
from reactive_realizer.server import routes_page
from reactive_realizer.server.security import Security
from reactive_realizer.server.token_check import COOKIE, PAUSE

from .conftest import Open

ELSEWHERE = "https://elsewhere.example"


async def test_a_page_of_another_origin_is_refused(on_air: Open) -> None:
    async with on_air() as air:
        for path in ("/status", "/feedback", "/protocol.json"):
            async with air.client.get(path, headers={"Origin": ELSEWHERE}) as answer:
                assert answer.status == 403
                assert (await answer.json())["error"]["code"] == "foreign-origin"
        with pytest.raises(aiohttp.WSServerHandshakeError) as refused:
            await air.connect(origin=ELSEWHERE)
        assert refused.value.status == 403


async def test_requests_without_an_origin_and_from_the_page_itself_are_allowed(on_air: Open) -> None:
    async with on_air() as air:
        assert (await air.connect()).hello
        assert (await air.connect(origin=str(air.client.make_url("/").origin()))).hello


async def test_a_page_of_an_allowed_origin_may_send_requests_and_read_answers(on_air: Open) -> None:
    async with on_air(security=Security(origins=(ELSEWHERE,))) as air:
        assert (await air.connect(origin=ELSEWHERE)).hello
        async with air.client.get("/status", headers={"Origin": ELSEWHERE, "Sec-Fetch-Site": "cross-site"}) as answer:
            assert answer.status == 200
            assert answer.headers["Access-Control-Allow-Origin"] == ELSEWHERE
        async with air.client.options("/bml", headers={"Origin": ELSEWHERE}) as answer:
            assert answer.status == 204
            assert "Content-Type" in answer.headers["Access-Control-Allow-Headers"]
        async with air.client.get("/status", headers={"Origin": "null"}) as answer:
            assert answer.status == 403
            assert "Access-Control-Allow-Origin" not in answer.headers


@pytest.mark.parametrize("site", ["cross-site", "same-site"])
@pytest.mark.parametrize("path", ["/audio/alice-1.wav", "/avatars/female.glb", "/status"])
async def test_a_page_of_another_site_cannot_embed_anything(on_air: Open, site: str, path: str) -> None:
    embedded = {"Sec-Fetch-Site": site, "Sec-Fetch-Mode": "no-cors", "Sec-Fetch-Dest": "audio"}
    async with on_air() as air, air.client.get(path, headers=embedded) as answer:
        assert answer.status == 403
        assert (await answer.json())["error"]["code"] == "foreign-page"


async def test_other_sites_can_link_to_the_viewer_but_to_no_sound(on_air: Open) -> None:
    followed = {"Sec-Fetch-Site": "cross-site", "Sec-Fetch-Mode": "navigate", "Sec-Fetch-Dest": "document"}
    async with on_air() as air:
        for path, refused in (("/", False), ("/audio/alice-1.wav", True)):
            async with air.client.get(path, headers=followed) as answer:
                assert (answer.status == 403) is refused


@pytest.mark.parametrize("site", ["same-origin", "none"])
async def test_the_viewer_and_the_address_bar_can_load_everything(on_air: Open, site: str) -> None:
    async with on_air() as air:
        for path in ("/status", "/avatars/female.glb"):
            async with air.client.get(path, headers={"Sec-Fetch-Site": site}) as answer:
                assert answer.status == 200


async def test_browsers_are_told_that_other_sites_may_embed_nothing(on_air: Open) -> None:
    async with on_air() as air:
        for path in ("/audio/alice-1.wav", "/avatars/female.glb", "/status"):
            async with air.client.get(path) as answer:
                assert answer.headers["Cross-Origin-Resource-Policy"] == "same-origin"


@pytest.mark.parametrize("host", ["elsewhere.example", "elsewhere.example:8088", "192.168.1.7", "[::"])
async def test_an_unknown_host_name_is_refused(on_air: Open, host: str) -> None:
    async with on_air() as air, air.client.get("/status", headers={"Host": host}) as answer:
        assert answer.status == 403
        assert (await answer.json())["error"]["code"] == "foreign-host"


@pytest.mark.parametrize("host", ["localhost:8088", "127.0.0.1", "[::1]:8088"])
async def test_the_names_of_the_loopback_interface_are_allowed(on_air: Open, host: str) -> None:
    async with on_air() as air, air.client.get("/status", headers={"Host": host}) as answer:
        assert answer.status == 200


async def test_an_exposed_server_allows_its_addresses_and_the_hosts_of_allowed_origins(on_air: Open) -> None:
    exposed = Security("0.0.0.0", "s3cret", origins=("http://robot.local:8088",))
    async with on_air(security=exposed) as air:
        for host, status in (("192.168.1.7:8088", 200), ("robot.local:8088", 200), ("elsewhere.example", 403)):
            async with air.client.get("/status?token=s3cret", headers={"Host": host}) as answer:
                assert answer.status == status


async def test_requests_without_the_token_are_refused_if_one_is_set(on_air: Open) -> None:
    async with on_air(security=Security(token="s3cret")) as air:
        wrong: list[tuple[dict[str, str], dict[str, str]]] = [
            ({}, {}),
            ({"Authorization": "Bearer other"}, {}),
            ({}, {"token": "ö"}),
        ]
        for headers, params in wrong:
            for path in ("/", "/status", "/nothing", "/avatars/female.glb"):
                async with air.client.get(path, headers=headers, params=params) as answer:
                    assert answer.status == 401
                    assert (await answer.json())["error"]["code"] == "no-token"
        with pytest.raises(aiohttp.WSServerHandshakeError) as refused:
            await air.connect()
        assert refused.value.status == 401


async def test_a_token_may_be_in_a_header_or_in_the_address(on_air: Open) -> None:
    async with on_air(security=Security(token="s3cret")) as air:
        async with air.client.get("/status", headers={"Authorization": "Bearer s3cret"}) as answer:
            assert answer.status == 200
        assert (await air.connect("?token=s3cret")).hello


async def test_a_page_that_is_opened_with_the_token_keeps_it_as_a_cookie_and_not_in_its_address(
    on_air: Open, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    static = tmp_path / "static"
    static.mkdir()
    (static / "index.html").write_text("hello")
    monkeypatch.setattr(routes_page, "STATIC", static)
    async with on_air(security=Security(token="s3cret")) as air:
        async with air.client.get("/?quality=low&token=s3cret", allow_redirects=False) as answer:
            assert answer.status == 303
            assert answer.headers["Location"] == "/?quality=low"
            cookie = answer.cookies[COOKIE]
            assert cookie["httponly"]
            assert cookie["samesite"] == "Strict"
            assert not cookie["secure"], "browsers return a secure cookie by TLS alone"
        shown = {"Cookie": f"{COOKIE}={cookie.value}"}
        for path in ("/", "/status"):
            async with air.client.get(path, headers=shown) as answer:
                assert answer.status == 200


async def test_behind_a_proxy_with_tls_the_cookie_is_secure(
    on_air: Open, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "index.html").write_text("hello")
    monkeypatch.setattr(routes_page, "STATIC", tmp_path)
    async with on_air(security=Security(token="s3cret")) as air:
        by_tls = {"X-Forwarded-Proto": "https"}
        async with air.client.get("/?token=s3cret", headers=by_tls, allow_redirects=False) as answer:
            assert answer.cookies[COOKIE]["secure"]


async def test_after_a_wrong_token_the_next_one_from_the_address_is_examined_later(on_air: Open) -> None:
    async with on_air(security=Security(token="s3cret")) as air:
        for token, status, time in (("right?", 401, 0.0), ("s3cret", 200, PAUSE), ("s3cret", 200, PAUSE)):
            async with air.client.get("/status", params={"token": token}) as answer:
                assert answer.status == status
            assert air.live.now == time


async def test_a_request_without_a_token_is_no_attempt_to_guess_it(on_air: Open) -> None:
    async with on_air(security=Security(token="s3cret")) as air:
        for token, status in (("", 401), ("s3cret", 200)):
            async with air.client.get("/status", params={"token": token}) as answer:
                assert answer.status == status
        assert air.live.now == 0.0


@pytest.mark.parametrize("host", ["127.0.0.1", "0.0.0.0"])
@pytest.mark.parametrize("token", ["", "  \n"])
def test_an_empty_token_is_refused(host: str, token: str) -> None:
    with pytest.raises(RealizerError) as refused:
        Security(host, token)
    assert refused.value.fault.code == "empty-token"


@pytest.mark.parametrize("host", ["0.0.0.0", "::", "robot.local", ""])
def test_a_server_that_other_machines_can_reach_requires_a_token(host: str) -> None:
    with pytest.raises(RealizerError) as refused:
        Security(host)
    assert refused.value.fault.code == "token-required"


@pytest.mark.parametrize(
    ("host", "exposed"),
    [("127.0.0.1", False), ("::1", False), ("localhost", False), ("0.0.0.0", True), ("robot.local", True)],
)
def test_other_machines_can_connect_if_the_server_listens_on_all_interfaces(host: str, exposed: bool) -> None:
    assert Security(host, "s3cret").exposed is exposed
