#!/usr/bin/python3
"""`./launch/fsi monitor --web` serves the state of a run."""

import contextlib
import http.client
import json
import re
import socket
import struct
import sys
import unittest
import urllib.error
import urllib.parse
import urllib.request
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from running import WATCHDOG, until  # noqa: E402
from served import WebTest  # noqa: E402


def resident_mib(pid):
    """Memory of a process now."""
    status = Path(f"/proc/{pid}/status").read_text()
    return int(re.search(r"VmRSS:\s+(\d+) kB", status)[1]) / 1024


class Server(WebTest):
    def test_state_numbers_and_page_are_served_to_this_machine_only(self):
        run, _ = self.begin()
        past = json.loads(self.get("api/history.json"))["history"]  # pages ask for it when they are opened, and never again
        self.assertLessEqual({"dt", "solid.gap", "solid.shear", "solid.p_max", "fluid.proposed_dt", "solid.proposed_dt"}, set(past))
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
        self.assert_as_undisturbed(run)

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


if __name__ == "__main__":
    unittest.main()
