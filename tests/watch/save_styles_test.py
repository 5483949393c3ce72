"""Every way in which editors save, against the real daemon: the last picture is right, no picture
shows a mixture, and the number of pictures begun is what the style calls for.

The wall's colour and its lamp's stand in two files that always agree; a picture in which they do
not is a mixture. `--slow` adds the long ones (F20, 10,000 edits).
"""

import os
import sys
import threading
import time
import unittest

from daemon import Daemon, Stream, wait_for

SLOW = "--slow" in sys.argv
if SLOW:
    sys.argv.remove("--slow")

# The colour of everything is `part * part` a channel: red of one file, green of another ...; equal
# channels mean that all five files are of one edit.
MAIN = """sdl 1;
include "b.sdl" as b;
include "c.sdl" as c;
include "d.sdl" as d;
include "e.sdl" as e;
let a = {level};
material wall: diffuse {{ emission = rgb(a, b.level, c.level); color = black; }}
quad w {{ corner = [-9, -9, 0]; edge_u = [18, 0, 0]; edge_v = [0, 18, 0]; material = wall; }}
assert d.level == d.level && e.level == e.level, "levels are numbers";
camera main: pinhole {{ eye = [0, 0, 5]; aim = [0, 0, 0]; fov = 40deg; }}
render {{ size = [64, 36]; samples = 2; }}
"""
PART = "sdl 1;\nlet level = {level};\n"
NAMES = ("scene.sdl", "b.sdl", "c.sdl", "d.sdl", "e.sdl")


def text_of(name, level):
    return (MAIN if name == "scene.sdl" else PART).format(level=level)


