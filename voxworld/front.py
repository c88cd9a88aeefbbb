"""The door to the shared world: the one address that browsers know, and who may come in.

viser has no notion of who connects, so it listens on an address of its own inside the machine and this front stands
before it: it checks every request and every socket, adds the page's own script, and passes the rest on.
"""

from __future__ import annotations

import asyncio
import hmac
import ipaddress
import logging
import secrets
import socket
import threading
from collections.abc import Awaitable, Callable
from dataclasses import dataclass
from importlib.resources import files
from typing import Protocol
from urllib.parse import urlsplit

import aiohttp
from aiohttp import web

COOKIE = "kirby_token"
START_TIMEOUT_S = 10.0
FRAME_MAX_BYTES = 64 * 1024 * 1024
# Nothing on the page may ask anything of another machine.
_POLICY = (
    "default-src 'self' blob: data:; script-src 'self' 'unsafe-inline' 'unsafe-eval' 'wasm-unsafe-eval' blob: data:; "
    "style-src 'self' 'unsafe-inline'; connect-src 'self' ws: wss: blob: data:; worker-src 'self' blob: data:; "
    "frame-ancestors 'none'; base-uri 'none'; form-action 'self'"
)

Handler = Callable[[web.Request], Awaitable[web.StreamResponse]]


class Behind(Protocol):
    """What the front asks of those behind it; called in threads of their own."""

    def stop(self, who: str) -> str:
        """Stop the robot now; what came of it, in words."""

    def scene_json(self) -> str:
        """The scene for other engines."""


@dataclass(frozen=True, slots=True)
class Address:
    """Where to listen. ``token`` is what every browser must present.

    Raises:
        ValueError: other machines reach the host, and there is no token.
    """

    host: str = "127.0.0.1"
    port: int = 8080
    token: str | None = None

    def __post_init__(self) -> None:
        if not self.loopback and not self.token:
            raise ValueError(f"{self.host} can be reached from other machines: a token is needed")

    @property
    def loopback(self) -> bool:
        return is_loopback(self.host)

    @property
    def shown_host(self) -> str:
        """The host for a URL; for "every address", the machine's name."""
        host = socket.gethostname() if self.host in ("0.0.0.0", "::") else self.host  # noqa: S104 - compared, not bound
        return f"[{host}]" if ":" in host else host


def is_loopback(host: str) -> bool:
    """Whether only this machine can reach the address."""
    if host == "localhost":
        return True
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:
        return False


def hidden_host() -> str:
    """A host for what stands behind the front: loopback, and on Linux one that nobody can guess.

    A web page from elsewhere may open sockets to 127.0.0.1 and try every port; it cannot try 16 million hosts too.
    """
    host = f"127.{secrets.randbelow(256)}.{secrets.randbelow(256)}.{1 + secrets.randbelow(254)}"
    with socket.socket() as probe:
        try:
            probe.bind((host, 0))
        except OSError:  # elsewhere only 127.0.0.1 is there to be bound
            return "127.0.0.1"
    return host


