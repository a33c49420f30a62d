#!/usr/bin/env python3
"""Hard cases of the reader of C++ and of the comparison of calibrations (part of `make lint`)."""
import json
import pathlib
import re
import stat
import tempfile
import tomllib
import unittest

import check_docs
import compare_calibrations
import cpp_text
import rocks
import rocks_card
import rocks_pages
import rocks_record
import status

HARD = r'''
#define TWO_LINES(x) if (x) { \
  return; }
namespace phy::engine { namespace {
struct Row { int a = 1; double f(int x, const std::map<int, std::vector<int>>& m = {{1, {2, 3}}}) const { return a; } };
enum class Kind { one, two };
const std::map<std::string, int> table = {{"a", 1}, {"b", 2}};
const auto square = [](int a, int b, int c, int d, int e, int f) { return a; };
std::function<void(int, int)> later{};
MAKE_ALL(float, a)
template <class T, class = std::enable_if_t<(sizeof(T) > 1)>>
T* pick(T (*choose)(int, int), std::array<T, 3> all) {
  const char* text = "} // no comment {"; const char brace = '}'; const int big = 1'000'000;
  return R"x( } )" } )x"[0] ? nullptr : &all[0];
}
Row::Row(int a, int b) : a_{a}, b_(b), c_{[] { return 1; }()} {
  /* } */
}
bool operator<(const Row& a, const Row& b) { return a.x < b.x; }
double Row::operator()(double x) const noexcept { return x; }
Row::operator bool() const { return true; }
auto arrow(int a, std::pair<int, int> b, int c, int d, int e, int f) -> std::vector<int>
{
  if (a < b.first) { return {1, 2}; }
}
static const char* words() {
  return "one"
         "two"
         "three";
}
}  // namespace
}
'''


class Reader(unittest.TestCase):
    def test_functions(self):
        found = {f.name: (f.parameters, f.length()) for f in cpp_text.functions(HARD)}
        self.assertEqual(found, {"f": (2, 1), "pick": (2, 4), "Row::Row": (2, 2), "operator<": (2, 1),
                                 "Row::operator()": (1, 1), "Row::operator bool": (0, 1), "arrow": (6, 4), "words": (0, 5)})

    def test_tables_of_text(self):
        text = [f for f in cpp_text.functions(HARD) if f.is_table_of_text()]
        self.assertEqual([f.name for f in text], ["words"])

    def test_comments(self):
        self.assertEqual(cpp_text.comment_lines('int a;  // why\nauto b = "// no";\n/* two\nlines */\n'), {0, 2, 3})


class Comparison(unittest.TestCase):
    def differences(self, change):
        cell = {"property": "UCS", "theta [deg]": 30.0, "model": 4e7}
        before = {"verdict": {"status": "calibrated", "sentence": "fine"},
                  "fitted": [dict(cell, **{"theta [deg]": 0.0}), cell], "parameters": [{"key": "E_c", "value": 0.1 + 0.2}]}
        after = json.loads(json.dumps(before))
        change(after)
        with tempfile.TemporaryDirectory() as folder:
            names = [pathlib.Path(folder) / name for name in ("a.json", "b.json")]
            for name, content in zip(names, (before, after)):
                name.write_text(json.dumps(content))
            a, b = (compare_calibrations.values_of(name) for name in names)
        return [name for name in a if name not in b or not compare_calibrations.same(a[name], b[name])]

    def test_order_and_words_do_not_matter(self):
        self.assertEqual(self.differences(lambda j: j["fitted"].reverse()), [])
        self.assertEqual(self.differences(lambda j: j["verdict"].update(sentence="better")), [])

    def test_a_bit_matters(self):
        self.assertEqual(self.differences(lambda j: j["parameters"][0].update(value=0.3)), ["parameters[E_c].value"])
        self.assertEqual(self.differences(lambda j: j["verdict"].update(status="out of reach")), ["verdict.status"])
        self.assertEqual(self.differences(lambda j: j["fitted"].pop()), ["fitted[UCS, theta [deg] 30].model"])


