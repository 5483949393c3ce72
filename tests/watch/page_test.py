"""The preview page in a real browser (headless Chromium), against the real daemon.

Skipped, visibly, where Chromium or its driver is not installed.
"""

import http.server
import json
import os
import shutil
import sys
import threading
import unittest

from daemon import Daemon, ball, wait_for

try:
    from selenium import webdriver
    from selenium.webdriver.chrome.options import Options
    from selenium.webdriver.chrome.service import Service
    from selenium.webdriver.common.action_chains import ActionChains
    from selenium.webdriver.common.by import By
except ImportError:
    webdriver = None

DRIVER = shutil.which("chromedriver")
BROWSER = shutil.which("chromium")
SHOTS = os.environ.get("SCENEC_SHOTS")  # a folder: pictures of the page are left there
PATIENCE = 90  # seconds: the machine may have other work


def open_browser(width=1280, height=860):
    options = Options()
    options.binary_location = BROWSER
    for word in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
                 "--disable-background-networking", "--no-first-run", "--hide-scrollbars",
                 f"--window-size={width},{height}"):
        options.add_argument(word)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    return webdriver.Chrome(service=Service(DRIVER), options=options)


@unittest.skipUnless(webdriver and DRIVER and BROWSER,
                     "chromium, chromium-driver or python3-selenium is not installed")
