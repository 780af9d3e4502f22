#!/usr/bin/python3
"""`./launch/fsi monitor --web` serves the state of a run; `test_web.py Page` looks at its page in a headless Chromium."""

import contextlib
import http.client
import json
import os
import pathlib
import re
import socket
import struct
import subprocess
import sys
import unittest
import urllib.error
import urllib.parse
import urllib.request

import browser
from running import BIN, EndToEnd, FSI, LONG, WATCHDOG, until

NOT_INSTALLED = 77  # exit code that CTest shows as skipped


def resident_mib(pid):
    """Memory of a process now."""
    status = pathlib.Path(f"/proc/{pid}/status").read_text()
    return int(re.search(r"VmRSS:\s+(\d+) kB", status)[1]) / 1024


class WebTest(EndToEnd):
    """A run and a monitor that serves it."""

    def serve(self, run, *words):
        """The monitor; its page's address is in `self.url`, without the token that allows requests."""
        monitor = subprocess.Popen([FSI, "monitor", *words, "--web", "0"], stdin=subprocess.DEVNULL, text=True,
                                   stdout=subprocess.PIPE,
                                   env=os.environ | {"FSI_BIN": str(BIN), "XDG_RUNTIME_DIR": str(run.runtime)})
        self.addCleanup(monitor.stdout.close)
        self.addCleanup(monitor.wait)
        self.addCleanup(monitor.kill)
        self.url, _, fragment = monitor.stdout.readline().strip().partition("#")
        self.token = fragment.removeprefix("token=")
        return monitor

    def begin(self, *words):
        run = self.launch(*(words or LONG))
        run.until_stepping()
        return run, self.serve(run, str(run.directory))

    def get(self, path, **headers):
        with urllib.request.urlopen(urllib.request.Request(self.url + path, headers=headers), timeout=WATCHDOG) as answer:
            return answer.read().decode()

    def state(self):
        return json.loads(self.get("api/state.json"))

    def running(self):
        """Waits until the monitor has heard all three programs of the run at work."""
        self.assertTrue(until(lambda: len(self.state()["participants"]) == 3 and self.state()["status"] == "running"))

    def assert_ends_after(self, paused, run):
        """A run that is stopped while it pauses takes the step it was about to take, and the one after which its checkpoint is whole."""
        self.assertIn(run.summary()["steps"] - paused, (1, 2))

    def ask(self, command, token):
        request = urllib.request.Request(f"{self.url}api/control?command={command}", method="POST",
                                         headers={"X-AMP-FSI-Token": token})
        try:
            with urllib.request.urlopen(request, timeout=WATCHDOG) as answer:
                return answer.status
        except urllib.error.HTTPError as error:
            with error:
                return error.code


