// Specimens after their tests: numbers, series as arrays over the memory that they lie in, figures, and the
// way to another process and back.
#include "python/specimens.hpp"

#include <fmt/format.h>
#include <pybind11/stl.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstddef>
#include <cstring>
#include <type_traits>

#include "base/option.hpp"
#include "base/version.hpp"
#include "genesis/cache.hpp"
#include "io/load.hpp"
#include "io/toml_in.hpp"
#include "python/arrays.hpp"
#include "records/specimen_record.hpp"
#include "records/test_description.hpp"
#include "report/figure_json.hpp"
#include "report/figures.hpp"

namespace phy::python {
namespace {

const Snapshot& last_state(const Test& test) {
  if (test.result.snapshots.empty())
    throw IoError(
        test.result.name +
        ": the folder of a result keeps no last state of grains and contacts; phyllite.run(result.recipe) "
        "makes it");
  return test.result.snapshots.back();
}

const Packing& packing_of(Test& test) {
  // Made when asked for: most users never look at discs, and a packing may take minutes.
  if (!test.packing) test.packing = genesis::packing_of(*test.recipe, genesis::default_cache_folder());
  return *test.packing;
}

std::vector<Member> history_members(const TestResult& result) {
  // Offsets are measured on a row, since offsetof takes no pointer to a member.
  const HistoryRow row;
  std::vector<Member> members;
  for (const HistoryColumn& c : result.kind->columns)
    members.push_back({c.name, "f8",
                       static_cast<std::size_t>(reinterpret_cast<const char*>(&(row.*c.value)) -
                                                reinterpret_cast<const char*>(&row))});
  return members;
}

const std::vector<Member>& crack_members() {
  // NumPy reads these bytes by the types named below: another size would shift every column behind it.
  static_assert(sizeof(CrackMode) == 1 && sizeof(CrackPlace) == 1 && sizeof(Vec2) == 2 * sizeof(double));
  using C = CrackEvent;
  constexpr std::size_t y = sizeof(double);
  static const std::vector<Member> members = {
      {"step", "i8", offsetof(C, step)},           {"time", "f8", offsetof(C, time)},
      {"strain", "f8", offsetof(C, strain)},       {"grain_a", "u4", offsetof(C, a)},
      {"grain_b", "u4", offsetof(C, b)},           {"mode", "u1", offsetof(C, mode)},
      {"place", "u1", offsetof(C, place)},         {"x", "f8", offsetof(C, position)},
      {"y", "f8", offsetof(C, position) + y},      {"normal_x", "f8", offsetof(C, normal)},
      {"normal_y", "f8", offsetof(C, normal) + y}, {"size", "f8", offsetof(C, size)},
      {"energy", "f8", offsetof(C, energy)}};
  return members;
}

const std::vector<Member>& contact_members() {
  static_assert(sizeof(ContactKind) == 1 && sizeof(bool) == 1);
  using C = ContactState;
  static const std::vector<Member> members = {
      {"grain_a", "u4", offsetof(C, a)},       {"grain_b", "u4", offsetof(C, b)},
      {"kind", "u1", offsetof(C, kind)},       {"broken", "?", offsetof(C, broken)},
      {"F_n", "f8", offsetof(C, F_n)},         {"F_s", "f8", offsetof(C, F_s)},
      {"normal_x", "f8", offsetof(C, normal)}, {"normal_y", "f8", offsetof(C, normal) + sizeof(double)}};
  return members;
}

const std::vector<Member> grain_members = {{"ux", "f8", offsetof(GrainState, ux)},
                                           {"uy", "f8", offsetof(GrainState, uy)},
                                           {"rotation", "f8", offsetof(GrainState, rotation)}};
const std::vector<Member> disc_members = {
    {"x", "f8", offsetof(Disc, x)}, {"y", "f8", offsetof(Disc, y)}, {"r", "f8", offsetof(Disc, r)}};

py::list columns_of(const Test& t) {
  py::list columns;
  for (const HistoryColumn& c : t.result.kind->columns)
    columns.append(py::make_tuple(c.name, c.unit, c.meaning));
  return columns;
}

py::dict numbers_of(const Test& t) {
  // A dict of Python whose message for an unknown name lists the near ones.
  py::dict numbers = py::module_::import("phyllite.names").attr("Numbers")();
  for (const Number& n : t.result.numbers) numbers[py::str(n.name)] = n;
  return numbers;
}

/// The results of a folder, and a line for each specimen that its recipe names and that is not there.
py::tuple load_run(const std::string& folder) {
  RunRecord run = io::read_run(folder);
  Tests tests;
  for (SpecimenRecord& t : run.tests)
    tests.push_back(std::make_shared<Test>(
        Test{std::move(t.result), std::make_shared<const Recipe>(std::move(t.recipe)), nullptr}));
  // Python turns them into warnings; an exception would hide the specimens that are there.
  py::list missing;
  for (const MissingTest& m : run.missing) missing.append(m.name + ": " + m.reason);
  return py::make_tuple(tests, missing);
}

/// What a figure of a run shows (report/figure.hpp), as JSON. `rock`: whose values stand beside it, or None.
std::string run_figure(const Tests& tests, const std::string& word, const py::object& rock) {
  const report::FigureKind& kind = report::figure_kind(word);
  if (kind.varied || kind.make == nullptr)
    throw InputError(option_problem("kind", word,
                                    "a chart of a run: stress_strain, damage, anisotropy, modes or rose",
                                    "`phyllite figure` draws specimens"));
  report::FigureData data;
  for (const auto& test : tests) {
    data.run.tests.emplace_back();
    // Copies: figures read records, and a chart is made once.
    data.run.tests.back().recipe = *test->recipe, data.run.tests.back().result = test->result;
  }
  if (!rock.is_none()) data.laboratory = targets_of(rock.cast<NamedRock&>().rock);
  return report::figure_json(kind.make(data)).dump();
}

// --- to another process and back

/// Rows of plain numbers as they lie in memory, of the same program only.
template <class Row>
py::bytes bytes_of(const std::vector<Row>& rows) {
  static_assert(std::is_trivially_copyable_v<Row>);
  return {reinterpret_cast<const char*>(rows.data()), rows.size() * sizeof(Row)};
}
template <class Row>
std::vector<Row> rows_from(const py::handle& bytes) {
  const auto text = bytes.cast<std::string>();
  std::vector<Row> rows(text.size() / sizeof(Row));
  // Copied, since bytes of Python need not be aligned for a double.
  if (!rows.empty()) std::memcpy(rows.data(), text.data(), rows.size() * sizeof(Row));
  return rows;
}

py::tuple state_of(const Number& n) {
  return py::make_tuple(n.name, n.value, n.unit, n.definition, n.note, n.upper_bound);
}
Number number_from(const py::tuple& t) {
  return {t[0].cast<std::string>(), t[1].cast<double>(),      t[2].cast<std::string>(),
          t[3].cast<std::string>(), t[4].cast<std::string>(), t[5].cast<bool>()};
}

py::tuple state_of(const Test& test) {
  const TestResult& r = test.result;
  py::list snapshots;
  // The last state alone, which is all that Python shows.
  if (!r.snapshots.empty())
    snapshots.append(
        py::make_tuple(bytes_of(r.snapshots.back().grains), bytes_of(r.snapshots.back().contacts)));
  // The version first: rows are bytes of this build's structures, and another may lay them out differently.
  return py::make_tuple(phy::version, *test.recipe, r.name, r.intact, r.theta, to_string(r.outcome.status),
                        r.outcome.reason, r.outcome.advice, r.numbers, bytes_of(r.history.rows),
                        bytes_of(r.cracks), snapshots, r.n_steps, r.seconds, r.hash);
}

std::shared_ptr<Test> test_from(const py::tuple& t) {
  if (t[0].cast<std::string>() != phy::version)
    throw IoError(
        fmt::format("this result was pickled by phyllite {}, and this is {}; save folders instead: "
                    "phyllite.run(recipe, \"FOLDER\"), phyllite.load(\"FOLDER\")",
                    t[0].cast<std::string>(), phy::version));
  // Without the packing: the recipe makes it again if somebody asks for discs.
  auto test = std::make_shared<Test>();
  test->recipe = std::make_shared<const Recipe>(t[1].cast<Recipe>());
  TestResult& r = test->result;
  // The kind is a place in this process's list, so it comes from the recipe.
  r.kind = test->recipe->test.kind;
  r.name = t[2].cast<std::string>(), r.intact = t[3].cast<bool>(), r.theta = t[4].cast<double>();
  r.outcome = {status_of(t[5].cast<std::string>()).value(), t[6].cast<std::string>(),
               t[7].cast<std::string>()};
  r.numbers = t[8].cast<std::vector<Number>>();
  r.history.rows = rows_from<HistoryRow>(t[9]), r.cracks = rows_from<CrackEvent>(t[10]);
  for (const py::handle pair : t[11]) {
    const auto both = pair.cast<py::tuple>();
    r.snapshots.emplace_back();
    r.snapshots.back().grains = rows_from<GrainState>(both[0]);
    r.snapshots.back().contacts = rows_from<ContactState>(both[1]);
  }
  r.n_steps = t[12].cast<std::int64_t>(), r.seconds = t[13].cast<double>(),
  r.hash = t[14].cast<std::string>();
  return test;
}

// --- classes

using SpecimenClass = py::class_<Test, std::shared_ptr<Test>>;

void add_number(py::module_& m) {
  py::class_<Number>(m, "Number", "A number of a result, with its unit and the definition used.")
      .def_readonly("name", &Number::name, R"("ucs", "E_tangent" ...)")
      .def_readonly("value", &Number::value, "SI; NaN: could not be determined, see note.")
      .def_readonly("unit", &Number::unit, "Its unit.")
      .def_readonly("definition", &Number::definition, "How it is read from the test.")
      .def_readonly("note", &Number::note, "Why there is no value, or what to keep in mind.")
      .def_readonly("upper_bound", &Number::upper_bound, "The value is one; the note says why.")
      .def(py::pickle([](const Number& n) { return state_of(n); }, &number_from))
      // So that a number can be used in a formula as it is.
      .def("__float__", [](const Number& n) { return n.value; })
      .def("__repr__", [](const Number& n) { return n.name + " = " + print_number(n.value) + " " + n.unit; });
}

/// What it is, and how its test ended.
void add_outcome(SpecimenClass& specimen) {
  specimen
      .def_property_readonly(
          "name", [](const Test& t) { return t.result.name; }, R"("theta = 30 deg", "intact".)")
      .def_property_readonly(
          // NaN, as 0 would be an angle.
          "theta", [](const Test& t) { return t.result.intact ? std::nan("") : t.result.theta; },
          "Inclination of the bedding [deg]; NaN of intact rock.")
      .def_property_readonly(
          "intact", [](const Test& t) { return t.result.intact; }, "Without bedding.")
      .def_property_readonly(
          "status", [](const Test& t) { return to_string(t.result.outcome.status); },
          R"(How the test ended: "peaked", "not peaked", ... (docs/formats.md, result.json).)")
      .def_property_readonly(
          "has_strength", [](const Test& t) { return has_strength(t.result.outcome.status); },
          "It has found a strength that can be trusted.")
      .def_property_readonly(
          "reason", [](const Test& t) { return t.result.outcome.reason; }, "What happened, with numbers.")
      .def_property_readonly(
          "advice", [](const Test& t) { return t.result.outcome.advice; },
          "Which setting to change; empty when all went well.")
      .def_property_readonly("numbers", &numbers_of, "All numbers of the test by name, as Number.")
      .def_property_readonly(
          "hash", [](const Test& t) { return t.result.hash; },
          "Over the bits of history, cracks and final positions, as the program's.")
      .def_property_readonly(
          "n_steps", [](const Test& t) { return t.result.n_steps; }, "Cycles.")
      .def_property_readonly(
          "seconds", [](const Test& t) { return t.result.seconds; }, "CPU time [s].")
      .def("__repr__", [](const Test& t) {
        return "<phyllite.Specimen " + t.result.name + ", " + to_string(t.result.outcome.status) + ">";
      });
}

/// Arrays over the memory of the result.
void add_series(SpecimenClass& specimen) {
  specimen
      .def_property_readonly("columns", &columns_of, "Name, unit and meaning of each column of the history.")
      .def_property_readonly(
          "history",
          [](const py::object& self) {
            const TestResult& r = self.cast<Test&>().result;
            // `self` keeps the result alive as long as an array over its memory is used.
            return view_of(r.history.rows, history_members(r), self);
          },
          "One row per test.history_interval cycles, a field per column: history[\"axial_stress\"].")
      .def_property_readonly(
          "cracks",
          [](const py::object& self) {
            return view_of(self.cast<Test&>().result.cracks, crack_members(), self);
          },
          "One row per broken bond or joint: step, time [s], strain, grain_a, grain_b, x, y [m], normal_x, "
          "normal_y, size [m], energy [J per m]. Its mode is 0 in tension and 1 in shear. Its place is 0 in "
          "the matrix and 1 in the bedding.")
      .def_property_readonly(
          "discs",
          [](const py::object& self) {
            return view_of(packing_of(self.cast<Test&>()).discs, disc_members, self);
          },
          "The discs of the packing before the test: x, y, r [m], from the lower left corner.")
      .def_property_readonly(
          "grains",
          [](const py::object& self) {
            return view_of(last_state(self.cast<Test&>()).grains, grain_members, self);
          },
          "How far the discs have moved at the end: ux, uy [m], rotation [rad]. IoError of a result that was "
          "loaded: no folder keeps it.")
      .def_property_readonly(
          "contacts",
          [](const py::object& self) {
            return view_of(last_state(self.cast<Test&>()).contacts, contact_members(), self);
          },
          "Contacts at the end: grain_a, grain_b, kind (0 touching, 1 bonded, 2 joint), broken, F_n, F_s "
          "[N/m], normal_x, normal_y. IoError of a result that was loaded.");
}

}  // namespace

void add_specimens(py::module_& m) {
  add_number(m);
  SpecimenClass specimen(m, "Specimen", R"(A specimen after its test.

Arrays lie in the memory of the result: nothing is copied, nothing can be written to. SI units; compression
and shortening positive.)");
  add_outcome(specimen), add_series(specimen);
  specimen.def_property_readonly(
      "recipe", [](const Test& t) { return *t.recipe; }, "The recipe of its run.");
  specimen.def(py::pickle([](const Test& t) { return state_of(t); }, &test_from));
  m.def("load_run", &load_run, py::arg("folder"));
  m.def("run_figure", &run_figure, py::arg("tests"), py::arg("kind"), py::arg("rock"));
}

}  // namespace phy::python
