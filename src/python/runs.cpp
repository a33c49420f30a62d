// Running recipes: tests under the press, the direct elastic solution, one contact on the bench; and the
// results, whose series are arrays over the memory that they lie in.
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>

#include "base/units.hpp"
#include "base/version.hpp"
#include "genesis/cache.hpp"
#include "genesis/specimen.hpp"
#include "io/file.hpp"
#include "io/new_folder.hpp"
#include "io/output.hpp"
#include "io/store.hpp"
#include "jobs/contact_words.hpp"
#include "jobs/machine.hpp"
#include "jobs/run_folder.hpp"
#include "lab/load_path.hpp"
#include "lab/scene_room.hpp"
#include "python/arrays.hpp"
#include "python/module.hpp"
#include "python/released.hpp"
#include "records/jointed.hpp"
#include "records/test_description.hpp"
#include "study/elastic_study.hpp"
#include "study/worker.hpp"
#include "verification/contact_witness.hpp"

namespace phy::python {
namespace {

using Specimens = std::vector<std::shared_ptr<const Specimen>>;

/// A finished test with what it was made on.
struct Test {
  TestResult result;
  std::shared_ptr<const Specimen> specimen;
};

const Snapshot no_snapshot{};
const Snapshot& last_state(const Test& test) {
  return test.result.snapshots.empty() ? no_snapshot : test.result.snapshots.back();
}

std::vector<Member> history_members(const TestResult& result) {
  const HistoryRow row;
  std::vector<Member> members;
  for (const HistoryColumn& c : result.kind->columns)
    members.push_back({c.name, "f8",
                       static_cast<std::size_t>(reinterpret_cast<const char*>(&(row.*c.value)) -
                                                reinterpret_cast<const char*>(&row))});
  return members;
}

const std::vector<Member>& crack_members() {
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
  py::dict numbers = py::module_::import("phyllite.names").attr("Numbers")();
  for (const Number& n : t.result.numbers) numbers[py::str(n.name)] = n;
  return numbers;
}

/// Runs the tests; with a folder, what the command leaves in it.
std::vector<TestResult> press(const Recipe& recipe, const Specimens& specimens, const std::string& folder,
                              int threads, Watch& watch) {
  study::Hooks hooks;
  hooks.stop = &watch.stop;
  hooks.on_progress = [&](const study::Progress& p) {
    watch.show(
        {std::to_string(p.n_done) + "/" + std::to_string(p.n_total) + " specimens", p.n_done, p.n_total});
  };
  hooks.on_result = [&](std::size_t i, const TestResult& r) {
    if (r.outcome.status == Status::interrupted) return;
    if (!folder.empty())
      io::write_result((std::filesystem::path(folder) / io::folder_name(r.name)).string(), recipe,
                       phy::version, *specimens[i], r);
    watch.say(r.name + ": " + r.outcome.reason);
  };
  return study::run_tests(specimens, recipe, jobs::machine_of(threads), hooks);
}

std::vector<std::shared_ptr<Test>> run(const Recipe& recipe, const std::string& folder, bool replace,
                                       int threads, const py::object& progress) {
  Specimens specimens;
  std::vector<TestResult> results;
  run_released(progress, [&](Watch& watch) {
    std::optional<jobs::ResultFolder> place;
    if (!folder.empty()) {
      std::vector<Problem> problems = jobs::run_folder_problems(folder, recipe, "recipe", replace);
      if (!problems.empty()) throw InputError(std::move(problems));
      io::check_outputs({jobs::page_of(folder)});
      place.emplace(folder);
    }
    const auto packing =
        genesis::packing_of(recipe, genesis::default_cache_folder(), [&] { return watch.stop.load(); });
    for (Specimen& s : genesis::make_specimens(packing, recipe))
      specimens.push_back(std::make_shared<const Specimen>(std::move(s)));
    lab::check_load_path(*specimens.front(), recipe);
    lab::check_scene_room(*specimens.front(), recipe);
    if (place && replace)
      for (const auto& [other, differences] : jobs::results_of_others(folder, recipe))
        io::remove_folder(other);
    results = press(recipe, specimens, folder, threads, watch);
    const bool any = std::any_of(results.begin(), results.end(),
                                 [](const TestResult& r) { return r.outcome.status != Status::interrupted; });
    if (place && any) jobs::write_run_report(folder, results);
  });
  std::vector<std::shared_ptr<Test>> tests;
  for (std::size_t i = 0; i < results.size(); ++i)
    tests.push_back(std::make_shared<Test>(Test{std::move(results[i]), specimens[i]}));
  return tests;
}

py::dict elastic_row(const study::ElasticStudy& s, std::size_t i) {
  const ElasticResult &one = s.one_sided[i], &both = s.bilateral[i];
  py::dict row;
  row["name"] = one.name;
  row["theta"] = layered(s.specimens[i]) ? s.theta(i) : std::nan("");
  row["E"] = one.E_gauge, row["nu"] = one.nu_gauge, row["E_platen"] = one.E_platen;
  row["E_pulling"] = both.E_gauge, row["nu_pulling"] = both.nu_gauge;
  row["n_open"] = one.n_open, row["n_contacts"] = one.n_contacts, row["n_loose"] = one.n_loose;
  row["solved"] = one.outcome.ok() && both.outcome.ok();
  row["reason"] = one.outcome.reason.empty() ? both.outcome.reason : one.outcome.reason;
  return row;
}

py::list sensitivities_of(const study::ElasticStudy& s) {
  py::list rows;
  for (const ElasticResult& r : s.one_sided)
    for (const Sensitivity& d : r.sensitivities) {
      py::dict row;
      row["name"] = r.name, row["parameter"] = d.parameter, row["unit"] = d.unit, row["value"] = d.value;
      row["dE"] = d.dE, row["dnu"] = d.dnu;
      rows.append(row);
    }
  return rows;
}

/// Eq. 1 through E(theta), where the specimens are jointed rock.
py::list joint_fits(const study::ElasticStudy& s, theory::Eq1Loss loss) {
  py::list rows;
  if (s.n_angles() == 0 || !jointed_isotropic(s.recipe)) return rows;
  const BeddingRecipe& set = s.recipe.bedding[0];
  const double spacing = set.has_planes() ? set.spacing : std::nan("");
  for (const study::NamedFit& f : study::fit_all(s, loss)) {
    py::dict row;
    const auto number = [&](double v) { return f.fit.ok() ? v : std::nan(""); };
    row["name"] = f.name, row["reason"] = f.fit.reason, row["E"] = number(f.fit.rock.E);
    row["K_n_delta"] = number(f.fit.rock.K_n_delta), row["K_s_delta"] = number(f.fit.rock.K_s_delta);
    row["K_n"] = number(f.fit.rock.K_n_delta / spacing), row["K_s"] = number(f.fit.rock.K_s_delta / spacing);
    row["R2"] = number(f.fit.R2);
    rows.append(row);
  }
  return rows;
}

py::tuple elastic(const Recipe& recipe, bool glued, bool modulus_loss, int threads,
                  const py::object& progress) {
  study::ElasticStudy found;
  run_released(progress, [&](Watch& watch) {
    found = study::solve_recipe(recipe, glued ? statics::Platens::glued : statics::Platens::frictionless,
                                jobs::n_threads(threads), &watch.stop);
  });
  py::list rows;
  for (std::size_t i = 0; i < found.specimens.size(); ++i) rows.append(elastic_row(found, i));
  return py::make_tuple(
      rows, sensitivities_of(found),
      joint_fits(found, modulus_loss ? theory::Eq1Loss::modulus : theory::Eq1Loss::compliance));
}

/// A step on the bench, with the closed form beside it.
struct BenchStep {
  double closure, slide, rotation, F_n, F_s, M, F_n_exact, F_s_exact, M_exact, dissipated, released, stored,
      broke;
};

std::vector<ContactPoint> path_of(const py::object& path, std::vector<Problem>& problems) {
  if (path.is_none()) return jobs::default_path();
  std::vector<ContactPoint> corners;
  for (const py::handle corner : path) {
    if (py::isinstance<py::str>(corner)) {
      corners.push_back(jobs::read_corner(corner.cast<std::string>(), problems));
      continue;
    }
    const auto p = corner.cast<std::vector<double>>();
    const bool good = (p.size() == 2 || p.size() == 3) &&
                      std::all_of(p.begin(), p.end(), [](double v) { return std::isfinite(v); });
    if (good)
      corners.push_back({p[0], p[1], p.size() == 3 ? p[2] : 0.0});
    else
      problems.push_back({"contact", "path", py::repr(corner).cast<std::string>(),
                          "two or three finite numbers: closure [m], slide [m], rotation [rad]", ""});
  }
  if (corners.empty() && problems.empty())
    problems.push_back(
        {"contact", "path", "[]", "at least one corner", "leave it out for a path that shows all"});
  return corners;
}

py::array contact(const std::string& name, const py::object& path, const std::vector<std::string>& values,
                  int steps) {
  const lab::LawInfo& law = jobs::find_law(name);
  std::vector<Problem> problems;
  const std::vector<double> v = jobs::parameters_of(law, values, problems);
  const std::vector<ContactPoint> corners = path_of(path, problems);
  if (steps < 1 || steps > 10'000'000)
    problems.push_back({"contact", "steps", std::to_string(steps), "1 to 10000000", ""});
  if (!problems.empty()) throw InputError(std::move(problems));
  const auto bench = lab::bench_contact(law.name, v);
  const std::vector<lab::BenchRow> rows = lab::drive(*bench, corners, steps);
  const std::vector<ContactForces> exact = verification::witness(law.name, v, corners, steps);
  PHY_CHECK(exact.size() == rows.size(), "every law of the list has a closed form");
  std::vector<BenchStep> all;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const lab::BenchRow& r = rows[i];
    all.push_back({r.at.closure, r.at.slide, r.at.rotation, r.forces.F_n, r.forces.F_s, r.forces.M,
                   exact[i].F_n, exact[i].F_s, exact[i].M, r.dissipated, r.released, r.stored,
                   static_cast<double>(r.broke)});
  }
  std::vector<Member> members;
  for (const char* column : {"closure", "slide", "rotation", "F_n", "F_s", "M", "F_n_exact", "F_s_exact",
                             "M_exact", "dissipated", "released", "stored", "broke"})
    members.push_back({column, "f8", members.size() * sizeof(double)});
  return array_of(std::move(all), members);
}

py::list contact_laws() {
  py::list laws;
  for (const lab::LawInfo& law : lab::law_infos()) {
    py::list parameters;
    for (const laws::ParameterInfo& p : law.parameters)
      parameters.append(py::make_tuple(p.name, p.unit, p.typical, p.min, p.max, p.meaning, p.pfc_name));
    laws.append(py::make_tuple(law.name, law.sentence, parameters));
  }
  return laws;
}

using SpecimenClass = py::class_<Test, std::shared_ptr<Test>>;

void add_number(py::module_& m) {
  py::class_<Number>(m, "Number", "A number of a result, with its unit and the definition used.")
      .def_readonly("name", &Number::name, R"("ucs", "E_tangent" ...)")
      .def_readonly("value", &Number::value, "SI; NaN: could not be determined, see note.")
      .def_readonly("unit", &Number::unit, "Its unit.")
      .def_readonly("definition", &Number::definition, "How it is read from the test.")
      .def_readonly("note", &Number::note, "Why there is no value, or what to keep in mind.")
      .def_readonly("upper_bound", &Number::upper_bound, "The value is one; the note says why.")
      .def("__float__", [](const Number& n) { return n.value; })
      .def("__repr__", [](const Number& n) { return n.name + " = " + print_number(n.value) + " " + n.unit; });
}

/// What it is, and how its test ended.
void add_outcome(SpecimenClass& specimen) {
  specimen
      .def_property_readonly(
          "name", [](const Test& t) { return t.result.name; }, R"("theta = 30 deg", "intact".)")
      .def_property_readonly(
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
            return view_of(self.cast<Test&>().specimen->packing->discs, disc_members, self);
          },
          "The discs of the packing before the test: x, y, r [m], from the lower left corner.")
      .def_property_readonly(
          "grains",
          [](const py::object& self) {
            return view_of(last_state(self.cast<Test&>()).grains, grain_members, self);
          },
          "How far the discs have moved at the end: ux, uy [m], rotation [rad].")
      .def_property_readonly(
          "contacts",
          [](const py::object& self) {
            return view_of(last_state(self.cast<Test&>()).contacts, contact_members(), self);
          },
          "Contacts at the end: grain_a, grain_b, kind (0 touching, 1 bonded, 2 joint), broken, F_n, F_s "
          "[N/m], normal_x, normal_y.");
}

}  // namespace

void add_runs(py::module_& m) {
  add_number(m);
  SpecimenClass specimen(m, "Specimen", R"(A specimen after its test.

Arrays lie in the memory of the result: nothing is copied, nothing can be written to. SI units; compression
and shortening positive.)");
  add_outcome(specimen), add_series(specimen);
  m.def("run", &run, py::arg("recipe"), py::arg("folder"), py::arg("replace"), py::arg("threads"),
        py::arg("progress"));
  m.def("elastic", &elastic, py::arg("recipe"), py::arg("glued"), py::arg("modulus_loss"), py::arg("threads"),
        py::arg("progress"));
  m.def("contact", &contact, py::arg("law"), py::arg("path"), py::arg("values"), py::arg("steps"));
  m.def("contact_laws", &contact_laws);
}

}  // namespace phy::python