LONG = "word " * 31
PAGE = f"""# A page

{LONG.strip()}.

Between 1, 2, 3 and 4 it moves. UCS(60) by Eq. 4 of (2004) is `1, 2, 3, 4` MPa in 38 x 76 mm.

The slope is that of the line. It ran on 25 November.

| a | b |
|---|---|
| 1 | 2 | 3 |
| {LONG}| 2 |

[here](#a-page), [there](#nowhere), [away](missing.md), `tools/check_docs.py`, `tools/status`, `src/nothing.hpp`

```
{LONG} that of 1 2 3 4
```
"""


class Documents(unittest.TestCase):
    def test_texts_of_the_program(self):
        """Neighbours are one text; comments and scripts are none."""
        code = """
// a comment that goes on and on about that of which nobody knows
f("the strengths are those "
  "of the recipe and of nothing else");
g(R"(one two three four five that of;
six seven)");
h("%s");
""" % " ".join(["word"] * 31)
        with tempfile.TemporaryDirectory(dir=check_docs.ROOT) as folder:
            path = pathlib.Path(folder) / "some.cpp"
            path.write_text(code)
            self.assertEqual([line for line, _ in check_docs.problems_of_text(check_docs.Texts(path))], [3, 7])

    def test_every_fault_of_a_page_is_found_once_and_code_is_left_alone(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "page.md")
            path.write_text(PAGE, encoding="utf-8")
            page = check_docs.Page(path)
            text = [line for line, _ in check_docs.problems_of_text(page)]
            self.assertEqual(text, [3, 5, 7, 7])
            self.assertEqual([line for line, _ in check_docs.problems_of_tables(page)], [11, 12])
            self.assertEqual([found for _, found in check_docs.problems_of_links(page, {})],
                             ["no such heading: #nowhere", "a link to nowhere: missing.md"])
            self.assertEqual([found for _, found in check_docs.problems_of_places(page)], ["no such file: src/nothing.hpp"])

    def test_sentences_end_where_a_reader_ends_them(self):
        text = "Fig. 3 shows E. nu falls (see Eq. 1). sigma_c stays. It is 0.5 there."
        self.assertEqual(len(check_docs.sentences(text)), 4)


class Cards(unittest.TestCase):
    def test_formats_names_every_key_of_the_cards_and_no_other(self):
        page = (check_docs.ROOT / "docs/formats.md").read_text(encoding="utf-8").split("## Card, version 1")[1].split("\n## ")[0]
        named = {(row[0], key) for row in map(check_docs.cells, page.splitlines()) if len(row) == 3 for key in re.findall(r"`([^`]+)`", row[1])}
        found = set()

        def walk(value, of):
            for part in value if isinstance(value, list) else [value]:
                if isinstance(part, list):
                    walk(part, of)
                for key, held in part.items() if isinstance(part, dict) else ():
                    if key in rocks_card.PROPERTIES:
                        walk(held, of)  # by property
                        continue
                    found.add((of, key))
                    walk(held, key)

        for path in (check_docs.ROOT / "data/rocks").glob("*/card.json"):
            walk(json.loads(path.read_text(encoding="utf-8")), "card")
        self.assertEqual(found, named)


class Status(unittest.TestCase):
    def test_a_goal_is_compared_with_the_value(self):
        for goal, value, unit, expected in (("<= 3 %", "-3.1", "%", "no"), ("<= 3 %", "2.9", "%", "yes"), (">= 18 of 20", "17 of 20", "", "no"),
                                            ("88 - 100 %", "95", "%", "yes"), ("equal", "equal", "", "yes"), ("", "1", "", "")):
            self.assertEqual(status.holds(goal, value, unit), expected, goal)
        with self.assertRaises(ValueError):
            status.holds("<= 3 s", "2", "%")


