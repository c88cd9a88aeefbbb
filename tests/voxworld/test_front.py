"""Who may come in: without the token no page and no socket, from anywhere; and never a page from elsewhere."""

from __future__ import annotations

import asyncio
from collections.abc import Iterator

import aiohttp
import pytest
import viser

from voxworld.front import COOKIE, Address, is_loopback
from voxworld.view import VoxWorld

TOKEN = "correct-horse"
SECOND_LOOPBACK = "127.0.0.2"
VISER = f"viser-v{viser.__version__}"


@pytest.fixture
def guarded(host: object) -> Iterator[VoxWorld]:
    world = VoxWorld(host, {}, Address(SECOND_LOOPBACK, 0, TOKEN))  # type: ignore[arg-type]
    world.start()
    yield world
    world.close()


def base(world: VoxWorld) -> str:
    return world.url.partition("?")[0]


def ask(
    url: str, method: str = "GET", headers: dict[str, str] | None = None, cookies: dict[str, str] | None = None
) -> tuple[int, str]:
    async def run() -> tuple[int, str]:
        async with (
            aiohttp.ClientSession(cookies=cookies) as session,
            session.request(method, url, headers=headers, allow_redirects=False) as answer,
        ):
            return answer.status, (await answer.text())[:200]

    return asyncio.run(run())


def socket_opens(url: str, headers: dict[str, str] | None = None, cookies: dict[str, str] | None = None) -> bool:
    """Whether a socket opens and something comes over it."""

    async def run() -> bool:
        async with aiohttp.ClientSession(cookies=cookies) as session:
            try:
                async with session.ws_connect(url, protocols=(VISER,), headers=headers) as socket:
                    return (await socket.receive(timeout=5)).type is aiohttp.WSMsgType.BINARY
            except aiohttp.WSServerHandshakeError:
                return False

    return asyncio.run(run())


@pytest.mark.parametrize("path", ["", "index.html", "kirby.js", "scene.json", "nothing"])
@pytest.mark.parametrize("query", ["", "?token=", "?token=wrong", f"?token={TOKEN}x", "?token=%C3%BC"])
def test_without_the_token_no_page(guarded: VoxWorld, path: str, query: str) -> None:
    status, text = ask(f"{base(guarded)}{path}{query}")
    assert status == 401
    assert TOKEN not in text


def test_without_the_token_nothing_can_be_stopped(guarded: VoxWorld, host: object) -> None:
    assert ask(f"{base(guarded)}stop", "POST")[0] == 401
    assert host.asked.empty()  # type: ignore[attr-defined]


@pytest.mark.parametrize("cookies", [None, {COOKIE: "wrong"}, {COOKIE: ""}])
def test_without_the_token_no_socket(guarded: VoxWorld, cookies: dict[str, str] | None) -> None:
    assert not socket_opens(base(guarded), cookies=cookies)


def test_the_token_becomes_a_cookie_that_opens_page_and_socket(guarded: VoxWorld) -> None:
    assert ask(guarded.url)[0] == 303
    cookies = {COOKIE: TOKEN}
    status, page = ask(base(guarded), cookies=cookies)
    assert status == 200
    assert "<html" in page.lower()
    assert socket_opens(base(guarded), cookies=cookies)


@pytest.mark.parametrize("address", ["0.0.0.0", "::", "192.0.2.7", "kirby.example"])
def test_an_address_that_others_reach_needs_a_token(address: str) -> None:
    with pytest.raises(ValueError, match="token"):
        Address(address, 0)


def test_a_page_from_elsewhere_gets_nothing(voxworld: VoxWorld) -> None:
    elsewhere = {"Origin": "http://evil.example"}
    assert ask(f"{voxworld.url}stop", "POST", elsewhere)[0] == 403
    assert ask(voxworld.url, headers=elsewhere)[0] == 403
    assert not socket_opens(voxworld.url, headers=elsewhere)


def test_a_name_from_elsewhere_that_points_here_gets_nothing(voxworld: VoxWorld) -> None:
    rebound = {"Host": "evil.example"}
    assert ask(voxworld.url, headers=rebound)[0] == 403
    assert not socket_opens(voxworld.url, headers=rebound | {"Origin": "http://evil.example"})


def test_on_this_machine_no_token_is_asked(voxworld: VoxWorld) -> None:
    assert ask(voxworld.url)[0] == 200
    assert socket_opens(voxworld.url, headers={"Origin": voxworld.url.rstrip("/")})


def test_the_scene_is_there_for_other_engines(voxworld: VoxWorld) -> None:
    status, text = ask(f"{voxworld.url}scene.json")
    assert (status, text[:8]) == (200, '{"axes":')


@pytest.mark.parametrize("name", ["127.0.0.1", "127.9.9.9", "::1", "localhost"])
def test_what_counts_as_this_machine(name: str) -> None:
    assert is_loopback(name)


@pytest.mark.parametrize("name", ["0.0.0.0", "10.0.0.1", "localhost.evil.example", ""])
def test_what_counts_as_another_machine(name: str) -> None:
    assert not is_loopback(name)
