#!/usr/bin/env python3
"""Hard cases of the reader of C++ and of the comparison of calibrations (part of `make lint`)."""
import json
import pathlib
import tempfile
import unittest

import check_docs
import compare_calibrations
import cpp_text
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


class Status(unittest.TestCase):
    def test_a_goal_is_compared_with_the_value(self):
        for goal, value, unit, expected in (("<= 3 %", "-3.1", "%", "no"), ("<= 3 %", "2.9", "%", "yes"), (">= 18 of 20", "17 of 20", "", "no"),
                                            ("88 - 100 %", "95", "%", "yes"), ("equal", "equal", "", "yes"), ("", "1", "", "")):
            self.assertEqual(status.holds(goal, value, unit), expected, goal)
        with self.assertRaises(ValueError):
            status.holds("<= 3 s", "2", "%")


if __name__ == "__main__":
    unittest.main()
