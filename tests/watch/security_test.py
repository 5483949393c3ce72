"""The preview server against pages and programs that are not ours (reliability: 403 everywhere)."""

import http.client
import os
import socket
import time
import unittest

from daemon import Daemon, Stream, ball

READ = ("/alive", "/picture.png", "/picture.exr")
WRITE = ("/wish", "/probe", "/source")
PAGES = ("/", "/scene/0", "/page.js", "/page.css", "/no/such/page")


class Security(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.daemon = Daemon("scene.sdl")
        cls.daemon.write("scene.sdl", ball())
        cls.daemon.start()
        stream = Stream(cls.daemon)
        stream.until(lambda s: s.frame, "a picture", 60)
        stream.close()

    @classmethod
    def tearDownClass(cls):
        cls.daemon.__exit__()

    def status(self, path, headers=None, body=None, **more):
        return self.daemon.ask(path, body, headers, **more)[0]

    def test_our_own_page_is_served(self):
        for path in PAGES[:4] + READ:
            self.assertEqual(self.status(path), 200, path)
        self.assertEqual(self.status("/wish", body={"scene": 0, "paused": False}), 200)

    def test_hostile_pages_get_nothing(self):
        for headers in ({"Origin": "http://evil.example"}, {"Origin": "null"},
                        {"Sec-Fetch-Site": "cross-site"}, {"Sec-Fetch-Site": "same-site"},
                        {"Host": "evil.example"}, {"Host": f"evil.example:{self.daemon.port}"},
                        {"Origin": f"http://127.0.0.1:{self.daemon.port + 1}"}):
            for path in PAGES + READ:
                self.assertEqual(self.status(path, headers), 403, (path, headers))
            for path in WRITE:
                self.assertEqual(self.status(path, headers, {"scene": 0}), 403, (path, headers))
            if "Sec-Fetch-Site" not in headers:
                stream = Stream(self.daemon, headers=headers)
                self.assertEqual(stream.status, 403, headers)
                stream.close()

    def test_without_the_token_there_are_no_pictures(self):
        for path in READ:
            self.assertEqual(self.status(path, token=False), 403, path)
        for path in WRITE:
            self.assertEqual(self.status(path, body={"scene": 0}, token=False), 403, path)
        stream = Stream(self.daemon, token="0" * 32)
        self.assertEqual(stream.status, 403)
        stream.close()

    def test_changes_need_a_post_of_json(self):
        self.assertEqual(self.status("/wish"), 405)
        self.assertEqual(self.status("/wish", {"Content-Type": "text/plain"}, {"scene": 0}), 415)
        self.assertEqual(self.status("/picture.png", body={}), 405)
        for body in ({}, {"scene": 7}, {"scene": 0}, {"scene": 0, "region": [0, 0, 0, 0]},
                     {"scene": 0, "camera": {"eye": [0, 0, "x"]}}, {"scene": 0, "paused": 3},
                     {"scene": -1, "paused": True}):
            self.assertEqual(self.status("/wish", body=body), 422, body)

    def test_paths_lead_nowhere(self):
        for path in ("/../scene.sdl", "/scene.sdl", "/%2e%2e/scene.sdl", "/scene/../scene.sdl",
                     "/etc/passwd"):
            connection = http.client.HTTPConnection("127.0.0.1", self.daemon.port, timeout=10)
            connection.request("GET", path, headers={"X-Scenec-Token": self.daemon.token})
            text = connection.getresponse().read()
            self.assertNotIn(b"sdl 1;", text, path)
            connection.close()

    def test_rules_for_browsers_stand_in_every_answer(self):
        connection = http.client.HTTPConnection("127.0.0.1", self.daemon.port, timeout=10)
        connection.request("GET", "/")
        answer = connection.getresponse()
        self.assertIn("default-src 'none'", answer.headers["Content-Security-Policy"])
        self.assertIn("frame-ancestors 'none'", answer.headers["Content-Security-Policy"])
        self.assertEqual(answer.headers["X-Content-Type-Options"], "nosniff")
        self.assertIsNone(answer.headers["Access-Control-Allow-Origin"])
        connection.close()

    def test_only_the_loopback_interface_listens(self):
        with open("/proc/net/tcp", encoding="ascii") as file:
            listening = [line.split()[1] for line in file.readlines()[1:] if line.split()[3] == "0A"]
        ours = [place for place in listening if int(place.split(":")[1], 16) == self.daemon.port]
        self.assertEqual(ours, [f"0100007F:{self.daemon.port:04X}"])

    def test_rubbish_and_silence_hurt_nobody(self):
        held = []
        for _ in range(40):
            one = socket.create_connection(("127.0.0.1", self.daemon.port))
            one.sendall(os.urandom(300))
            held.append(one)
            one = socket.create_connection(("127.0.0.1", self.daemon.port))
            one.sendall(b"GET / HTTP/1.1\r\nHost:")  # and never goes on
            held.append(one)
        self.assertEqual(self.status("/alive"), 200)
        for one in held:
            one.close()

    def test_a_hundred_pages_and_one_that_never_reads(self):
        lazy = Stream(self.daemon, shows=False)
        streams = [Stream(self.daemon) for _ in range(100)]
        start = time.monotonic()
        self.daemon.write("scene.sdl", ball(fov=41))
        for stream in streams:
            stream.until(lambda s: s.frame and s.frame["generation"] > 1, "the new picture", 60)
        print(f"a new picture on 100 pages after {time.monotonic() - start:.2f} s")
        for stream in streams:
            stream.close()
        lazy.close()

    def test_more_connections_than_the_limit(self):
        held = [socket.create_connection(("127.0.0.1", self.daemon.port)) for _ in range(300)]
        self.assertEqual(self.status("/alive"), 200)
        self.assertLess(self.daemon.descriptor_count(), 320)
        for one in held:
            one.close()


if __name__ == "__main__":
    unittest.main(verbosity=2)
