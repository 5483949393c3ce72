"""Starts `scenec watch` for a test and talks to it without a browser.

Everything lives in a temporary folder; nothing beyond loopback is used.
"""

import base64
import json
import os
import re
import shutil
import signal
import socket
import struct
import subprocess
import tempfile
import time
import urllib.error
import urllib.request

SCENEC = os.environ["SCENEC"]
# How many times as long as usual is waited: programs that look after themselves are slow.
PATIENCE = float(os.environ.get("SCENEC_PATIENCE", "1"))

BALL = """sdl 1;
/// Power of the lamp.
param watts: power = 60W in 0W .. 200W;
param tint: color = #c04020;
param lit: bool = true;
param size: length = 1m in 0.1m .. 2m;
material skin: diffuse {{ color = {color}; }}
material felt: diffuse {{ color = tint; }}
sphere ball {{ center = [0, 1, 0]; radius = size; material = skin; }}
plane ground {{ normal = [0, 1, 0]; material = felt; }}
if lit {{ light key: point {{ position = [2, 4, 3]; power = watts; }} }}
light sky: environment {{ constant = gray(0.2); }}
camera main: pinhole {{ eye = [0, 2, 6]; aim = [0, 1, 0]; fov = {fov}deg; }}
render {{ size = [{width}, {height}]; samples = {samples}; }}
"""


def ball(color="rgb(0.8, 0.2, 0.1)", fov=40, width=160, height=90, samples=16):
    return BALL.format(color=color, fov=fov, width=width, height=height, samples=samples)


def wait_for(condition, what, seconds=20.0):
    """The condition's value as soon as it is one."""
    end = time.monotonic() + seconds * PATIENCE
    while True:
        value = condition()
        if value:
            return value
        if time.monotonic() > end:
            raise AssertionError(f"waited {seconds} s for {what}")
        time.sleep(0.005)


class Daemon:
    """One run of the daemon; `with` ends it."""

    def __init__(self, *scenes, folder=None, options=(), environment=None):
        self.owns_folder = folder is None
        self.folder = folder or tempfile.mkdtemp(prefix="scenec-watch-")
        self.scenes = scenes or ("scene.sdl",)
        self.options = options
        self.environment = environment or {}
        self.process = None
        self.prefix = []  # of the command
        self.user = None  # who runs it; nothing: who runs the test

    def write(self, name, text):
        path = os.path.join(self.folder, name)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        return path

    def path(self, name):
        return os.path.join(self.folder, name)

    def start(self):
        self.log = open(self.path("stderr.log"), "wb")
        environment = dict(os.environ, SCENEC_CACHE="off", **self.environment)
        self.process = subprocess.Popen(
            [*self.prefix, SCENEC, "watch", *self.scenes, *self.options], cwd=self.folder,
            env=environment, stdout=subprocess.PIPE, stderr=self.log, user=self.user)
        address = wait_for(lambda: re.search(r"http://127\.0\.0\.1:(\d+)/#token=([0-9a-f]+)",
                                             self.errors()), "the address")
        self.url = address.group(0)
        self.port = int(address.group(1))
        self.token = address.group(2)
        return self

    def errors(self):
        with open(self.path("stderr.log"), encoding="utf-8", errors="replace") as file:
            return file.read()

    def stop(self, number=signal.SIGTERM):
        if self.process is None:
            return None
        self.process.send_signal(number)
        self.process.communicate(timeout=20 * PATIENCE)
        code, self.process = self.process.returncode, None
        self.log.close()
        return code

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.stop()
        if self.owns_folder:
            shutil.rmtree(self.folder, ignore_errors=True)

    # ---- HTTP

    def ask(self, path, body=None, headers=None, token=True, method=None):
        """Status and bytes of the answer."""
        all_headers = {"X-Scenec-Token": self.token} if token else {}
        data = None
        if body is not None:
            data = json.dumps(body).encode()
            all_headers["Content-Type"] = "application/json"
        all_headers.update(headers or {})
        request = urllib.request.Request(f"http://127.0.0.1:{self.port}{path}", data=data,
                                         headers=all_headers, method=method)
        try:
            with urllib.request.urlopen(request, timeout=20 * PATIENCE) as answer:
                return answer.status, answer.read()
        except urllib.error.HTTPError as problem:
            return problem.code, problem.read()

    def resident_kib(self):
        with open(f"/proc/{self.process.pid}/status", encoding="ascii") as file:
            return int(re.search(r"VmRSS:\s+(\d+)", file.read()).group(1))

    def thread_count(self):
        return len(os.listdir(f"/proc/{self.process.pid}/task"))

    def descriptor_count(self):
        return len(os.listdir(f"/proc/{self.process.pid}/fd"))


