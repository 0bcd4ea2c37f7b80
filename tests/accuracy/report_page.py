#!/usr/bin/python3
"""Opens pages of the reports in a headless Chromium: report_page.py PROGRAM, which writes them into a folder."""

import math
import pathlib
import random
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent.parent / "scripts"))
from headless_browser import HeadlessBrowser  # noqa: E402

ARROW_RIGHT, ENTER = "\ue014", "\ue007"


class Page(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        subprocess.run([sys.argv[1], cls.folder.name], check=True)
        cls.browser = cls.enterClassContext(HeadlessBrowser(1280, 900))

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def open(self, name):
        if name == "empty" and self.browser.driver.current_url.endswith("/empty.html"):
            return  # Tests of functions leave the page as it is.
        self.browser.open(pathlib.Path(self.folder.name) / f"{name}.html")

    def tearDown(self):
        self.assertEqual(self.browser.errors(), [])

    def js(self, code, *arguments):
        return self.browser.driver.execute_script(code, *arguments)

    def find(self, selector):
        return self.browser.driver.find_elements("css selector", selector)

    def text(self, selector):
        return self.find(selector)[0].get_attribute("textContent")


class RegressPage(Page):
    def setUp(self):
        self.open("regress")

    def pane(self, kind):
        return self.find(f"[data-case=seam] .frame.{kind}")[0]

    def shows(self):
        return self.js("""return [...document.querySelectorAll('[data-case=seam] .frame.actual img')]
                          .filter(image => !image.hidden).at(-1).className.split(' ')[0]""")

    def mode(self, name):
        self.find(f"[data-case=seam] [data-mode={name}]")[0].click()

    def test_failures_come_first(self):
        self.assertEqual(self.text("h1"), "3 of 5 cases did not pass")
        self.assertEqual([c.get_attribute("data-case") for c in self.find(".case")], ["seam", "crash", "new"])
        self.assertEqual(self.js("return [...document.querySelectorAll('#table tbody .verdict')].map(v => v.textContent)"),
                         ["failed", "error", "failed", "passed", "skipped"])
        self.assertEqual(len(self.find("[data-case=seam] .pane img:not(.other)")), 6, "four, and two under the slider")
        self.assertEqual(len(self.find("[data-case=crash] img")), 0)
        self.assertEqual(len(self.find("[data-case=new] img")), 1)

    def test_numbers_stand_beside_limits(self):
        self.assertEqual([e.text for e in self.find("[data-case=seam] .numbers .over")], ["pixels over 3/255 1.56 % 0.1 %"])

    def test_fault_is_marked_in_every_picture(self):
        style = self.js("return document.querySelector('[data-case=seam] .frame.expected .region').getAttribute('style')")
        self.assertEqual(style, "left:50%;top:0%;width:1.5625%;height:100%")
        self.assertEqual(len(self.find("[data-case=seam] .region")), 5)
        self.find("[data-case=seam] .mark")[0].click()
        self.assertFalse(self.find("[data-case=seam] .region")[0].is_displayed())

    def test_pointer_swaps_the_pictures(self):
        self.assertEqual(self.shows(), "actual")
        self.js("arguments[0].dispatchEvent(new PointerEvent('pointerenter'))", self.pane("actual"))
        self.assertEqual(self.shows(), "expected")
        self.assertEqual(self.text("[data-case=seam] .pane:has(.frame.actual) > p"), "expected, in the place of the actual one")
        self.js("arguments[0].dispatchEvent(new PointerEvent('pointerleave'))", self.pane("actual"))
        self.assertEqual(self.shows(), "actual")

    def test_pictures_blink(self):
        self.mode("blink")
        for expected in ("expected", "actual"):
            self.browser.wait(f"return document.querySelector('[data-case=seam] .frame.actual').dataset.shows === '{expected}'")
        self.mode("swap")

    def test_slider_divides_the_pictures(self):
        split = self.find("[data-case=seam] .split")[0]
        self.assertFalse(split.is_displayed())
        self.mode("slider")
        self.assertTrue(split.is_displayed())
        self.assertFalse(self.pane("actual").is_displayed())

    def test_zoom_is_linked_and_starts_at_the_fault(self):
        self.find("[data-case=seam] .zoom button")[2].click()
        style = self.js("return document.querySelector('[data-case=seam] .panes').getAttribute('style').replaceAll(' ', '')")
        self.assertIn("--zoom:4", style)
        self.assertIn("--at-x:50.78125%", style)
        scale = lambda kind: self.js("return getComputedStyle(arguments[0].querySelector('img')).transform", self.pane(kind))
        self.assertEqual({scale(kind) for kind in ("expected", "actual", "difference", "FLIP")}, {"matrix(4, 0, 0, 4, 0, 0)"})
        self.js("arguments[0].focus()", self.pane("FLIP"))
        self.browser.press(ARROW_RIGHT)
        self.assertEqual(self.js("return document.querySelector('[data-case=seam] .panes').style.getPropertyValue('--at-x')"),
                         "54.78125%")

    def test_commands_can_be_copied(self):
        self.assertEqual([e.text for e in self.find("[data-case=seam] .commands code")],
                         ["speculum render --set 'a b=1'", "speculum regress --filter seam --update"])
        button = self.find("[data-case=seam] .commands .copy")[1]
        button.click()
        self.browser.wait("return document.querySelectorAll('[data-case=seam] .copy')[1].textContent === 'copied'")
        self.assertEqual(len(self.find("[data-case=crash] .commands code")), 1, "nothing to accept")

    def test_table_leads_to_the_case(self):
        self.js("document.querySelector('tr[data-key=new] .name').click()")
        self.browser.wait("return Math.abs(document.querySelector('[data-case=new]').getBoundingClientRect().top) < 400")

    def test_a_run_without_failures_is_short(self):
        self.open("regress_passed")
        self.assertEqual(self.text("h1"), "1 case, none failed")
        self.assertEqual(len(self.find("img")), 0)


class ReportPage(Page):
    def keys(self, selector):
        return [element.get_attribute("data-key") for element in self.find(selector)]

    def column(self, index):
        return self.js("return [...document.querySelectorAll('tbody tr')].map(r => r.cells[arguments[0]].sortKey)", index)

    def sort_by(self, index):
        self.js("document.querySelectorAll('thead tr:last-child button')[arguments[0]].click()", index)
        return self.column(index)

    def assert_sound(self):
        """Everything in the plots lies in its view box and is a number; every picture has a text."""
        problems = self.js("""
            const problems = [];
            const check = (element, text, high) => (text.match(/-?[0-9.]+/g) ?? []).forEach(
              number => number >= 0 && number <= high || problems.push(`${element.outerHTML.slice(0, 80)}: ${number}`));
            for (const plot of document.querySelectorAll('svg.plot')) {
              if (/NaN|Infinity|undefined/.test(plot.outerHTML)) problems.push('not a number in ' + plot.outerHTML);
              const { width, height } = plot.viewBox.baseVal;
              for (const element of plot.querySelectorAll('*')) {
                for (const { name, value } of element.attributes) {
                  if (/^(x|x1|x2|cx)$/.test(name)) check(element, value, width);
                  if (/^(y|y1|y2|cy)$/.test(name)) check(element, value, height);
                  if (name === 'points' || name === 'd') {
                    value.match(/[0-9.]+[ ,][0-9.]+/g).map(pair => pair.split(/[ ,]/)).forEach(
                      ([x, y]) => { check(element, x, width); check(element, y, height); });
                  }
                }
              }
            }
            document.querySelectorAll('img').forEach(image => image.alt || problems.push(image.outerHTML.slice(0, 80)));
            return problems;""")
        self.assertEqual(problems, [])

    def test_page_shows_every_point_as_text(self):
        self.open("example")
        self.assert_sound()
        names = [element.text for element in self.find("tbody .name")]
        self.assertEqual(len(names), 12)
        self.assertIn("a </script><!-- <&\"> 'name'", names)
        self.assertEqual(self.text("h1"), "A room <with> mirrors")
        self.assertIn("A room <with> mirrors", self.browser.driver.title)
        self.assertIn("Resolution <of mirrors>", self.text("#series"))
        self.assertIn("--set 'view.clear_color=1, 0, 0' --set view.samples=1", self.text("#table"))
        self.assertEqual(self.text("[data-fill=sweepCommand]"),
                         "speculum accuracy --scene 'scenes/room & co.toml' --size 64x36 --time 1.25 --sweep quick"
                         " --set view.samples=8 --gpu 'A device' --out FOLDER")
        self.assertIn(" --set view.samples=8 --gpu 'A device' --out ", self.text("[data-fill=pictureCommand]"))
        self.assertIn("reflection.scale = 1.0", self.text("#base"))

    def test_page_sums_up_the_findings(self):
        self.open("example")
        summary = self.text("[data-fill=summary]")
        self.assertIn("Of 12 configurations, 7 are worth their price, from 0.500 ms and mean FLIP 0.100 (scale 0.125) to"
                      " 25.8 ms and mean FLIP 0.00503 (scale 4)", summary)
        self.assertIn("the base settings take 2.00 ms and mean FLIP 0.0200, off the front", summary)
        self.assertIn("known to 0.000800, 25 times below that.", summary)

    def test_page_needs_nothing_beside_it(self):
        self.open("example")
        self.assertEqual(self.js("return performance.getEntriesByType('resource').map(e => e.name)"
                                 ".filter(name => !name.startsWith('data:'))"), [])

    def test_plots_mark_their_fronts(self):
        self.open("example")
        self.assertEqual(len(self.find("svg.plot")), 5)
        plots = "#front-figures figure:nth-child({}) .mark.{}[data-key]"
        self.assertEqual(set(self.keys(plots.format(1, "front"))), set("1234567"))
        self.assertEqual(set(self.keys(plots.format(1, "dominated"))), {"0", "8", "9", "10", "11"})
        fronts = self.js("return JSON.parse(document.getElementById('data').textContent).fronts")
        for place, measure in ((2, "rmse"), (3, "mirrors")):
            self.assertEqual(set(self.keys(plots.format(place, "front"))), set(map(str, fronts[measure])))
        self.assertEqual(len(self.find("#front-figures .floor")), 3)
        self.assertEqual(len(self.find("#front-figures path.stroke")), 3)
        self.assertEqual(len(self.find("#series .mark.front[data-key]")), 10)
        self.assertEqual(self.keys("tbody tr.front"), list("1723456"))

    def test_movement_has_flicker_and_frames(self):
        self.open("example")
        self.assertFalse(self.find("#motion")[0].is_displayed())
        self.open("motion")
        self.assert_sound()
        self.assertEqual(len(self.find("#front-figures svg.plot")), 4)
        front = self.js("return JSON.parse(document.getElementById('data').textContent).fronts.flicker")
        self.assertEqual(set(self.keys("#front-figures figure:nth-child(2) .mark.front[data-key]")), set(map(str, front)))
        self.assertIn("--motion 'a path.toml' --frames 3 --fps 30", self.text("[data-fill=sweepCommand]"))
        self.assertEqual(len(self.find(".strip img")), 6, "of the reference and of the base settings")
        shown = lambda: self.js("return [...document.querySelectorAll('#strip .frame img')].map(i => i.alt)")
        self.assertEqual(shown(), ["Frame 1, ray traced", "Frame 1, base"])
        self.js("document.querySelector('#strip .stepper').focus()")
        self.browser.press(ARROW_RIGHT)
        self.assertEqual(shown(), ["Frame 2, ray traced", "Frame 2, base"])
        self.js("document.querySelectorAll('.strip img')[5].click()")
        self.assertEqual(shown(), ["Frame 3, ray traced", "Frame 3, base"])
        self.assertEqual(self.text("#strip output"), "3 of 3")
        self.js("document.querySelector('#strip button').click()")
        self.browser.wait("return document.querySelector('#strip output').textContent === '1 of 3'")
        self.js("document.querySelector('#strip button').click()")
        self.js("document.querySelector('tbody tr[data-key=\"3\"] .name').click()")
        self.assertEqual(len(self.find(".strip img")), 3)
        self.assertIn("not in this report", self.text("#strip .panes"))

    def test_plots_fit_a_narrow_window(self):
        self.open("example")
        try:
            self.browser.driver.set_window_size(500, 900)
            self.browser.wait("return document.querySelector('.main svg').viewBox.baseVal.width < 500")
            self.assert_sound()
            self.assertTrue(self.js("return document.documentElement.scrollWidth <= innerWidth"))
            self.assertEqual(len(self.find(".main .mark.selected")), 1)
        finally:
            self.browser.driver.set_window_size(1280, 900)

    def test_headings_sort_the_table(self):
        self.open("example")
        self.assertEqual(self.column(3), sorted(self.column(3)))
        self.assertEqual(self.text("th[aria-sort=ascending]"), "GPU [quartiles]")
        self.assertEqual(self.sort_by(5), sorted(self.column(5)))
        self.assertEqual(self.sort_by(5), sorted(self.column(5), reverse=True))
        self.assertEqual(self.sort_by(9), sorted(self.column(9), reverse=True), "the best SSIM first")
        self.assertEqual(self.sort_by(1)[:3], ["a </script><!-- <&\"> 'name'", "base", "depth 0"])
        self.assertEqual(self.sort_by(0)[:7], [1] * 7)

    def test_missing_values_sort_last(self):
        self.open("odd")
        self.assertIsNone(self.sort_by(13)[-1])
        self.assertIsNone(self.sort_by(13)[-1])

    def test_selection_is_one_everywhere(self):
        self.open("example")
        self.assertEqual(set(self.keys(".selected")), {"0"})
        shown = self.find(".split .test img")[0].get_attribute("src")
        self.js("document.querySelector('tbody tr[data-key=\"3\"] .name').click()")
        self.assertEqual(set(self.keys(".selected")), {"3"})
        self.assertEqual(self.find(".controls select")[0].get_attribute("value"), "3")
        self.assertNotEqual(self.find(".split .test img")[0].get_attribute("src"), shown)
        self.assertIn("scale 0.5", self.text(".shown strong"))
        self.js("document.querySelector('.main .mark[data-key=\"9\"]').dispatchEvent(new MouseEvent('click'))")
        self.assertEqual(set(self.keys(".selected")), {"9"})

    def test_slider_goes_along_the_front(self):
        self.open("example")
        slider = self.find(".stepper")[0]
        self.js("arguments[0].focus(); arguments[0].value = 0; arguments[0].dispatchEvent(new Event('input'))", slider)
        self.assertEqual(set(self.keys(".selected")), {"1"})
        slider.send_keys(ARROW_RIGHT)
        self.assertEqual(set(self.keys(".selected")), {"7"})
        self.assertEqual(slider.get_attribute("aria-valuetext"), "depth 0")

    def test_keys_go_through_the_marks(self):
        self.open("example")
        self.js("document.querySelector('.main .mark[tabindex=\"0\"]').focus()")
        self.browser.press(ARROW_RIGHT)
        self.browser.press(ENTER)
        self.assertEqual(set(self.keys(".selected")), {"7"})
        self.assertIn("depth 0", self.text(".tip"))
        self.assertIn("--set reflection.max_depth=0", self.text(".tip"))

    def test_pictures_keep_their_size(self):
        self.open("example")
        sizes = self.js("return [...document.querySelectorAll('#viewer img:not(.legend)')]"
                        ".map(i => [i.complete, i.naturalWidth, i.naturalHeight])")
        self.assertEqual(sizes, [[True, 64, 36]] * 3)
        self.assertGreater(self.js("return document.querySelector('.legend').naturalHeight"), 0)

    def test_divider_moves(self):
        self.open("example")
        divider = self.find(".divider")[0]
        self.js("arguments[0].focus()", divider)
        divider.send_keys(ARROW_RIGHT)
        self.assertEqual(self.js("return document.querySelector('.split').style.getPropertyValue('--split')"), "52%")
        self.assertEqual(divider.get_attribute("aria-valuetext"), "52 % rendered, the rest ray traced")

    def test_zoom_follows_the_map(self):
        self.open("example")
        self.js("document.querySelectorAll('.zoom button')[2].click(); document.querySelector('.map').focus()")
        self.browser.press(ARROW_RIGHT)
        style = self.js("return document.querySelector('.panes').getAttribute('style').replaceAll(' ', '')")
        self.assertIn("--zoom:4", style)
        self.assertIn("--at-x:54%", style)

    def test_settings_can_be_copied(self):
        self.open("example")
        self.find("tr[data-key='3'] .copy")[0].click()
        self.browser.wait("return document.querySelector('tr[data-key=\"3\"] .copy').textContent !== 'copy'")
        self.assertEqual(self.text("tr[data-key='3'] .copy"), "copied")
        self.assertEqual(set(self.keys(".selected")), {"0"}, "copying selects nothing")

    def test_missing_pictures_are_named(self):
        self.open("missing")
        self.assertIn("The reference picture is not in this report", self.text(".split"))
        self.js("document.querySelector('tr[data-key=\"0\"] .name').click()")
        self.assertIn("The picture of base is not in this report; its lossless file is 0.png", self.text(".split"))
        self.js("document.querySelector('tr[data-key=\"1\"] .name').click()")
        self.assertIn("The error map of scale 0.125 is not in this report; its lossless file is 1.flip.png",
                      self.text(".map"))
        self.open("bare")
        self.assertIn("No pictures were kept, or none could be read.", self.text("#viewer"))

    def test_odd_values_do_not_break_it(self):
        self.open("odd")
        self.assert_sound()
        self.assertIn("no difference", self.text(".main"))
        self.assertIn("∞", self.text("#table"))

    def test_nothing_and_almost_nothing_can_be_shown(self):
        self.open("empty")
        self.assertIn("No configuration was measured.", self.text("[data-fill=summary]"))
        self.assertFalse(self.find("#front")[0].is_displayed())
        self.open("single")
        self.assert_sound()
        self.assertEqual(len(self.find("tbody tr")), 1)
        self.open("untimed")
        self.assert_sound()
        self.assertIn("has no timestamps", self.text("[data-fill=clock]"))

    def test_linear_ticks_are_round(self):
        self.open("empty")
        ticks = lambda *arguments: self.js("return linearTicks(...arguments)", *arguments)
        self.assertEqual(ticks(0, 10, 6), [0, 2, 4, 6, 8, 10])
        self.assertEqual(ticks(0, 1, 11), [0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1])
        self.assertEqual(ticks(-0.3, 0.3, 3), [-0.2, 0, 0.2])
        self.assertEqual(ticks(101, 199, 4), [120, 140, 160, 180])
        self.assertEqual(ticks(3, 3, 5), [3])

    def test_logarithmic_ticks_are_one_two_five(self):
        self.open("empty")
        ticks = lambda *arguments: self.js("return logarithmicTicks(...arguments)", *arguments)
        self.assertEqual(ticks(0.1, 10, 10), [0.1, 0.2, 0.5, 1, 2, 5, 10])
        self.assertEqual(ticks(0.0015, 0.03, 10), [0.002, 0.005, 0.01, 0.02])
        self.assertEqual(ticks(1e-4, 1e2, 8), [1e-4, 1e-3, 1e-2, 0.1, 1, 10, 100])
        self.assertEqual(ticks(1e-4, 1e4, 5), [1e-4, 1e-2, 1, 100, 1e4])
        self.assertEqual(ticks(2.9, 4.1, 6), [3, 3.5, 4], "less than a decade: linear")

    def test_ticks_are_never_more_than_asked(self):
        self.open("empty")
        self.assertTrue(self.js("""
            return [1.01, 1.5, 3, 40, 1e5, 1e12, 1e200].every(factor => [2, 3, 5, 8, 11].every(most =>
              logarithmicTicks(0.7e-20, 0.7e-20 * factor, most).length <= most &&
              linearTicks(-0.7, -0.7 + factor, most).length <= most))"""))

    def test_labels_of_an_axis_have_one_style(self):
        self.open("empty")
        labels = lambda *ticks: self.js("return tickLabels([...arguments])", *ticks)
        self.assertEqual(labels(0.0001, 0.01, 1, 1000), ["0.0001", "0.01", "1", "1000"])
        self.assertEqual(labels(-0.2, 0, 0.2), ["−0.2", "0", "0.2"])
        self.assertEqual(labels(1e-5, 2e-4, 1e-2, 1), ["10⁻⁵", "2×10⁻⁴", "10⁻²", "10⁰"])
        self.assertEqual(labels(1e3, 1e6), ["10³", "10⁶"])

    def test_equal_ratios_are_equal_distances(self):
        self.open("empty")
        one, ten, hundred = self.js("""
            const scale = makeScale({}, [1, 100], 50, 450);
            return [1, 10, 100].map(scale.at)""")
        self.assertTrue(50 < one and hundred < 450)
        self.assertAlmostEqual(hundred - ten, ten - one)

    def test_values_off_the_axis_stand_apart(self):
        self.open("empty")
        scale = self.js("""
            const scale = makeScale({ apart: 1e6 }, [0, 1, 100, 1e6], 50, 450);
            return { ...scale, zero: scale.at(0), negative: scale.at(-3), apart: scale.at(1e6), one: scale.at(1),
                     hundred: scale.at(100), infinite: scale.at(Infinity), none: scale.at(NaN), line: scale.unclampedAt(0) }""")
        self.assertTrue(50 <= scale["zero"] < scale["start"] < scale["one"])
        self.assertTrue(scale["hundred"] < scale["end"] < scale["apart"] <= 450)
        self.assertEqual((scale["negative"], scale["infinite"]), (scale["zero"], scale["apart"]))
        self.assertEqual((scale["none"], scale["line"]), (None, None))

    def test_one_value_is_a_range_too(self):
        self.open("empty")
        places = self.js("""
            return ['linear', 'logarithmic'].flatMap(scale => [1e-300, 0.02, 7, 1e300].map(
              value => makeScale({ scale }, [value], 400, 0).at(value)))""")
        self.assertTrue(all(math.isfinite(place) and 0 <= place <= 400 for place in places), places)
        self.assertGreater(self.js("return makeScale({}, [], 0, 100).ticks(6, 10).length"), 0)

    def test_crowded_tick_labels_go(self):
        self.open("empty")
        self.assertEqual(self.js("""
            return makeScale({ scale: 'linear', ticks: [0, 1, 1.01, 2] }, [0, 2], 0, 200).ticks(6, 10).map(t => t.label)"""),
            ["0", "1", "", "2"])

    def test_lines_end_at_the_frame(self):
        self.open("empty")
        self.assertEqual(self.js("""
            const marks = [[1, 1], [10, 2]].map(([x, y]) => ({ x, y, shape: 'disc', style: '', label: '', tip: '' }));
            const lines = [{ style: 'steep', points: [[1, 1], [10, 1e9]] }, { style: 'outside', points: [[1, 1e7], [10, 1e9]] }];
            const plot = drawPlot({ x: { label: 'x' }, y: { label: 'y' }, marks, lines }, 480, 380);
            return [...plot.querySelectorAll('path')].map(path => path.parentNode.getAttribute('class'))"""), ["steep"])

    def test_labels_of_points_differ(self):
        self.open("empty")
        choice = random.Random(7).choice
        for _ in range(20):
            parts = [f"{key} {value}" for key in ("Mirror resolution", "Max. depth", "Mirror samples", "Samples")
                     for value in ("0.5", "1", "2")]
            names = sorted({", ".join(choice(parts) for _ in range(1 + i % 4)) for i in range(12)})
            labels = self.js("return shortLabels(arguments[0])", names)
            self.assertEqual(len(set(labels)), len(names), labels)
            for name, label in zip(names, labels):
                self.assertLessEqual(set(label.removesuffix(", …").split(", ")), set(name.split(", ")))
        self.assertEqual(self.js("return shortLabels(['base', ''])"), ["base", ""])
        self.assertEqual(self.js("return shortLabels(['Samples 1, Max. depth 32', 'Samples 1, Max. depth 4'])"),
                         ["Max. depth 32, …", "Max. depth 4, …"])

    def test_labels_without_room_are_left_out(self):
        self.open("empty")
        labels = self.js("""
            const marks = [...Array(40).keys()].map(i => ({ x: 1 + 1e-4 * i, y: 1, label: `label ${i}` }));
            marks.push({ x: 50, y: 1, label: 'alone' });
            const whole = marks.map(mark => ({ ...mark, shape: 'disc', style: '', tip: '' }));
            const plot = drawPlot({ x: { label: 'x' }, y: { label: 'y' }, marks: whole }, 480, 380);
            return [...plot.querySelectorAll('.label')].map(label => label.textContent)""")
        self.assertIn("label 39", labels)
        self.assertIn("alone", labels)
        self.assertNotIn("label 10", labels)

    def test_numbers_are_written_for_people(self):
        self.open("empty")
        number = lambda *arguments: self.js("return numberText(...arguments)", *arguments)
        self.assertEqual([number(v) for v in (0, 0.012345, 9.996, 12345.6, 3.21e-5)],
                         ["0", "0.0123", "10.0", "12346", "3.21×10⁻⁵"])
        self.assertEqual([number(v, 2) for v in (-1.5, 2.5e12)], ["−1.5", "2.5×10¹²"])
        self.assertEqual(self.js("return [numberText(Infinity), numberText(NaN), fixedText(Infinity, 2)]"), ["∞", "–", "∞"])
        self.assertEqual(self.js("return fixedText(-0.125, 1)"), "−0.1")
        self.assertEqual(self.js("return [columnDecimals([0, 0.0123, 4, Infinity]), columnDecimals([])]"), [4, 0])

    def test_shell_words_survive_the_shell(self):
        self.open("empty")
        self.assertEqual(self.js("return setOptions({'reflection.scale': '0.5', 'view.clear_color': '1,0,0'})"),
                         "--set reflection.scale=0.5 --set view.clear_color=1,0,0")
        self.assertEqual(self.js("return [\"it's $5\", ''].map(shellWord)"), ["'it'\\''s $5'", "''"])
        self.assertEqual(self.js("return shellWord('a\\u001b[2J\\u202e\\nb')"),
                         r"$'a\U0000001b[2J\U0000202e\U0000000ab'")
        self.assertEqual(self.js(r'return ["C:\\a.png", "a b\\", "", "50%", "C:\\%x", "\\\"", "1,0,0"].map(cmdWord)'),
                         [r"C:\a.png", '"a b\\\\"', '""', '"50"^%""', r'"C:\\"^%"x"', r'"\\"\^"""', '"1,0,0"'])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
