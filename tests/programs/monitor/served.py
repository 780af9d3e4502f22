"""A run and a monitor that serves it to browsers."""

import json
import os
import subprocess
import urllib.error
import urllib.request

from running import BIN, EndToEnd, FSI, LONG, WATCHDOG, until


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