class Server(WebTest):
    def test_state_numbers_and_page_are_served_to_this_machine_only(self):
        run, _ = self.begin()
        self.assertTrue(self.url.startswith("http://127.0.0.1:"))
        self.running()
        self.assertTrue(until(lambda: "solid" in self.state()["interfaces"]))
        self.assertTrue(until(lambda: len(json.loads(self.get("api/history.json"))["history"]["solid.gap"]) > 3))
        self.assertIn(f'amp_fsi_up{{run="{self.state()["run"]}"}} 1', self.get("metrics"))
        for path in ("", "page.css", "page.js", "plots.js", "cursor.js", "tables.js", "raster.js", "picture.js"):
            content = self.get(path)
            self.assertGreater(len(content), 1000)
            self.assertNotIn("https://", content)  # nothing is loaded from elsewhere
        for host in ("elsewhere.example", "127.elsewhere.example"):
            with self.assertRaises(urllib.error.HTTPError) as refused:
                self.get("api/state.json", Host=host)
            self.assertEqual(refused.exception.code, 403)
            refused.exception.close()
        self.assertIsNone(run.process.poll())

    def test_silent_connections_and_large_requests_keep_nobody_waiting(self):
        _, monitor = self.begin()
        self.running()
        place = urllib.parse.urlsplit(self.url)
        for _ in range(200):
            silent = socket.create_connection((place.hostname, place.port))
            self.addCleanup(silent.close)
            silent.sendall(b"GET /api/sta")
        self.assertEqual(self.state()["status"], "running")
        before = resident_mib(monitor.pid)
        for head in ("Content-Length: 200000000", "Transfer-Encoding: chunked"):
            with socket.create_connection((place.hostname, place.port)) as large:
                large.sendall(f"POST /api/control?command=stop HTTP/1.1\r\nHost: {place.netloc}\r\n{head}\r\n\r\n".encode())
                chunk = b"100000\r\n" + bytes(0x100000) + b"\r\n"
                with contextlib.suppress(ConnectionError):  # it need not listen to the end
                    for _ in range(100):
                        large.sendall(chunk)
                with contextlib.suppress(ConnectionError):
                    self.assertIn(b" 413 ", large.recv(100))
        self.assertLess(resident_mib(monitor.pid) - before, 30)
        self.assertEqual(self.state()["status"], "running")

    def pictures(self, wish, after=0):
        """{participant: (header, places, levels) of its last grid}, and how new they are."""
        with urllib.request.urlopen(f"{self.url}api/pictures?after={after}&wish={wish}", timeout=WATCHDOG) as answer:
            version, data = int(answer.headers["X-AMP-FSI-Version"]), answer.read()
        place, found = 0, {}
        while place < len(data):
            length = struct.unpack_from("<I", data, place)[0]
            header = json.loads(data[place + 4:place + 4 + length])
            place += 4 + length
            for grid in header["grids"]:
                n1, n2 = grid["n1"], grid["n2"]
                positions = n1 + n2 if grid["straight"] else 2 * n1 * n2
                places = struct.unpack_from(f"<{positions}f", data, place)
                levels = struct.unpack_from(f"<{n1 * n2}H", data, place + 4 * positions)
                place += 4 * positions + 4 * ((n1 * n2 + 1) // 2)
                found[header["from"]] = (header, places, levels)
        return found, version

    def test_pictures_show_one_step_of_all_programs_and_change_no_bit_of_the_run(self):
        run, _ = self.begin()
        seen, version = {}, 0

        def of_one_step():
            nonlocal version
            found, version = self.pictures("fluid.pressure,solid.speed,coupler.outline", version)
            seen.update(found)
            return len(seen) == 3 and len({header["step"] for header, _, _ in seen.values()}) == 1

        self.assertTrue(until(of_one_step), "the programs never draw the same step")
        self.assertEqual({name: header["quantity"] for name, (header, _, _) in seen.items()},
                         {"fluid": "pressure", "solid": "speed", "coupler": "outline"})
        gas, x, levels = seen["fluid"]
        self.assertLess(0, gas["low"])
        self.assertIn(1, levels)  # the smallest value, and no point without one
        side = seen["coupler"][1]
        self.assertTrue(any(abs(place - side[0]) < 1e-6 for place in x))  # the gas begins where the interface is
        run.until_further(20_000)
        run.ctl("stop")
        self.assertEqual(run.wait(), 0, run.stderr)
        alone = self.launch(*LONG, out="alone")
        self.assertTrue(until(lambda: alone.written() > run.written()))
        alone.ctl("stop")
        self.assertEqual(alone.wait(), 0, alone.stderr)
        self.assertEqual(run.table(), alone.table()[:len(run.table())])

    def test_events_tell_every_change_and_the_end(self):
        run, monitor = self.begin()
        place = urllib.parse.urlsplit(self.url)
        connection = http.client.HTTPConnection(place.hostname, place.port, timeout=WATCHDOG)
        self.addCleanup(connection.close)
        connection.request("GET", "/api/events")
        answer = connection.getresponse()
        self.assertEqual(answer.getheader("Content-Type"), "text/event-stream")

        def events():
            while True:
                line = answer.readline().decode()
                if line.startswith("data: "):
                    yield json.loads(line[6:])

        first = next(state["step"] for state in events() if "step" in state)
        next(state for state in events() if state["step"] > first)
        self.assertEqual(self.ask("stop", "a guess"), 403)
        self.assertEqual(self.ask("format_the_disk", self.token), 400)
        self.assertEqual(self.ask("pause", self.token), 200)
        paused = next(state for state in events() if state["status"] == "paused")
        self.assertEqual(self.ask("stop", self.token), 200)
        last = next(state for state in events() if state["status"] == "ended")
        self.assertEqual(run.wait(), 0, run.stderr)
        self.assertLessEqual(paused["step"], last["step"])
        self.assert_ends_after(paused["step"], run)
        self.assertLessEqual(last["step"], run.summary()["steps"])
        self.assertEqual(self.state()["status"], "ended")  # it can still be looked at
        monitor.terminate()
        self.assertEqual(monitor.wait(timeout=WATCHDOG), 0)


class Page(WebTest):
    """Each test looks at a page of its own; whatever it asks of that, it waits for."""

    @classmethod
    def setUpClass(cls):
        cls.browser = browser.Browser(browser.find())
        cls.addClassCleanup(cls.browser.close)

    def setUp(self):
        super().setUp()
        self.page = self.another_page()

    def another_page(self):
        page = self.browser.page()
        self.addCleanup(page.close)
        return page

    def shows(self, element, words):
        found = until(lambda: words in (self.page.value(f"document.getElementById('{element}').innerText") or ""))
        self.assertTrue(found, f"{element} does not show '{words}'")

    def becomes(self, script, value=True, words=""):
        """Waits for an expression of the page to have a value."""
        self.assertTrue(until(lambda: self.page.value(script) == value), words or f"{script} never is {value}: {self.page.value(script)}")

    def coloured(self, canvas):
        """Waits until something is drawn on a canvas."""
        self.becomes(f"(() => {{ const c = document.getElementById('{canvas}'); const d = c.getContext('2d')"
                     ".getImageData(0, 0, c.width, c.height).data; let n = 0;"
                     " for (let k = 3; k < d.length; k += 4) n += d[k] > 0; return n > 300; })()", words=f"nothing is drawn on {canvas}")

    def click(self, command):
        """Presses a button once it can be pressed."""
        button = f"document.querySelector('[data-command={command}]')"
        self.becomes(f"{button}.disabled", False)
        self.page.do(f"{button}.click()")

    def choose(self, element, value):
        self.page.do(f"document.getElementById('{element}').value = '{value}'; document.getElementById('{element}').onchange()")

    def test_page_follows_the_run_survives_its_end_and_the_loss_of_the_monitor(self):
        run, monitor = self.begin()
        self.page.show(self.url + "#token=" + self.token)
        self.shows("status", "running")
        self.shows("programs", "alive")
        self.shows("interfaces", "solid")
        step = self.page.do("memory.state.step")
        self.becomes(f"memory.state.step > {step} + 5", words="the page stands still")
        for canvas in ("shape", "pressure", "velocity", "timeline"):
            self.coloured(canvas)
        self.assertEqual(self.page.problems, [])
        self.click("pause")
        self.shows("status", "paused")
        self.click("resume")
        self.shows("status", "running")
        self.click("pause")
        self.shows("status", "paused")
        paused = self.page.do("memory.state.step")
        self.assertEqual(self.ask("stop", self.token), 200)
        self.shows("status", "ended")
        self.shows("notice", "the run has ended")
        self.becomes("[...document.querySelectorAll('[data-command]')].every((button) => button.disabled)")
        self.assertEqual(run.wait(), 0, run.stderr)
        self.assert_ends_after(paused, run)
        self.assertLessEqual(paused, self.page.do("memory.state.step"))
        self.assertLessEqual(self.page.do("memory.state.step"), run.summary()["steps"])
        self.assertEqual(self.page.problems, [])
        self.page = self.another_page()  # one opened afterwards shows it too
        self.page.show(self.url)
        self.shows("status", "ended")
        self.assertEqual(self.page.problems, [])
        monitor.kill()
        self.shows("notice", "the monitor has left")

    def test_both_sides_of_a_wall_between_two_gases_are_named_within_their_picture(self):
        self.begin("piston_between_gases", "--set", "grid.factor=4", "--set", "parameters.cells=4", "--set", "time.dt=1e-7",
                   "--set", "output.times=[1e-6, 1.6]", "--set", "expect={}")
        self.page.show(self.url + "#token=" + self.token)
        for words in ("piston.left", "piston.right"):
            self.shows("interfaces", words)
        for words in ("left", "right", "piston", "coupler"):
            self.shows("programs", words)
        self.page.do("""(() => {
            window.drawn = {};
            const draw = CanvasRenderingContext2D.prototype.fillText;
            CanvasRenderingContext2D.prototype.fillText = function (words, x, ...rest) {
              const wide = this.measureText(words).width, left = this.textAlign === "right" ? x - wide : x;
              drawn[this.canvas.id + " " + words] = [left, left + wide, this.canvas.clientWidth];
              draw.call(this, words, x, ...rest);
            };
            memory.stale = true;
          })()""")
        for name in ("piston.left", "piston.right"):
            self.becomes(f"'shape {name}' in drawn")
            begin, end, width = self.page.do(f"drawn['shape {name}']")
            self.assertGreaterEqual(begin, 0, name)
            self.assertLessEqual(end, width, name)
        self.assertEqual(self.page.problems, [])

    SHOWN = "[...currentFrame().pictures.values()].map((p) => p.from + ' ' + p.quantity).sort().join()"
    GAS_DRAWN = "live.drawn.find((p) => p.role === 'fluid')"

    def begin_paused(self):
        """A page beside a run that pauses after 30 steps, with the fields of that step."""
        run = self.launch(*LONG, "--pause-at", "30")
        run.until_paused()
        self.serve(run, str(run.directory))
        self.page.show(self.url + "#token=" + self.token)
        self.becomes(self.SHOWN, "fluid pressure,solid speed")
        self.becomes("currentFrame().step", 30)
        return run

    def test_fields_are_shown_while_the_run_is_paused(self):
        self.begin_paused()
        self.coloured("picture")
        self.becomes("memory.state.step >= 29", words="the numbers are not those of the step it stands at")
        self.becomes("live.frames[0].step < 30", words="what was written before the page was opened is not shown")
        for quantity in ("schlieren", "pressure"):  # another picture of the same step
            self.choose("gas-quantity", quantity)
            self.becomes(self.SHOWN, f"fluid {quantity},solid speed")
            self.becomes(f"{self.GAS_DRAWN}.quantity", quantity)
        # the raster holds values of the field
        self.becomes("live.drawn[0].role", "fluid")
        value, low, high = self.page.do("(() => { const k = live.raster.owner.indexOf(1), [p] = live.drawn; "
                                        "return [live.raster.value[k], p.low, p.high]; })()")
        self.assertTrue(low * (1 - 1e-6) <= value <= high * (1 + 1e-6), (low, value, high))
        self.assertEqual(self.page.problems, [])

    def test_colours_and_a_chosen_moment_hold_while_the_run_goes_on(self):
        self.begin_paused()
        self.becomes(f"{self.GAS_DRAWN}.quantity", "pressure")
        self.choose("gas-limits", "fixed")
        self.page.do("document.getElementById('gas-high').value = 77; document.getElementById('gas-high').oninput({target: document.getElementById('gas-high')})")
        self.click("resume")
        self.becomes("live.frames.length > 5", words="no new moments")
        self.becomes(f"{self.GAS_DRAWN}.step > 30 && rangeOf({self.GAS_DRAWN})[1]", 77)
        moment = "document.getElementById('moment')"
        self.becomes(f"(() => {{ {moment}.value = live.frames.findIndex((f) => f.step === 30); {moment}.oninput(); return currentFrame().step; }})()", 30)
        count = self.page.do("live.frames.length")
        self.becomes(f"live.frames.length > {count}", words="nothing is kept while one looks back")
        self.assertEqual(self.page.do("currentFrame().step"), 30)
        self.page.do("document.getElementById('follow').click()")
        self.becomes("currentFrame().step > 30")
        self.assertEqual(self.page.problems, [])

    def test_proposals_of_time_steps_are_shown_beside_the_traffic(self):
        self.begin()
        self.page.show(self.url)
        self.shows("traffic", "solid")
        self.shows("programs", "proposes dt")
        limits = "proposal({limited_by: 'fluid'}, '%s', {role: 'fluid', dt_bid: 0.5}).textContent"
        self.assertEqual([self.page.do(limits % name) for name in ("fluid", "other")], ["0.5 limits", "0.5"])
        self.coloured("bids")
        self.assertEqual(self.page.problems, [])

    def test_one_cursor_reads_all_plots_and_a_zoom_holds_for_all(self):
        self.begin()
        self.page.show(self.url)
        self.shows("status", "running")
        over_time = "[...plots.values()].filter(({plot}) => plot.axis === 't')"
        gap = "[...plots].find(([, one]) => one.plot.title.startsWith('gap'))"
        self.becomes(f"{over_time}.length >= 5 && {over_time}.every(({{plot}}) => plot.curves[0].x.length > 5) && {gap} !== undefined")
        words = self.page.do(f"(() => {{ const [canvas] = {gap}; canvas.focus(); canvas.dispatchEvent(new KeyboardEvent('keydown', {{ key: 'ArrowLeft' }})); "
                             "return document.getElementById('said').textContent; })()")
        self.assertRegex(words, r"^gap, log, t = \S+: \S+$")
        at = self.page.do("axes.t.at")
        self.page.do("setSpan('t', [0, axes.t.at])")
        self.assertEqual(self.page.do(f"[...new Set({over_time}.map(({{drawn}}) => drawn.across[1]))]"), [at])
        labels = self.page.do("[...document.querySelectorAll('main canvas')].filter((c) => !c.getAttribute('aria-label') && !c.getAttribute('aria-hidden')).map((c) => c.id)")
        self.assertEqual(labels, [], "a canvas says nothing to those who do not see it")
        self.assertEqual(self.page.problems, [])

    def test_run_that_is_over_is_shown_from_its_folder(self):
        run = self.complete("sod_tube", "--set", "grid.factor=2", "--set", "output.times=[0.05, 0.1]", "--set", "expect={}")
        self.serve(run, "--replay", str(run.directory))
        self.page.show(self.url)
        self.shows("status", "ended")
        self.becomes("live.frames.map((f) => f.t).join()", "0.05,0.1,0.2")
        self.choose("gas-quantity", "density")
        self.becomes("live.frames.every((f) => f.pictures.get('fluid').quantity === 'density')")
        self.assertAlmostEqual(self.page.do("live.frames[2].pictures.get('fluid').high"), 1, places=2)
        self.shows("facts", "fluid")    # who limited the steps
        self.assertEqual(self.page.problems, [])

    def test_histories_of_a_run_that_is_over_are_those_of_its_tables(self):
        run = self.complete("elastic_piston", "--set", "grid.factor=2", "--set", "expect={}")
        self.serve(run, "--replay", str(run.directory))
        self.page.show(self.url)
        drawn = "Math.max(0, ...[...plots.values()].filter(({plot}) => plot.title.startsWith('gap')).map(({plot}) => plot.curves[0].x.length))"
        self.becomes(drawn, run.summary()["steps"] + 1, "not all that the table holds is drawn")
        self.assertEqual(self.page.problems, [])

    def test_lost_connection_is_shown_while_the_run_goes_on(self):
        run, monitor = self.begin()
        self.page.show(self.url)
        self.shows("status", "running")
        monitor.kill()
        self.shows("status", "no connection")
        self.assertIsNone(run.process.poll())


if __name__ == "__main__":
    if sys.argv[1:] == ["Page"] and browser.find() is None:
        print("not tested: the package chromium is not installed, so no page can be looked at")
        sys.exit(NOT_INSTALLED)
    unittest.main()
