"""How long an author waits: from the close of the file until the picture, or the message, is painted
in a browser (headless Chromium), on a scene of 100,352 triangles at 960x540 that is being refined.

    SCENEC=build/release/scenec python3 tests/watch/latency.py [--rounds N] [--threads N] [--nice N]

Prints its own table; the goals are those of docs/performance.md. The page stamps the moment behind
the browser's frame in which it has drawn the first picture of a change; its clock is compared with
this one's before each row. `socket` is the time until the same picture was on a socket beside it. On a machine with other work, `--nice -10` (as root)
puts the daemon and every process of the browser before it; the browser alone sets its own otherwise.
"""

import os
import statistics
import sys
import threading
import time

from daemon import Daemon, Stream
from page_test import open_browser


def option(name, usual):
    return int(sys.argv[sys.argv.index(name) + 1]) if name in sys.argv else usual


ROUNDS = option("--rounds", 30)
THREADS = option("--threads", 0)
NICE = option("--nice", 0)
SIDE = 224  # squares a side: 100,352 triangles

SCENE = """sdl 1;
material skin: ggx {{ base = rgb({red}, 0.4, 0.3); f0 = 0.04; roughness = 0.3; }}
material felt: diffuse {{ color = gray(0.6); }}
mesh hills {{ file = "{file}"; unit = 1m; material = skin; transform = [move([{x}, 0, 0])]; }}
plane ground {{ normal = [0, 1, 0]; offset = -1m; material = felt; }}
light key: point {{ position = [2, 6, 3]; power = {watts}W; }}
light sky: environment {{ constant = gray(0.3); }}
camera main: pinhole {{ eye = [0, 3, {z}]; aim = [0, 0, 0]; fov = 45deg; }}
render {{ size = [960, 540]; samples = 4096; }}
"""


def scene(red=0.5, watts=300, z=7, x=0, file="hills.obj"):
    return SCENE.format(red=red, watts=watts, z=z, x=x, file=file)


def hills(height):
    lines = []
    for i in range(SIDE + 1):
        for j in range(SIDE + 1):
            u, v = i / SIDE * 6 - 3, j / SIDE * 6 - 3
            y = height * ((i * 37 + j * 91) % 17 / 17 + 1 / (1 + u * u + v * v))
            lines.append(f"v {u:.5f} {y:.5f} {v:.5f}")
    for i in range(SIDE):
        for j in range(SIDE):
            a = i * (SIDE + 1) + j + 1
            b = a + SIDE + 1
            lines.append(f"f {a} {a + 1} {b + 1}\nf {a} {b + 1} {b}")
    return "\n".join(lines) + "\n"


def percentile(times, part):
    times = sorted(times)
    return times[min(len(times) - 1, int(part * len(times)))]


def raise_priority(*roots):
    """Of these processes, all they have started, and all their threads."""
    if NICE == 0:
        return
    children = {}
    for pid in filter(str.isdigit, os.listdir("/proc")):
        try:
            with open(f"/proc/{pid}/stat", encoding="utf-8", errors="replace") as file:
                parent = int(file.read().rpartition(")")[2].split()[1])
            children.setdefault(parent, []).append(int(pid))
        except OSError:
            continue
    family = list(roots)
    for pid in family:
        family += children.get(pid, [])
        try:
            for thread in os.listdir(f"/proc/{pid}/task"):
                os.setpriority(os.PRIO_PROCESS, int(thread), NICE)
        except OSError:
            continue


class Socket:
    """A page without a browser, on a thread: when each picture and message came."""

    def __init__(self, daemon):
        self.stream = Stream(daemon)
        self.pictures = {}
        self.cancels = []
        self.over = False
        self.thread = threading.Thread(target=self.read, daemon=True)
        self.thread.start()

    def read(self):
        while not self.over:
            try:
                if self.stream.next() == "frame":
                    self.pictures.setdefault(self.stream.frame["generation"], time.time())
                elif self.stream.state.get("cancel_ms") is not None:
                    if [self.stream.state["cancel_ms"]] != self.cancels[-1:]:
                        self.cancels.append(self.stream.state["cancel_ms"])
            except OSError:
                return

    def close(self):
        self.over = True
        self.stream.close()


