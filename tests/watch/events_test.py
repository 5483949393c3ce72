"""What the daemon says of an edit: on a page's socket what was changed and what was kept, and with
`--json` one object a line on standard output, for editors. Every event and every key of it.
"""

import json
import queue
import threading
import unittest

from daemon import Daemon, Stream, ball

PATIENCE = 60


def after(condition, what, events):
    """The events up to the first one that the condition holds for."""
    seen = []
    while True:
        try:
            event = events.get(timeout=PATIENCE)
        except queue.Empty:
            raise AssertionError(f"waited for {what}; there was {seen}") from None
        seen.append(event)
        if condition(event):
            return seen


class Json(unittest.TestCase):
    KEYS = {
        "watching": {"event": str, "url": str},
        "made": {"event": str, "scene": str, "ms_after_change": float, "failed": bool,
                 "change": str, "findings": list},
        "picture": {"event": str, "scene": str, "ms_after_change": float, "generation": int,
                    "step": int, "samples": int, "changes": list},
    }
    KEYS["finished"] = KEYS["picture"]
    CHANGE = {"what": str, "family": str, "kind": str, "name": str, "count": int, "keys": list}

    def setUp(self):
        self.daemon = Daemon("scene.sdl", options=("--json",))
        self.daemon.write("scene.sdl", ball(samples=16))
        self.daemon.start()
        self.events = queue.Queue()

        def read(lines):
            for line in lines:
                self.events.put(json.loads(line))
        self.reader = threading.Thread(target=read, args=(self.daemon.process.stdout,), daemon=True)
        self.reader.start()

    def tearDown(self):
        self.daemon.process.terminate()  # the reader has its output
        self.reader.join()
        self.daemon.process.stdout.close()
        self.daemon.process.wait()
        self.daemon.log.close()
        self.daemon.process = None
        self.daemon.__exit__()

    def check(self, event):
        keys = dict(self.KEYS[event["event"]])
        optional = {"problem": str, "error": float}
        self.assertLessEqual(keys.keys(), event.keys())
        for key, value in event.items():
            self.assertIsInstance(value, keys.get(key) or optional[key], key)
        for change in event.get("changes", []):
            self.assertEqual({k: type(v) for k, v in change.items()}, self.CHANGE)

    def test_every_event_has_its_keys(self):
        seen = after(lambda e: e["event"] == "finished", "the picture", self.events)
        kinds = [e["event"] for e in seen]
        self.assertEqual(kinds[:2], ["watching", "made"])
        self.assertEqual(set(kinds), {"watching", "made", "picture", "finished"})
        self.assertEqual(seen[0]["url"], self.daemon.url)
        self.assertEqual(seen[-1]["samples"], 16)
        self.assertGreater(seen[-1]["error"], 0)
        generations = [e["generation"] for e in seen[2:]]
        self.assertEqual(set(generations), {1})

        self.daemon.write("scene.sdl", ball(samples=16).replace("radius = size", "radius = sise"))
        seen += after(lambda e: e["event"] == "made", "the mistake", self.events)
        self.assertTrue(seen[-1]["failed"])
        finding = seen[-1]["findings"][0]
        self.assertEqual(finding["severity"], "error")
        self.assertIn("sise", finding["message"])

        self.daemon.write("scene.sdl", ball(samples=16, fov=41))
        seen += after(lambda e: e["event"] == "finished", "the picture", self.events)
        self.assertEqual(seen[-1]["generation"], 2)
        self.assertEqual(seen[-1]["changes"], [
            {"what": "changed", "family": "camera", "kind": "pinhole", "name": "main", "count": 1,
             "keys": ["fov"]}])

        self.daemon.write("scene.sdl", ball(samples=16, fov=41) + "// a comment\n")
        seen += after(lambda e: e["event"] == "made", "the comment", self.events)
        self.assertEqual(seen[-1]["change"], "no visible change")
        for event in seen:
            self.check(event)


class Reuse(unittest.TestCase):
    """A grove of instances and a mesh: what each kind of edit builds anew."""

    SCENE = """sdl 1;
material leaf: diffuse {{ color = rgb(0.2, {green}, 0.1); }}
material flat: diffuse {{ color = gray(0.5); }}
proto tree {{
  sphere crown {{ center = [0, 1, 0]; radius = 0.4m; material = leaf; }}
  cylinder trunk {{ base = [0, 0, 0]; top = [0, 1, 0]; radius = 0.1m; material = leaf; }}
}}
for i in 0 .. 20 {{
  instance {{ of = tree; transform = [move([i - 10, 0, {depth} - i])]; }}
}}
mesh tile {{ file = "tile.obj"; unit = 1m; material = flat; }}
light key: point {{ position = [2, 4, 3]; power = {watts}W; }}
camera main: pinhole {{ eye = [0, 2, {eye}]; aim = [0, 1, 0]; fov = 40deg; }}
render {{ size = [64, 36]; samples = 2; }}
"""

    def text(self, green=0.5, depth=0, watts=300, eye=9):
        return self.SCENE.format(green=green, depth=depth, watts=watts, eye=eye)

    def edit(self, stream, daemon, name, text):
        old = stream.state["generation"]
        daemon.write(name, text)
        stream.until(lambda s: s.state["status"] == "finished" and s.state["generation"] > old,
                     "the picture", PATIENCE)
        made = {key: counts["made"] for key, counts in stream.state["reuse"].items()}
        changes = [(c["what"], c["kind"], c["name"], c["count"], c["keys"])
                   for c in stream.state["changes"]]
        return made, changes

    def test_each_edit_builds_what_it_must(self):
        with Daemon("scene.sdl") as daemon:
            daemon.write("tile.obj", "v -9 0 -9\nv 9 0 -9\nv 9 0 9\nv -9 0 9\nf 1 4 3 2\n")
            daemon.write("scene.sdl", self.text())
            daemon.start()
            stream = Stream(daemon)
            stream.until(lambda s: s.state and s.state["status"] == "finished", "the picture",
                         PATIENCE)
            self.assertEqual(stream.state["changes"], [])
            nothing = {"assets": 0, "mesh_trees": 0, "item_trees": 0}
            self.assertEqual(
                self.edit(stream, daemon, "scene.sdl", self.text(eye=8)),
                (nothing, [("changed", "pinhole", "main", 1, ["eye"])]))
            self.assertEqual(
                self.edit(stream, daemon, "scene.sdl", self.text(eye=8, watts=200)),
                (nothing, [("changed", "point", "key", 1, ["power"])]))
            self.assertEqual(
                self.edit(stream, daemon, "scene.sdl", self.text(eye=8, watts=200, green=0.7)),
                (nothing, [("changed", "diffuse", "leaf", 1, ["color"])]))
            # Moves: the tree over the world alone.
            self.assertEqual(
                self.edit(stream, daemon, "scene.sdl", self.text(eye=8, watts=200, green=0.7,
                                                                 depth=-1)),
                ({**nothing, "item_trees": 1}, [("changed", "instance", "", 21, ["transform"])]))
            made, changes = self.edit(
                stream, daemon, "tile.obj", "v -9 0 -9\nv 9 0 -9\nv 9 0.1 9\nv -9 0 9\nf 1 4 3 2\n")
            self.assertEqual(made, {"assets": 1, "mesh_trees": 1, "item_trees": 1})
            self.assertEqual(changes, [("changed", "mesh", "tile", 1, ["file"])])
            stream.close()


if __name__ == "__main__":
    unittest.main(verbosity=2)