PREDICTION = {"name": "p", "property": "sigma_1", "confining": [5], "truth": "envelope.csv", "from_confining": 0, "phi": 30,
              "text": "t", "yardstick": "y", "model": "choose", "without_columns": ["BTS [MPa]"], "without_rows": {"theta [deg]": "90"}}


class Rocks(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)

    def test_what_is_predicted_is_not_in_the_table_of_the_fit(self):
        text = "# of somebody\ntheta [deg],UCS [MPa],BTS [MPa]\n0,50,5\n90,60,6\n"
        self.assertEqual(rocks.rows_without(text, PREDICTION), "theta [deg],UCS [MPa]\n0,50\n")

    def test_truth_and_yardstick_by_hand(self):
        (self.folder / "table.csv").write_text("theta [deg],UCS [MPa]\n0,50\n0,70\n")
        (self.folder / "envelope.csv").write_text("theta [deg],c [MPa],phi [deg]\n0,10,30\n")
        # N is 3 at 30 degrees: 2 c sqrt(3) + 3 x 5, and 60 + 3 x 5
        self.assertAlmostEqual(rocks_card.truth_of(self.folder, PREDICTION)[5, 0.0], 20 * 3**0.5 + 15)
        self.assertAlmostEqual(rocks_card.yardstick_of(self.folder, PREDICTION, (5, 0.0)), 75)

    def test_a_prediction_is_compared_with_what_was_measured(self):
        (self.folder / "table.csv").write_text("theta [deg],UCS [MPa]\n0,60\n")
        (self.folder / "envelope.csv").write_text("theta [deg],c [MPa],phi [deg]\n0,10,30\n")
        truth = 20 * 3**0.5 + 15
        (self.folder / "p-5/out").mkdir(parents=True)
        (self.folder / "p-5/out/band.csv").write_text(f"theta [deg],number,median,low,high\n0,sigma_1,{1.1e6 * truth},{0.9e6 * truth},9e9\n")
        bands = rocks_card.bands_of(type("Run", (), {"folder": self.folder}), PREDICTION)
        card = rocks_card.prediction_card(self.folder, PREDICTION, [bands])
        self.assertAlmostEqual(card["rms"][0], 0.1)
        self.assertEqual((card["inside"], card["of"]), (1, 1))
        self.assertAlmostEqual(card["yardstick_rms"], 75 / truth - 1)

    def test_modes_of_failure_are_means_over_all_tests(self):
        mode = lambda share, angle, planes, tests: {"bedding_share": share, "angle [deg]": angle, "n_planes": planes, "n_tests": tests}
        # 89 and -89 degrees are two degrees apart; tests weigh the share, planes the angle
        found = rocks_card.failure_of([mode(0.1, 89, 5, 5), mode(0.4, -89, 5, 15), mode(0.0, None, 0, 0)])
        self.assertAlmostEqual(found["bedding_share"], 0.325)
        self.assertAlmostEqual(found["angle [deg]"], 90)
        self.assertEqual((found["planes"], found["tests"]), (10, 20))
        self.assertIsNone(rocks_card.failure_of([mode(None, None, 0, 5)])["bedding_share"])
        self.assertIsNone(rocks_card.failure_of([None]))
        self.assertEqual(rocks_pages.plane_words(found), "90")
        self.assertEqual(rocks_pages.plane_words(found | {"planes": 9}), "none")

    def test_a_study_is_a_card_of_its_tests(self):
        (self.folder / "table.csv").write_text("theta [deg],DTS [MPa],failure plane [deg]\n0,2,0\n60,5,14\n90,8,0\n")
        heads = "theta [deg],sigma_t [Pa],bedding_share [1],failure_angle [deg]"
        (self.folder / "specimens.csv").write_text(f"{heads}\n0,2e6,1,1\n0,3e6,1,-1\n60,4e6,0.5,58\n60,5e6,0.7,62\n60,,,\n90,8e6,0.2,3\n")
        plan = {"name": "t", "property": "DTS", "truth": "table.csv", "text": "t", "yardstick": "y", "model": "study", "predicted": [60],
                "along_within": 10, "blind": True}
        card = rocks_card.study_card({}, self.folder, self.folder, [(plan, [])])
        self.assertEqual([c["failure"]["along"] for c in card["cells"]], [True, True, False])
        self.assertEqual([c["failure"]["laboratory_along"] for c in card["cells"]], [True, False, False])
        prediction = card["predictions"][0]
        self.assertEqual(len(prediction["rows"]), 1)
        self.assertAlmostEqual(prediction["rms"][0], 0.1)  # 4.5 for 5
        self.assertAlmostEqual(prediction["yardstick_rms"], 0.6)  # 2/cos^2 60 = 8, which is no more than 8
        self.assertEqual((prediction["inside"], prediction["of"]), (1, 1))

    def test_what_is_finished_is_not_run_again_but_by_another_program(self):
        program, count = self.folder / "program", self.folder / "count"
        program.write_text(f"#!/bin/sh\necho $1 >>{count}\nexit 1\n")
        program.chmod(program.stat().st_mode | stat.S_IXUSR)
        for words in ("one", "one", "another"):
            self.assertEqual(rocks.timed([program, words], self.folder, count, words), 1)
        self.assertEqual(count.read_text(), "one\nanother\n")
        self.assertEqual(rocks.timed([program, "third"], self.folder, self.folder / "missing", "third"), 1)  # stopped: no result
        rocks.timed([program, "third"], self.folder, count, "third")
        self.assertEqual(count.read_text(), "one\nanother\nthird\nthird\n")

    def test_the_record_of_forecasts_keeps_the_rocks_that_were_not_run(self):
        record = self.folder / "forecasts.csv"
        record.write_text(rocks_record.HEAD + "a,1,quick,UCS,0.1,0.2,0.3\nb,1,quick,E,0.1,0.2,0.1\n")
        run = rocks.Run(self.folder / "run", "tournemire-shale", 7, ["--elastic"])
        run.result.parent.mkdir(parents=True)
        run.result.write_text(json.dumps({"effort": "normal", "errors": [{"of": "unseen packings", "UCS": 0.06, "nu": None}], "reach": [
            {"kind": "forecast_excepted", "numbers": {"UCS": [0.05, 0.2], "nu": [0.01, 0.02]}}]}))
        rocks_record.write(record, {"a": [run]})
        self.assertEqual(record.read_text().splitlines()[2:], ["a,7,normal,UCS,0.0500,0.2000,0.0600", "b,1,quick,E,0.1,0.2,0.1"])

    def test_another_table_begins_anew(self):
        run = rocks.Run(self.folder / "run", "tournemire-shale", 1, ["--elastic"])
        run.prepare()
        (run.folder / "kept").touch()
        run.prepare()
        self.assertTrue((run.folder / "kept").exists())
        run.table += "95,20\n"
        run.prepare()
        self.assertFalse((run.folder / "kept").exists())

    def test_every_rock_is_planned_and_its_rows_name_their_sources(self):
        plan = tomllib.loads((rocks.BASE / "plan.toml").read_text(encoding="utf-8"))
        self.assertEqual({p.parent.name for p in rocks.BASE.glob("*/rock.toml")}, set(plan["rock"]))
        for name in plan["rock"]:
            about = rocks_card.about_of(rocks.BASE / name)
            card = json.loads((rocks.BASE / name / "card.json").read_text(encoding="utf-8"))
            self.assertEqual({k: card[k] for k in about}, about, f"{name}: make rocks")
            if (table := rocks.BASE / name / "table.csv").exists() and name != "coal":
                named = {line.split(",")[-2] for line in table.read_text(encoding="utf-8").splitlines()[1:]}
                self.assertEqual(named, {s["key"] for s in about["sources"]}, name)


if __name__ == "__main__":
    unittest.main()