class Front:
    """An authenticating reverse proxy in a thread of its own."""

    def __init__(self, address: Address, inner: tuple[str, int], behind: Behind) -> None:
        self._address = address
        self._inner = f"http://{inner[0]}:{inner[1]}"
        self._behind = behind
        self._loop = asyncio.new_event_loop()
        self._thread = threading.Thread(target=self._loop.run_forever, name="view-front", daemon=True)
        self._runner: web.AppRunner | None = None
        self._session: aiohttp.ClientSession | None = None
        self.port = address.port

    @property
    def url(self) -> str:
        """The address to open, with the token where one is asked."""
        query = f"?token={self._address.token}" if self._address.token else ""
        return f"http://{self._address.shown_host}:{self.port}/{query}"

    def start(self) -> None:
        """Begin to listen.

        Raises:
            OSError: the address is taken or not this machine's.
        """
        self._thread.start()
        asyncio.run_coroutine_threadsafe(self._listen(), self._loop).result(START_TIMEOUT_S)

    def close(self) -> None:
        if not self._thread.is_alive():
            return
        asyncio.run_coroutine_threadsafe(self._hang_up(), self._loop).result(START_TIMEOUT_S)
        self._loop.call_soon_threadsafe(self._loop.stop)
        self._thread.join(START_TIMEOUT_S)

    async def _listen(self) -> None:
        application = web.Application(middlewares=[self._guard])
        application.router.add_get("/kirby.js", self._script)
        application.router.add_get("/scene.json", self._scene)
        application.router.add_post("/stop", self._stop)
        application.router.add_get("/{path:.*}", self._pass_on)
        logging.getLogger("aiohttp.access").setLevel(logging.WARNING)
        self._session = aiohttp.ClientSession()
        self._runner = web.AppRunner(application, access_log=None, shutdown_timeout=1.0)
        await self._runner.setup()
        site = web.TCPSite(self._runner, self._address.host, self._address.port)
        await site.start()
        self.port = self._runner.addresses[0][1]

    async def _hang_up(self) -> None:
        if self._session is not None:
            await self._session.close()
        if self._runner is not None:
            await self._runner.cleanup()

    # ------------------------------------------------------------------ who may come in
    @web.middleware
    async def _guard(self, request: web.Request, handler: Handler) -> web.StreamResponse:
        """Every request passes here, the page's as well as the sockets'."""
        if not self._same_origin(request):
            return web.Response(status=403, text="this world is not open to pages from elsewhere\n")
        token = self._address.token
        if token is None:
            return await handler(request)
        offered = request.query.get("token", "")
        if _equal(offered, token):
            return _admit(request, token)
        if _equal(request.cookies.get(COOKIE, ""), token):
            return await handler(request)
        return web.Response(status=401, text="open the address that Kirby printed, with its ?token=...\n")

    def _same_origin(self, request: web.Request) -> bool:
        """No page from elsewhere, and no name from elsewhere that was made to point here (DNS rebinding)."""
        host = request.host
        if self._address.loopback and not is_loopback(urlsplit(f"//{host}").hostname or ""):
            return False
        origin = request.headers.get("Origin")
        return origin is None or urlsplit(origin).netloc == host

    # ------------------------------------------------------------------ what is behind
    async def _script(self, _: web.Request) -> web.Response:
        script = files("voxworld").joinpath("page.js").read_text(encoding="utf-8")
        return web.Response(text=script, content_type="application/javascript", headers={"Cache-Control": "no-cache"})

    async def _scene(self, _: web.Request) -> web.Response:
        return web.Response(text=await asyncio.to_thread(self._behind.scene_json), content_type="application/json")

    async def _stop(self, request: web.Request) -> web.Response:
        who = (await request.text())[:64]
        return web.Response(text=await asyncio.to_thread(self._behind.stop, who))

    async def _pass_on(self, request: web.Request) -> web.StreamResponse:
        if request.headers.get("Upgrade", "").lower() == "websocket":
            return await self._relay(request)
        assert self._session is not None
        async with self._session.get(f"{self._inner}{request.path}") as answer:
            body = await answer.read()
            headers = {"Content-Security-Policy": _POLICY, "Referrer-Policy": "no-referrer"}
            if answer.content_type == "text/html":
                body = body.replace(b"</head>", b'<script src="/kirby.js" defer></script></head>', 1)
            return web.Response(status=answer.status, body=body, content_type=answer.content_type, headers=headers)

    async def _relay(self, request: web.Request) -> web.WebSocketResponse:
        """A browser's socket to one of viser's, both ways, until either closes."""
        asked = tuple(part.strip() for part in request.headers.get("Sec-WebSocket-Protocol", "").split(",") if part)
        outer = web.WebSocketResponse(protocols=asked, max_msg_size=FRAME_MAX_BYTES, compress=False)
        await outer.prepare(request)
        assert self._session is not None
        async with self._session.ws_connect(
            self._inner, protocols=asked, max_msg_size=FRAME_MAX_BYTES, compress=0
        ) as inner:
            pumps = [asyncio.create_task(_pump(inner, outer)), asyncio.create_task(_pump(outer, inner))]
            await asyncio.wait(pumps, return_when=asyncio.FIRST_COMPLETED)
            for pump in pumps:
                pump.cancel()
            await asyncio.gather(*pumps, return_exceptions=True)
        await outer.close()
        return outer


Socket = aiohttp.ClientWebSocketResponse | web.WebSocketResponse


async def _pump(source: Socket, sink: Socket) -> None:
    async for message in source:
        if message.type is aiohttp.WSMsgType.BINARY:
            await sink.send_bytes(message.data)
        elif message.type is aiohttp.WSMsgType.TEXT:
            await sink.send_str(message.data)


def _equal(offered: str, token: str) -> bool:
    """In constant time, so that answers do not tell how much of a guess was right."""
    return hmac.compare_digest(offered.encode(), token.encode())


def _admit(request: web.Request, token: str) -> web.StreamResponse:
    """Take the token out of the address bar and into a cookie that no script can read."""
    answer = web.Response(status=303, headers={"Location": request.path})
    answer.set_cookie(COOKIE, token, httponly=True, samesite="Strict")
    return answer