class Styles(unittest.TestCase):
    def setUp(self):
        self.daemon = Daemon("scene.sdl")
        for name in NAMES:
            self.daemon.write(name, text_of(name, 0.25))
        self.daemon.start()
        self.stream = Stream(self.daemon)
        self.until_level(0.25)

    def tearDown(self):
        self.stream.close()
        self.daemon.stop()
        self.daemon.__exit__()

    def until_level(self, level, seconds=30):
        def is_there(stream):
            return (stream.frame and stream.state and stream.state["status"] == "finished"
                    and all(abs(c - level) < 1e-3 for c in stream.pixel(0.5, 0.5)))
        self.stream.until(is_there, f"a picture of {level}", seconds)

    def expect(self, level, most_new, since):
        """The right picture comes, few others before it, none of them mixed."""
        self.until_level(level)
        self.stream.quiet(0.3)
        self.until_level(level)
        for frame in self.stream.frames[since:]:
            self.stream.frame = frame
            r, g, b = self.stream.pixel(0.5, 0.5)
            self.assertTrue(abs(r - g) < 1e-3 and abs(g - b) < 1e-3, f"a mixture: {(r, g, b)}")
        before = self.stream.frames[since - 1]["generation"]  # whose last frame may have come late
        new = len({frame["generation"] for frame in self.stream.frames[since:]} - {before})
        self.assertLessEqual(new, most_new)
        self.assertGreaterEqual(new, 1)

    def edited(self):
        self.stream.quiet(0.25)  # the last frame of what was before
        return len(self.stream.frames)

    def path(self, name):
        return self.daemon.path(name)

    def save_all(self, level, gap=0.0, save=None):
        for name in NAMES:
            (save or self.daemon.write)(name, text_of(name, level))
            if gap:
                time.sleep(gap)

    def rename_over(self, name, text):
        self.daemon.write("." + name + ".swp", text)
        os.rename(self.path("." + name + ".swp"), self.path(name))

    def like_vim(self, name, text):
        os.rename(self.path(name), self.path(name + "~"))
        self.daemon.write(name, text)
        os.remove(self.path(name + "~"))

    def test_save_all_in_place(self):
        since = self.edited()
        self.save_all(0.5)
        self.expect(0.5, 1, since)

    def test_save_all_by_renaming(self):
        since = self.edited()
        self.save_all(0.5, save=self.rename_over)
        self.expect(0.5, 1, since)

    def test_save_all_like_vim(self):
        since = self.edited()
        self.save_all(0.5, save=self.like_vim)
        self.expect(0.5, 1, since)

    def test_save_all_with_gaps_after_a_burst(self):
        self.save_all(0.5)
        self.until_level(0.5)
        since = self.edited()
        # After a burst over several files the quiet time is 100 ms.
        self.save_all(0.75, gap=0.02)
        self.expect(0.75, 1, since)

    def test_two_quick_saves_of_one_file(self):
        since = self.edited()
        self.save_all(0.375)
        self.save_all(0.5)
        self.expect(0.5, 2, since)

    def test_truncate_then_refill_through_one_descriptor(self):
        since = self.edited()
        descriptors = [os.open(self.path(name), os.O_WRONLY | os.O_TRUNC) for name in NAMES]
        time.sleep(0.5)
        for name, descriptor in zip(NAMES, descriptors):
            os.write(descriptor, text_of(name, 0.5).encode())
            os.close(descriptor)
        self.expect(0.5, 1, since)
        self.assertFalse([s for _, s in self.stream.states if s["status"] == "broken"])

    def test_link_turned_round(self):
        os.mkdir(self.path("other"))
        for name in NAMES:
            self.daemon.write(os.path.join("other", name), text_of(name, 0.5))
        since = self.edited()
        for name in NAMES:
            os.symlink(os.path.join("other", name), self.path("." + name))
            os.rename(self.path("." + name), self.path(name))
        self.expect(0.5, 1, since)
        since = self.edited()
        for name in NAMES:
            self.daemon.write(os.path.join("other", name), text_of(name, 0.75))
        self.expect(0.75, 1, since)

    def test_deleted_and_put_back(self):
        os.remove(self.path("c.sdl"))
        self.stream.until(lambda s: s.state["status"] == "broken", "the error")
        self.assertTrue(self.stream.state["stale"])
        self.assertIn("c.sdl", self.stream.state["findings"][0]["text"])
        self.daemon.write("c.sdl", text_of("c.sdl", 0.25))
        self.until_level(0.25)

    def test_only_a_comment(self):
        since = self.edited()
        self.daemon.write("b.sdl", "// nothing\n" + text_of("b.sdl", 0.25))
        self.stream.until(lambda s: s.state["change"] == "no visible change", "the state")
        self.assertEqual(len(self.stream.frames), since)

    def test_the_same_bytes(self):
        since = self.edited()
        states = len(self.stream.states)
        self.save_all(0.25)
        self.stream.quiet(0.4)
        self.assertEqual((len(self.stream.frames), len(self.stream.states)), (since, states))

    def test_an_include_that_was_missing(self):
        self.daemon.write("scene.sdl", text_of("scene.sdl", 0.25).replace("b.sdl", "sub/f.sdl"))
        self.stream.until(lambda s: s.state["status"] == "broken", "the error")
        os.mkdir(self.path("sub"))
        self.daemon.write("sub/f.sdl", text_of("b.sdl", 0.25))
        self.until_level(0.25)

    def test_syntax_error_in_an_include_keeps_watching(self):
        self.daemon.write("b.sdl", "sdl 1;\nlet level = ;\n")
        self.stream.until(lambda s: s.state["status"] == "broken", "the error")
        self.daemon.write("b.sdl", text_of("b.sdl", 0.25))
        self.until_level(0.25)

    def test_edits_without_end_still_give_pictures(self):
        """F20: an edit every 50 ms."""
        stop = threading.Event()
        count = [0]

        def edit():
            while not stop.wait(0.05):
                count[0] += 1
                self.daemon.write("d.sdl", text_of("d.sdl", 0.25) + f"let n = {count[0]};\n")
                self.daemon.write("scene.sdl", text_of("scene.sdl", 0.25)
                                  + f"// {count[0]}\nsphere {{ center = [0, 0, {-1 - count[0]}]; "
                                  "radius = 0.1m; material = wall; }\n")
        thread = threading.Thread(target=edit)
        thread.start()
        try:
            since = self.edited()
            self.stream.quiet(60 if SLOW else 4)
            self.assertGreaterEqual(len(self.stream.frames) - since, 30 if SLOW else 2)
        finally:
            stop.set()
            thread.join()

    def test_memory_stays_flat(self):
        """10,000 edits (400 in the short form): no growth of memory, threads or descriptors."""
        edits = 10_000 if SLOW else 400
        warm_up = 100
        for number in range(edits):
            level = 0.25 + 0.5 * ((number * 7919) % 1000) / 1000
            self.daemon.write("b.sdl", f"sdl 1;\n// {number}\nlet level = {level:.4f};\n"
                              if number % 10 else "sdl 1;\nlet level = ;\n")
            generation = self.stream.state.get("generation")

            def answered(stream):
                state = stream.state
                return (state["status"] == "broken" if number % 10 == 0
                        else state.get("generation") != generation or state["change"])
            self.stream.until(answered, f"edit {number}")
            if number == warm_up:
                before = (self.daemon.resident_kib(), self.daemon.thread_count(),
                          self.daemon.descriptor_count())
        after = (self.daemon.resident_kib(), self.daemon.thread_count(),
                 self.daemon.descriptor_count())
        print(f"after {warm_up} edits {before}, after {edits} {after}: KiB, threads, descriptors")
        self.assertLessEqual(after[0], 1.2 * before[0])
        self.assertEqual(after[1], before[1])
        self.assertLessEqual(after[2], before[2] + 1)  # a file may just be open

    def test_a_daemon_started_on_a_broken_scene(self):
        with Daemon("broken.sdl") as daemon:
            daemon.write("broken.sdl", "sdl 1;\nsphere { radius = ; }\n")
            daemon.start()
            stream = Stream(daemon)
            stream.until(lambda s: s.state and s.state["status"] == "broken", "the error")
            self.assertFalse(stream.state["stale"])
            daemon.write("broken.sdl", text_of("scene.sdl", 0.5).replace("include", "// include")
                         .replace("b.level", "a").replace("c.level", "a")
                         .replace("assert", "// assert"))
            stream.until(lambda s: s.frame and s.state["status"] == "finished", "the picture")
            stream.close()


if __name__ == "__main__":
    unittest.main(verbosity=2)