class Meter:
    def __init__(self, daemon, browser):
        self.daemon, self.browser = daemon, browser

    def until(self, what, old):
        """The stamp behind `old`: its number or text, and the time in seconds."""
        number, at = self.browser.execute_async_script("""
            const [what, old, done] = arguments;
            const look = () => {
              const [number, at] = (document.body?.dataset[what] ?? '').split(' ');
              if (!at || number === old) return;
              observer.disconnect();
              done([number, Number(at)]);
            };
            const observer = new MutationObserver(look);
            observer.observe(document.body, { attributes: true });
            look();""", what, old)
        return number, at / 1000 - self.offset

    def synchronise(self):
        raise_priority(os.getpid())
        before = time.time()
        there = self.browser.execute_script("return performance.timeOrigin + performance.now()") / 1000
        after = time.time()
        # Nothing to correct while the page's time lies between the two of here.
        self.offset = 0 if before <= there <= after else there - (before + after) / 2

    def write(self, name, text):
        with open(self.daemon.path(name), "w", encoding="utf-8") as file:
            file.write(text)
        return time.time()


def row(name, times, goal, socket=()):
    median, p95 = statistics.median(times), percentile(times, 0.95)
    verdict = "met" if median <= goal and p95 <= 2 * goal else "missed"
    on_socket = f"{statistics.median(socket):.0f}" if socket else ""
    print(f"| {name:<28} | {len(times):>4} | {median:>6.0f} | {p95:>6.0f} | {goal:>5} | {verdict:<6} "
          f"| {on_socket:>6} |", flush=True)


def cold_starts(daemon, browser, meter):
    times = []
    for _ in range(max(3, ROUNDS // 3)):
        browser.get("about:blank")
        raise_priority(os.getpid())
        start = time.time()
        daemon.start()
        browser.get(daemon.url)
        meter.synchronise()
        times.append(1000 * (meter.until("painted", "")[1] - start))
        daemon.stop()
    row("cold start", times, 1200)


def edits(meter, socket, name, goal, edit):
    painted, sent = [], []
    meter.synchronise()
    for number in range(ROUNDS):
        time.sleep(0.3 + 0.037 * (number % 7))
        old = meter.browser.execute_script("return document.body.dataset.painted").split()[0]
        closed = meter.write(*edit(number))
        generation, at = meter.until("painted", old)
        painted.append(1000 * (at - closed))
        if int(generation) in socket.pictures:
            sent.append(1000 * (socket.pictures[int(generation)] - closed))
    row(name, painted, goal, sent)


def mistakes(meter):
    times = []
    meter.synchronise()
    for number in range(ROUNDS):
        time.sleep(0.3 + 0.037 * (number % 7))
        closed = meter.write("scene.sdl", scene().replace("gray(0.6)", f"grey{number}(0.5)"))
        old = "" if number == 0 else told
        told, at = meter.until("told", old)
        times.append(1000 * (at - closed))
        old = meter.browser.execute_script("return document.body.dataset.painted").split()[0]
        meter.write("scene.sdl", scene(red=0.3 + 0.01 * number))
        meter.until("painted", old)
    row("a mistake, until it is told", times, 60)


def main():
    options = ("--threads", str(THREADS)) if THREADS else ()
    browser = open_browser(1280, 860)
    browser.set_script_timeout(120)
    with Daemon("scene.sdl", options=options) as daemon:
        daemon.write("hills.obj", hills(0.1))
        daemon.write("scene.sdl", scene())
        print(f"load {os.getloadavg()[0]:.1f}, {os.cpu_count()} processors")
        print("| until it is painted          | runs | median | 95 %   | goal  |        | socket |")
        print("|---|---|---|---|---|---|---|")
        meter = Meter(daemon, browser)
        cold_starts(daemon, browser, meter)
        browser.get("about:blank")
        daemon.start()
        browser.get(daemon.url)
        meter.synchronise()
        meter.until("painted", "")
        socket = Socket(daemon)
        time.sleep(1)
        edits(meter, socket, "a material", 120, lambda n: ("scene.sdl", scene(red=0.2 + 0.01 * n)))
        edits(meter, socket, "a light", 120, lambda n: ("scene.sdl", scene(watts=100 + n)))
        edits(meter, socket, "the camera", 120, lambda n: ("scene.sdl", scene(z=6 + 0.05 * n)))
        edits(meter, socket, "a moved object", 250, lambda n: ("scene.sdl", scene(x=0.01 * (n + 1))))
        edits(meter, socket, "another mesh of 100k", 400,
              lambda n: ("hills.obj", hills(0.1 + 0.01 * (n + 1))))
        mistakes(meter)
        row("breaking off a render", socket.cancels, 20)
        print(f"load {os.getloadavg()[0]:.1f}")
        socket.close()
    browser.quit()


if __name__ == "__main__":
    main()