class Stream:
    """The daemon's WebSocket, as a page sees it."""

    def __init__(self, daemon, scene="0", shows=True, headers=None, token=None):
        self.socket = socket.create_connection(("127.0.0.1", daemon.port), timeout=20 * PATIENCE)
        key = base64.b64encode(os.urandom(16)).decode()
        lines = {"Host": f"127.0.0.1:{daemon.port}", "Upgrade": "websocket", "Connection": "Upgrade",
                 "Sec-WebSocket-Version": "13", "Sec-WebSocket-Key": key,
                 "Sec-WebSocket-Protocol": f"scenec, token.{token or daemon.token}"}
        lines.update(headers or {})
        head = "".join(f"{name}: {value}\r\n" for name, value in lines.items())
        self.socket.sendall(f"GET /stream?scene={scene} HTTP/1.1\r\n{head}\r\n".encode())
        self.bytes = b""
        while b"\r\n\r\n" not in self.bytes:
            more = self.socket.recv(65536)
            if not more:
                break
            self.bytes += more
        answer, _, self.bytes = self.bytes.partition(b"\r\n\r\n")
        self.status = int(answer.split()[1]) if answer else 0
        self.shows = shows
        self.state = None
        self.frame = None
        self.states = []
        self.frames = []

    def _take(self, count):
        while len(self.bytes) < count:
            more = self.socket.recv(1 << 20)
            if not more:
                raise ConnectionError("the daemon closed the stream")
            self.bytes += more
        taken, self.bytes = self.bytes[:count], self.bytes[count:]
        return taken

    def _send(self, kind, payload):
        mask = os.urandom(4)
        masked = bytes(b ^ mask[i % 4] for i, b in enumerate(payload))
        self.socket.sendall(bytes([0x80 | kind, 0x80 | len(payload)]) + mask + masked)

    def next(self):
        """Takes one message; `state` or `frame` is then a new one."""
        first, second = self._take(2)
        size = second & 127
        if size == 126:
            size = struct.unpack(">H", self._take(2))[0]
        elif size == 127:
            size = struct.unpack(">Q", self._take(8))[0]
        payload = self._take(size)
        kind = first & 15
        if kind == 1:
            self.state = json.loads(payload)
            self.states.append((time.monotonic(), self.state))
            return "state"
        if kind == 2:
            names = ("generation", "width", "height", "step", "x0", "y0", "x1", "y1", "columns",
                     "rows", "samples")
            self.frame = dict(zip(names, struct.unpack("<11i", payload[4:48])))
            self.frame["bytes"] = payload[48:]
            self.frame["at"] = time.monotonic()
            self.frames.append(self.frame)
            if self.shows:
                self._send(1, b"shown")
            return "frame"
        if kind == 9:
            self._send(10, payload)
        return "other"

    def until(self, condition, what, seconds=20.0):
        """Reads on until the condition on this stream holds."""
        end = time.monotonic() + seconds * PATIENCE
        while not condition(self):
            left = end - time.monotonic()
            if left <= 0:
                raise AssertionError(f"waited {seconds} s for {what}; the state is {self.state}")
            self.socket.settimeout(left)
            try:
                self.next()
            except TimeoutError:
                pass
        return self

    def quiet(self, seconds):
        """Reads whatever comes for so long."""
        end = time.monotonic() + seconds
        while (left := end - time.monotonic()) > 0:
            self.socket.settimeout(left)
            try:
                self.next()
            except TimeoutError:
                return

    def pixel(self, x, y):
        """Linear red, green, blue of the last frame at a place of 0 .. 1."""
        frame = self.frame
        column = min(int(x * frame["columns"]), frame["columns"] - 1)
        row = min(int(y * frame["rows"]), frame["rows"] - 1)
        at = 6 * (row * frame["columns"] + column)
        return struct.unpack("<3e", frame["bytes"][at:at + 6])

    def close(self):
        self.socket.close()
