#!/usr/bin/python3
"""The page of `./launch/fsi monitor --web` in a headless Chromium."""

import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import browser  # noqa: E402
from running import LONG, until  # noqa: E402
from served import WebTest  # noqa: E402

NOT_INSTALLED = 77  # exit code that CTest shows as skipped


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

    def test_round_off_is_drawn_as_what_does_not_vary(self):
        self.begin_paused()
        low, high = self.page.do("spread([-3e-14, 5e-14], 1e-9)")
        self.assertAlmostEqual(high - low, 1e-9)
        low, high, cut = self.page.do("robustSpread(Array.from({length: 50}, (_, k) => 1e5 + 2e-10 * Math.sin(k)), 1e-6)")
        self.assertGreater(high - low, 0.1)
        self.assertFalse(cut)
        self.choose("solid-limits", "now")
        high, scale = self.page.do("(() => { const p = live.drawn.find((one) => one.role === 'solid'); "
                                   "return [rangeOf({...p, low: 0, high: 1e-20})[1], memory.state.interfaces.solid.velocity_scale]; })()")
        self.assertGreater(scale, 0)
        self.assertAlmostEqual(high / scale, 1e-11)
        self.page.do("(() => { const [gas] = live.drawn; limitsOf(gas).seen = [1e-17, 1]; showBars(live.drawn); })()")
        self.assertEqual(self.page.do("document.getElementById('gas-low').value"), "0")
        self.assertEqual(self.page.problems, [])

    def test_the_picture_of_a_run_that_pauses_is_that_of_where_it_stands(self):
        self.begin()
        self.page.show(self.url + "#token=" + self.token)
        self.becomes("live.frames.some((frame) => frame.pictures.size === 3)", words="the programs never draw the same step")
        self.click("pause")
        self.shows("status", "paused")
        self.becomes("currentFrame().step > memory.state.step", words="the picture is of an earlier step")
        self.becomes(self.SHOWN, "fluid pressure,solid speed")
        self.assertEqual(self.page.problems, [])

    def test_proposals_of_time_steps_are_shown_beside_the_traffic(self):
        self.begin()
        self.page.show(self.url)
        self.shows("traffic", "solid")
        self.shows("programs", "proposes dt")
        limits = "proposal({limited_by: 'fluid'}, '%s', {role: 'fluid', proposed_dt: 0.5}).textContent"
        self.assertEqual([self.page.do(limits % name) for name in ("fluid", "other")], ["0.5 limits", "0.5"])
        self.coloured("proposals")
        # neighbours in a long history are one point, at the later time: the first one need not be that of the first step
        begun = "memory.history['solid.gap'][0][0]"
        for program in ("fluid", "solid"):
            self.becomes(f"memory.history['{program}.proposed_dt'][0][0] <= {begun}", words="what was proposed before the monitor began is not shown")
        for quantity in ("shear", "p_max", "power"):
            self.becomes(f"memory.history['solid.{quantity}'][0][0] === {begun}", words=f"{quantity} before the monitor began is not shown")
        self.becomes("memory.limiters[0][0]", 0)
        self.assertEqual(self.page.problems, [])

    def test_proposals_have_the_colours_of_gas_and_solid_and_say_who_takes_substeps(self):
        self.begin()
        self.page.show(self.url)
        self.shows("proposals-legend", "fluid")
        colours = "coloursOf([%s].map((role) => ({ role }))).join() === [%s].map((name) => theme[name]).join()"
        self.assertTrue(self.page.do(colours % ("'solid', 'fluid', 'fluid', 'solid'", "'solid', 'gas', 'good', 'busy'")))
        of_a_body = "takesSubsteps({dt: 0.5, limited_by: 'fluid', participants: {body: {proposed_dt: %s}}}, 'body')"
        self.assertEqual([self.page.do(of_a_body % dt) for dt in ("0.1", "0.6", "null")], [True, False, False])
        marks = "logAxis(Math.log10(%s), Math.log10(%s), 3).marks.map(([, label]) => label).join(' ')"
        self.assertEqual(self.page.do(marks % (0.011, 0.0144)), "0.012 0.014")
        self.assertEqual(self.page.do("axis(0.13, 1.51, 2).marks.map(([value]) => value)"), [0.5, 1, 1.5])
        self.assertEqual(self.page.do(marks % (0.9, 60)), "1e0 2e0 5e0 1e1 2e1 5e1")
        self.assertEqual(self.page.problems, [])

    def test_a_phone_shows_all_of_the_width_and_no_label_over_another(self):
        self.begin()
        self.page.ask("Emulation.setDeviceMetricsOverride", width=390, height=844, deviceScaleFactor=1, mobile=True)
        self.page.show(self.url)
        self.shows("proposals-legend", "limited by")
        self.assertEqual(self.page.do("document.documentElement.scrollWidth"), 390)
        self.assertLess(self.page.do("document.querySelector('header').offsetHeight"), 844 / 4)
        over = """(() => {
            const drawn = [], draw = CanvasRenderingContext2D.prototype.fillText;
            CanvasRenderingContext2D.prototype.fillText = function (text, x, y) {
                if (/^(now|-\\d+ s)$/.test(text)) drawn.push([x - this.measureText(text).width / 2, x + this.measureText(text).width / 2]);
                draw.apply(this, arguments);
            };
            drawTimeline(document.getElementById("timeline"), [], 0, 60);
            CanvasRenderingContext2D.prototype.fillText = draw;
            drawn.sort((a, b) => a[0] - b[0]);
            return [drawn.length > 2, drawn.filter(([left], k) => k && left < drawn[k - 1][1]).length];
        })()"""
        self.assertEqual(self.page.do(over), [True, 0])
        self.assertEqual(self.page.problems, [])

    def test_a_rigid_body_has_no_stress_that_would_be_compared(self):
        self.begin("rigid_piston", "--set", "time.dt=1e-7", "--set", "output.times=[1e-6, 1]", "--set", "expect={}")
        self.page.show(self.url)
        self.becomes("[...document.querySelectorAll('#interfaces td')].filter((cell) => cell.innerText === '\u2013').length", 2)
        self.becomes("[...document.querySelectorAll('#histories canvas')].filter((one) => /no stress of its own/.test(one.getAttribute('aria-label'))).length", 2)
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
        self.becomes("plots.get(document.getElementById('proposals')).plot.curves.map((one) => one.name + ' ' + (one.x.length > 10)).join()",
                     "fluid true,solid true,agreed on true")
        self.becomes("[...document.querySelectorAll('section')].filter((section) => section.hidden).length", 4, "what a folder does not hold is not hidden")
        self.shows("notice", "fsi monitor --record")
        self.assertEqual(self.page.problems, [])

    def test_lost_connection_is_shown_while_the_run_goes_on(self):
        run, monitor = self.begin()
        self.page.show(self.url)
        self.shows("status", "running")
        monitor.kill()
        self.shows("status", "no connection")
        self.assertIsNone(run.process.poll())


if __name__ == "__main__":
    if browser.find() is None:
        print("not tested: the package chromium is not installed, so no page can be looked at")
        sys.exit(NOT_INSTALLED)
    unittest.main()
