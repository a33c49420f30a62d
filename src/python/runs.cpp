// Running recipes: tests under the press, the direct elastic solution, one contact on the bench.
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
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
#include "python/specimens.hpp"
#include "records/jointed.hpp"
#include "study/elastic_study.hpp"
#include "study/worker.hpp"
#include "verification/contact_witness.hpp"

namespace phy::python {
namespace {

using Specimens = std::vector<std::shared_ptr<const Specimen>>;

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
    // An interrupted test would stand beside finished ones as if it were a result.
    if (r.outcome.status == Status::interrupted) return;
    if (!folder.empty())
      io::write_result((std::filesystem::path(folder) / io::folder_name(r.name)).string(), recipe,
                       phy::version, *specimens[i], r);
    watch.say(r.name + ": " + r.outcome.reason);
  };
  return study::run_tests(specimens, recipe, jobs::machine_of(threads), hooks);
}

Tests run(const Recipe& recipe, const std::string& folder, bool replace, int threads,
          const py::object& progress) {
  Specimens specimens;
  std::vector<TestResult> results;
  run_released(progress, [&](Watch& watch) {
    std::optional<jobs::ResultFolder> place;
    if (!folder.empty()) {
      std::vector<Problem> problems = jobs::run_folder_problems(folder, recipe, "recipe", replace);
      if (!problems.empty()) throw InputError(std::move(problems));
      io::check_outputs({jobs::page_of(folder)});
      // Goes away with this call where nothing has come into it.
      place.emplace(folder);
    }
    const auto packing =
        genesis::packing_of(recipe, genesis::default_cache_folder(), [&] { return watch.stop.load(); });
    for (Specimen& s : genesis::make_specimens(packing, recipe))
      specimens.push_back(std::make_shared<const Specimen>(std::move(s)));
    // As the command checks, before hours: pressing a specimen that carries nothing would only time out.
    lab::check_load_path(*specimens.front(), recipe);
    lab::check_scene_room(*specimens.front(), recipe);
    // Only now that all checks have passed are older results removed.
    if (place && replace)
      for (const auto& [other, differences] : jobs::results_of_others(folder, recipe))
        io::remove_folder(other);
    results = press(recipe, specimens, folder, threads, watch);
    const bool any = std::any_of(results.begin(), results.end(),
                                 [](const TestResult& r) { return r.outcome.status != Status::interrupted; });
    if (place && any) jobs::write_run_report(folder, results);
  });
  // One copy for all specimens: a recipe may hold long lists.
  const auto own = std::make_shared<const Recipe>(recipe);
  Tests tests;
  for (std::size_t i = 0; i < results.size(); ++i)
    tests.push_back(std::make_shared<Test>(Test{std::move(results[i]), own, specimens[i]->packing}));
  return tests;
}

py::dict elastic_row(const study::ElasticStudy& s, std::size_t i) {
  const ElasticResult &one = s.one_sided[i], &both = s.bilateral[i];
  py::dict row;
  row["name"] = one.name;
  // NaN, since a number would place intact rock among the angles.
  row["theta"] = layered(s.specimens[i]) ? s.theta(i) : std::nan("");
  row["E"] = one.E_gauge, row["nu"] = one.nu_gauge, row["E_platen"] = one.E_platen;
  // Pulling contacts make the model linear, the answer that Eq. 2 is fitted to.
  row["E_pulling"] = both.E_gauge, row["nu_pulling"] = both.nu_gauge;
  row["n_open"] = one.n_open, row["n_contacts"] = one.n_contacts, row["n_loose"] = one.n_loose;
  row["solved"] = one.outcome.ok() && both.outcome.ok();
  // Contacts that only push come first: they are what `E` is of.
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
  // Eq. 1 would fit other rock as well, with numbers that mean nothing.
  if (s.n_angles() == 0 || !jointed_isotropic(s.recipe)) return rows;
  const BeddingRecipe& set = s.recipe.bedding[0];
  // Dispersed joints have no spacing: K_n is NaN then, and only K_n delta is known.
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
// Doubles throughout, so that NumPy reads it as one table without padding.
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
      // Rotation may be left out: laws without bending have none.
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
  // The range of the command's --steps.
  if (steps < 1 || steps > 10'000'000)
    problems.push_back({"contact", "steps", std::to_string(steps), "1 to 10000000", ""});
  if (!problems.empty()) throw InputError(std::move(problems));
  const auto bench = lab::bench_contact(law.name, v);
  const std::vector<lab::BenchRow> rows = lab::drive(*bench, corners, steps);
  const std::vector<ContactForces> exact = verification::witness(law.name, v, corners, steps);
  // A law without its witness would leave columns of numbers that belong to nothing.
  PHY_CHECK(exact.size() == rows.size(), "every law of the list has a closed form");
  std::vector<BenchStep> all;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const lab::BenchRow& r = rows[i];
    all.push_back({r.at.closure, r.at.slide, r.at.rotation, r.forces.F_n, r.forces.F_s, r.forces.M,
                   exact[i].F_n, exact[i].F_s, exact[i].M, r.dissipated, r.released, r.stored,
                   static_cast<double>(r.broke)});
  }
  std::vector<Member> members;
  // In the order of the members of BenchStep: a name and its place are all that NumPy knows.
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

}  // namespace

void add_runs(py::module_& m) {
  m.def("run", &run, py::arg("recipe"), py::arg("folder"), py::arg("replace"), py::arg("threads"),
        py::arg("progress"));
  m.def("elastic", &elastic, py::arg("recipe"), py::arg("glued"), py::arg("modulus_loss"), py::arg("threads"),
        py::arg("progress"));
  m.def("contact", &contact, py::arg("law"), py::arg("path"), py::arg("values"), py::arg("steps"));
  m.def("contact_laws", &contact_laws);
}

}  // namespace phy::python