class Page(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.browser = open_browser()
        cls.browser.set_page_load_timeout(PATIENCE)

    @classmethod
    def tearDownClass(cls):
        cls.browser.quit()

    def setUp(self):
        self.daemon = Daemon("scene.sdl")
        self.daemon.write("scene.sdl", ball(samples=8))
        self.daemon.start()
        self.open(self.daemon.url)
        self.until_frame()

    def tearDown(self):
        problems = [entry for entry in self.browser.get_log("browser")
                    if entry["level"] == "SEVERE" and "WebSocket" not in entry["message"]
                    and "favicon" not in entry["message"]]
        self.browser.get("about:blank")
        self.daemon.__exit__()
        if not getattr(self, "expects_problems", False):
            self.assertEqual(problems, [])

    def open(self, url):
        self.browser.get("about:blank")
        self.browser.get(url)

    # ---- what the page shows

    def find(self, css):
        return self.browser.find_element(By.CSS_SELECTOR, css)

    def data(self, name):
        return self.browser.execute_script("return document.body.dataset[arguments[0]]", name)

    def text(self, css):
        return self.browser.execute_script(
            "return document.querySelector(arguments[0]).textContent", css)

    def is_shown(self, css):
        return self.find(css).is_displayed()

    def wait(self, condition, what):
        return wait_for(condition, what, PATIENCE)

    def generation(self):
        return int(self.data("generation") or 0)

    def until_frame(self, generation=1):
        self.wait(lambda: self.generation() >= generation, f"picture {generation}")

    def until_finished(self):
        self.wait(lambda: self.find("#status").get_attribute("class") == "finished", "the end")

    def pixel(self, x=0.5, y=0.5):
        return self.browser.execute_script(
            "const c = document.getElementById('picture');"
            "return Array.from(c.getContext('2d').getImageData("
            "Math.floor(arguments[0] * c.width), Math.floor(arguments[1] * c.height), 1, 1).data)",
            x, y)[:3]

    def shot(self, name):
        if SHOTS:
            self.browser.save_screenshot(os.path.join(SHOTS, name + ".png"))

    # ---- what an author does

    def test_the_picture_appears_and_refines(self):
        # Begun while the page looks on: the first look and what follows it are shown.
        self.daemon.write("scene.sdl", ball(fov=41, width=480, height=270, samples=8))
        self.until_frame(2)
        self.until_finished()
        self.assertEqual(self.data("step"), "1")
        self.assertGreaterEqual(int(self.data("frames")), 2)
        red, green, _ = self.pixel()
        self.assertGreater(red, green)
        self.assertIn("8 samples", self.text("#status"))
        self.assertIn("compile", self.text("#phases"))
        self.assertGreater(len(self.browser.find_elements(By.CSS_SELECTOR, "#effects li")), 10)

    def test_the_error_is_drawn_with_its_band(self):
        self.daemon.write("scene.sdl", ball(fov=41, samples=64))
        self.until_frame(2)
        self.until_finished()
        line, band = self.wait(lambda: self.browser.execute_script(
            "const of = (what) => document.querySelector('#curve .' + what)?.getAttribute('points')"
            ".split(' ').map((pair) => pair.split(',').map(Number));"
            "return of('line') && [of('line'), of('band')]"), "the curve")
        self.assertEqual(len(band), 2 * len(line))  # its upper edge, and back along the lower one
        for i, (x, y) in enumerate(line):
            upper, lower = band[i], band[-1 - i]
            self.assertEqual((upper[0], lower[0]), (x, x))
            self.assertLessEqual(upper[1], y)
            self.assertGreaterEqual(lower[1], y)
        self.assertIn("error", self.text("#status"))

    def test_an_edit_gives_a_new_picture(self):
        self.daemon.write("scene.sdl", ball(color="rgb(0.1, 0.8, 0.1)", samples=8))
        self.until_frame(2)
        red, green, _ = self.pixel()
        self.assertGreater(green, red)
        self.wait(lambda: "material (diffuse) skin: color" in self.text("#changes"), "the change")
        self.assertIn("trees over items: 1 kept, 0 made", self.text("#reuse"))

    def test_a_mistake_lies_over_the_last_good_picture_until_it_is_mended(self):
        before = self.pixel()
        self.daemon.write("scene.sdl", ball().replace("radius = size", "radius = sise"))
        self.wait(lambda: self.is_shown("#overlay"), "the overlay")
        self.assertIn("did you mean", self.text("#overlay"))
        self.assertIn("scene.sdl:", self.text("#overlay"))
        self.assertTrue(self.is_shown("#stale"))
        self.assertEqual(len(self.pixel()), len(before))
        self.assertGreater(sum(self.pixel()), 0)
        self.shot("error")
        self.daemon.write("scene.sdl", ball(samples=8))
        self.wait(lambda: not self.is_shown("#overlay"), "the overlay to go")
        self.assertFalse(self.is_shown("#stale"))

    def test_a_slider_changes_the_picture_and_the_value_is_written_back(self):
        self.until_finished()
        bright = sum(self.pixel())
        self.browser.execute_script(
            "const s = document.querySelector('[data-param=watts] input[type=range]');"
            "s.value = 5; s.dispatchEvent(new Event('input', {bubbles: true}))")
        self.until_frame(2)
        self.until_finished()
        self.assertLess(sum(self.pixel()), bright)
        self.wait(lambda: self.is_shown("[data-param=watts] .row button"), "the buttons")
        self.find("[data-param=watts] .row button").click()
        self.wait(lambda: self.is_shown("#diff"), "the difference")
        self.assertIn("-param watts: power = 60W", self.text("#diff-text"))
        self.assertIn("+param watts: power = 5W", self.text("#diff-text"))
        self.shot("write-back")
        self.find("#apply").click()

        def source():
            with open(self.daemon.path("scene.sdl"), encoding="utf-8") as file:
                return file.read()
        self.wait(lambda: "= 5W in" in source(), "the file")
        self.assertEqual(source(), ball(samples=8).replace("= 60W", "= 5W"))

    def test_a_file_that_has_changed_meanwhile_is_left_alone(self):
        self.browser.execute_script(
            "const s = document.querySelector('[data-param=watts] input[type=range]');"
            "s.value = 5; s.dispatchEvent(new Event('input', {bubbles: true}))")
        self.until_frame(2)
        self.wait(lambda: self.is_shown("[data-param=watts] .row button"), "the buttons")
        self.find("[data-param=watts] .row button").click()
        self.wait(lambda: self.is_shown("#diff"), "the difference")
        self.expects_problems = True
        other = ball(samples=8) + "// mine\n"
        self.daemon.write("scene.sdl", other)
        self.find("#apply").click()
        self.wait(lambda: "changed meanwhile" in self.text("#probe-out")
                  or "only a value" in self.text("#probe-out"), "the refusal")
        with open(self.daemon.path("scene.sdl"), encoding="utf-8") as file:
            self.assertEqual(file.read(), other)

    def test_a_check_box_a_colour_and_undo(self):
        self.until_finished()
        before = sum(self.pixel(0.5, 0.95))
        self.find("[data-param=lit] input").click()
        self.wait(lambda: self.generation() >= 2, "the dark picture")
        self.until_finished()
        self.assertLess(sum(self.pixel(0.5, 0.95)), before)
        self.find("#undo").click()
        self.wait(lambda: self.generation() >= 3, "the light picture")
        self.browser.execute_script(
            "const s = document.querySelector('[data-param=tint] input');"
            "s.value = '#0000ff'; s.dispatchEvent(new Event('input', {bubbles: true}))")
        self.wait(lambda: self.generation() >= 4, "the blue picture")
        self.until_finished()
        red, _, blue = self.pixel(0.5, 0.95)
        self.assertGreater(blue, red)

    def test_orbit_moves_the_camera_and_gives_its_block(self):
        self.until_finished()
        canvas = self.find("#picture")
        ActionChains(self.browser, 50).move_to_element(canvas).click_and_hold().move_by_offset(
            120, 30).release().perform()
        self.wait(lambda: self.generation() >= 2, "the picture from elsewhere")
        self.wait(lambda: self.find("#camera-reset").is_enabled(), "the button")
        self.until_finished()
        self.find("#camera-copy").click()
        block = self.wait(lambda: self.data("copied"), "the block")
        self.assertIn("camera main: pinhole {", block)
        self.assertNotIn("eye = [0, 2, 6]", block)
        # What was copied compiles, and shows the same.
        import re
        text = re.sub(r"camera main: pinhole \{.*\}\n", lambda _: block, ball(samples=8))
        self.daemon.write("scene.sdl", text)
        self.find("#camera-reset").click()
        self.wait(lambda: not self.find("#camera-reset").is_enabled(), "the scene's own camera")
        self.assertFalse(self.is_shown("#overlay"))

    def test_a_region_is_dragged(self):
        self.until_finished()
        self.find("input[value=region]").click()
        canvas = self.find("#picture")
        ActionChains(self.browser, 50).move_to_element(canvas).click_and_hold().move_by_offset(
            150, 80).release().perform()
        self.wait(lambda: self.generation() >= 2, "the part")
        self.wait(lambda: self.find("#region-reset").is_enabled(), "the button")
        self.find("#region-reset").click()
        self.wait(lambda: self.generation() >= 3, "the whole")

    def test_a_probe_leads_to_the_line(self):
        self.until_finished()
        self.find("input[value=probe]").click()
        ActionChains(self.browser, 50).move_to_element(self.find("#picture")).click().perform()
        probed = json.loads(self.wait(lambda: self.data("probed"), "the answer"))
        self.assertEqual(probed["name"], "ball")
        self.assertEqual(probed["material"], "skin")
        self.assertIn("scene.sdl:9:", probed["places"][0]["place"])
        self.assertEqual(probed["samples"], 8)
        self.assertIn("sphere ball", self.text("#probe-out"))

    def test_a_picture_is_pinned_and_wiped_against(self):
        self.until_finished()
        self.find("#pin").click()
        self.daemon.write("scene.sdl", ball(color="rgb(0.1, 0.8, 0.1)", samples=8))
        self.until_frame(2)
        self.assertTrue(self.is_shown("#pinned"))
        self.browser.execute_script(
            "const s = document.getElementById('wipe');"
            "s.value = 30; s.dispatchEvent(new Event('input'))")
        self.assertIn("70%", self.find("#pinned").get_attribute("style"))
        self.until_finished()
        self.shot("wipe")
        self.find("#pin").click()
        self.assertFalse(self.is_shown("#pinned"))

    def test_exposure_and_files(self):
        self.until_finished()
        before = sum(self.pixel(0.5, 0.95))
        self.browser.execute_script(
            "const s = document.getElementById('exposure');"
            "s.value = 2; s.dispatchEvent(new Event('input'))")
        self.assertGreater(sum(self.pixel(0.5, 0.95)), before)
        self.assertEqual(self.generation(), 1)
        for kind, magic in (("png", b"\x89PNG"), ("exr", b"\x76\x2f\x31\x01")):
            self.find(f"#save-{kind}").click()
            self.wait(lambda: self.data("saved") == kind, kind)
            self.assertEqual(self.daemon.ask(f"/picture.{kind}")[1][:4], magic)

    def test_the_page_finds_the_daemon_again(self):
        self.expects_problems = True
        port, token_folder = self.daemon.port, self.daemon.folder
        self.daemon.options = ("--port", str(port))
        self.daemon.environment = {"XDG_RUNTIME_DIR": token_folder}
        self.daemon.stop()
        self.daemon.start()  # from here on with a token that is kept
        self.open(self.daemon.url)
        self.until_frame()
        self.daemon.stop()
        self.wait(lambda: self.is_shown("#offline"), "the notice")
        self.daemon.write("scene.sdl", ball(color="rgb(0.1, 0.1, 0.9)", samples=8))
        frames = int(self.data("frames"))
        self.daemon.start()
        self.wait(lambda: int(self.data("frames")) > frames, "pictures again")
        self.wait(lambda: not self.is_shown("#offline"), "the notice to go")
        self.until_finished()
        red, _, blue = self.pixel()
        self.assertGreater(blue, red)

    def test_the_address_of_another_daemon_is_taken_in_the_same_tab(self):
        self.expects_problems = True
        self.daemon.options = ("--port", str(self.daemon.port))
        self.daemon.environment = {"XDG_RUNTIME_DIR": ""}
        self.daemon.stop()
        self.daemon.start()  # with another key
        self.browser.get(self.daemon.url)
        self.wait(lambda: "finished" in self.text("#status"), "the picture")
        self.assertFalse(self.is_shown("#gate"))

    def test_a_hostile_page_gets_nothing(self):
        self.expects_problems = True
        target = f"http://127.0.0.1:{self.daemon.port}"
        page = f"""<!doctype html><title>running</title><iframe src="{target}/"></iframe>
<img src="{target}/picture.png"><script type="module">
const seen = [];
for (const path of ['/', '/page.js', '/picture.png', '/alive', '/wish', '/stream?scene=0']) {{
  for (const options of [{{}}, {{mode: 'no-cors'}}, {{method: 'POST', body: '{{"scene":0}}'}}]) {{
    await fetch('{target}' + path, options).then((a) => a.type !== 'opaque' && seen.push(path), () => 0);
  }}
}}
await new Promise((done) => {{
  const socket = new WebSocket('ws://127.0.0.1:{self.daemon.port}/stream?scene=0', ['scenec']);
  socket.onopen = () => {{ seen.push('stream'); done(); }};
  socket.onerror = done;
}});
document.title = 'seen ' + JSON.stringify(seen);
</script>"""

        class Hostile(http.server.BaseHTTPRequestHandler):
            def do_GET(self):
                self.send_response(200)
                self.send_header("Content-Type", "text/html")
                self.end_headers()
                self.wfile.write(page.encode())

            def log_message(self, *_):
                pass
        server = http.server.HTTPServer(("127.0.0.1", 0), Hostile)
        threading.Thread(target=server.serve_forever, daemon=True).start()
        try:
            self.browser.get(f"http://127.0.0.1:{server.server_port}/")
            self.wait(lambda: self.browser.title.startswith("seen"), "the hostile page")
            self.assertEqual(self.browser.title, "seen []")
        finally:
            server.shutdown()
            server.server_close()

    def test_it_fits_a_phone_and_works_from_the_keyboard(self):
        self.until_finished()
        for scheme in ("dark", "light"):
            self.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {
                "features": [{"name": "prefers-color-scheme", "value": scheme}]})
            self.browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {
                "width": 390, "height": 844, "deviceScaleFactor": 1, "mobile": True})
            try:
                wide, canvas = self.browser.execute_script(
                    "return [document.documentElement.scrollWidth - window.innerWidth,"
                    " document.getElementById('picture').getBoundingClientRect().width]")
                self.assertLessEqual(wide, 0)
                self.assertGreater(canvas, 340)  # the picture has nearly all of the width
                self.shot("phone-" + scheme)
            finally:
                self.browser.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})
        self.find("#picture").send_keys("p")
        self.assertTrue(self.find("input[value=probe]").is_selected())
        # Everything that can be used is reached by the tabulator, and nothing else holds it up.
        reached = []
        self.browser.execute_script("document.getElementById('home').focus()")
        for _ in range(80):
            ActionChains(self.browser, 5).send_keys("\ue004").perform()
            reached.append(self.browser.execute_script(
                "return document.activeElement.id || document.activeElement.tagName"))
            if reached[-1] == "BODY":
                break
        for wanted in ("picture", "pin", "exposure", "pause", "save-png", "save-exr"):
            self.assertIn(wanted, reached)
        self.find("#picture").send_keys("a")
        self.assertTrue(self.is_shown("#pinned"))
        self.find("#picture").send_keys("a")
        self.find("#picture").send_keys(" ")
        self.wait(lambda: self.find("#pause").get_attribute("aria-pressed") == "true", "the pause")
        self.find("#picture").send_keys(" ")
        self.wait(lambda: self.find("#pause").get_attribute("aria-pressed") == "false", "the end of it")
        self.find("#picture").send_keys("\ue012")  # arrow to the left
        self.wait(lambda: self.generation() >= 2, "the picture from elsewhere")
        unnamed = self.browser.execute_script(
            "return [...document.querySelectorAll('button, input')].filter((e) =>"
            " !e.textContent.trim() && !e.labels?.length && !e.getAttribute('aria-label')"
            " && !e.title).map((e) => e.id || e.outerHTML)")
        self.assertEqual(unnamed, [])

    def test_several_scenes_give_an_index(self):
        with Daemon("a.sdl", "b.sdl") as two:
            two.write("a.sdl", ball(samples=2))
            two.write("b.sdl", "sdl 1;\nsphere {\n")
            two.start()
            self.open(two.url)
            self.wait(lambda: len(self.browser.find_elements(By.CSS_SELECTOR, "#scenes a")) == 2,
                      "the list")
            self.wait(lambda: "broken" in self.text("#scenes"), "the broken one")
            self.wait(lambda: self.browser.execute_script(
                "return document.querySelector('#scenes img').naturalWidth > 1"), "its picture")
            self.shot("index")
            self.find("#scenes a").click()
            self.until_frame()
            self.assertIn("a.sdl", self.text("#name"))

    def test_a_folder_shows_what_comes_into_it_and_goes(self):
        with Daemon(".") as one:
            one.start()
            self.open(one.url)
            self.wait(lambda: self.is_shown("#empty"), "the word that there is nothing yet")

            def names():
                return self.browser.execute_script(
                    "return [...document.querySelectorAll('#scenes a')]"
                    ".map((a) => a.textContent.split(' ')[0])")
            one.write("b.sdl", ball(samples=2))
            self.wait(lambda: names() == ["./b.sdl"], "the first scene")
            self.assertFalse(self.is_shown("#empty"))
            one.write("a.sdl", ball(samples=2))
            self.wait(lambda: names() == ["./b.sdl", "./a.sdl"], "the second scene")
            self.wait(lambda: self.text("#scenes").count("finished") == 2, "both pictures")
            os.rename(one.path("b.sdl"), one.path("c.sdl"))
            self.wait(lambda: names() == ["./a.sdl", "./c.sdl"], "the other name")
            self.find("#scenes li:last-child a").click()
            self.until_frame()
            self.assertIn("c.sdl", self.text("#name"))
            # Whoever looks at a scene that is deleted keeps its picture.
            os.remove(one.path("c.sdl"))
            self.wait(lambda: self.is_shown("#stale"), "the mark")
            self.wait(lambda: len(self.browser.find_elements(By.CSS_SELECTOR, "#sibling option"))
                      == 1, "the other scene alone")
            one.write("c.sdl", ball(samples=2))
            self.wait(lambda: not self.is_shown("#stale"), "the scene that is back")


if __name__ == "__main__":
    unittest.main(verbosity=2, argv=sys.argv)
