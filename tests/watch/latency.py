"""How long an author waits: from the close of the file to the first picture on a page's socket, on a
scene of 100,000 triangles at 960x540. What the browser takes to paint it is not included.

    SCENEC=build/release/scenec python3 tests/watch/latency.py [--rounds N]

Prints its own table; the goals are those of docs/performance.md.
"""

import os
import statistics
import sys
import time

from daemon import Daemon, Stream

ROUNDS = int(sys.argv[sys.argv.index("--rounds") + 1]) if "--rounds" in sys.argv else 20
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


def row(name, times, goal):
    times = sorted(times)
    p95 = times[min(len(times) - 1, int(0.95 * len(times)))]
    median = statistics.median(times)
    verdict = "" if goal is None else "met" if median <= goal and p95 <= 2 * goal else "missed"
    print(f"| {name:<28} | {len(times):>4} | {median:>7.0f} | {p95:>7.0f} | {goal or '':>5} | {verdict:<6} |",
          flush=True)


def main():
    with Daemon("scene.sdl") as daemon:
        daemon.write("hills.obj", hills(0.1))
        daemon.write("scene.sdl", scene())
        print("| from close to first picture  | runs | median ms | 95 % | goal | |")
        print("|---|---|---|---|---|---|")
        cold = []
        for _ in range(3):
            start = time.monotonic()
            daemon.start()
            stream = Stream(daemon)
            stream.until(lambda s: s.frame, "the first picture", 120)
            cold.append(1000 * (stream.frame["at"] - start))
            stream.close()
            daemon.stop()
        row("cold start", cold, 1200)
        daemon.start()
        stream = Stream(daemon)
        stream.until(lambda s: s.frame and s.frame["step"] == 1, "a whole picture", 120)

        cancels = []

        def run(name, goal, edit):
            times = []
            for number in range(ROUNDS):
                stream.quiet(0.15)
                generation = stream.frame["generation"]
                path, text = edit(number)
                with open(daemon.path(path), "w", encoding="utf-8") as file:
                    file.write(text)
                closed = time.monotonic()
                stream.until(lambda s: s.frame["generation"] > generation, name, 120)
                times.append(1000 * (stream.frame["at"] - closed))
                stream.until(lambda s: s.state["generation"] > generation, name, 120)
                if stream.state.get("cancel_ms") is not None:
                    cancels.append(stream.state["cancel_ms"])
            row(name, times, goal)

        run("a material", 120, lambda n: ("scene.sdl", scene(red=0.2 + 0.01 * n)))
        run("a light", 120, lambda n: ("scene.sdl", scene(watts=100 + n)))
        run("the camera", 120, lambda n: ("scene.sdl", scene(z=6 + 0.05 * n)))
        run("a moved object", 250, lambda n: ("scene.sdl", scene(x=0.01 * (n + 1))))
        run("another mesh of 100k", 400, lambda n: ("hills.obj", hills(0.1 + 0.01 * (n + 1))))

        errors = []
        for number in range(ROUNDS):
            stream.quiet(0.15)
            with open(daemon.path("scene.sdl"), "w", encoding="utf-8") as file:
                file.write(scene().replace("radius", "x").replace("gray(0.6)", f"grey(0.{number + 1})"))
            closed = time.monotonic()
            stream.until(lambda s: s.state["status"] == "broken", "the error", 120)
            errors.append(1000 * (time.monotonic() - closed))
            with open(daemon.path("scene.sdl"), "w", encoding="utf-8") as file:
                file.write(scene(red=0.3 + 0.01 * number))
            stream.until(lambda s: s.state["status"] != "broken", "the scene", 120)
        row("an error on the page", errors, 60)
        if cancels:
            row("breaking off a render", cancels, 20)
        stream.close()


if __name__ == "__main__":
    main()
