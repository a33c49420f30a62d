#include "jobs/design_job.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "analysis/analyse.hpp"
#include "base/check.hpp"
#include "base/units.hpp"
#include "calibrate/discrepancy.hpp"
#include "calibrate/elastic_response.hpp"
#include "calibrate/posterior_ensemble.hpp"
#include "calibrate/strength_tests.hpp"
#include "design/sheet.hpp"
#include "io/file.hpp"
#include "io/output.hpp"
#include "io/toml_in.hpp"
#include "jobs/ensemble.hpp"
#include "jobs/report.hpp"
#include "records/jointed.hpp"
#include "study/envelope.hpp"
#include "study/experiment.hpp"

namespace phy::jobs {
namespace {

namespace fs = std::filesystem;
using design::DrawTests;

/// Directions in which the elasticity of a specimen is seen: cheap, so that these do not depend on the table.
constexpr double elastic_angles[] = {0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 90.0};
constexpr double ends[] = {0.0, 90.0};

/// A specimen of a draw at an inclination, on the draw's own packing.
Recipe turned(const Recipe& draw, double theta) {
  return calibrate::single_at(draw, theta, draw.packing.seed);
}

std::vector<Recipe> elastic_recipes(const std::vector<Recipe>& draws) {
  std::vector<Recipe> recipes;
  for (const Recipe& draw : draws)
    for (const double theta : elastic_angles) recipes.push_back(turned(draw, theta));
  return recipes;
}

/// Direct tension across the planes and along them. Strengths are expected from those of bonds and joints, so
/// that grips move as slowly as the rock breaks early.
std::vector<Recipe> tension_recipes(const Recipe& draw, const std::vector<double>& moduli) {
  std::vector<Target> targets;
  for (const double theta : ends) {
    Target t;
    t.property = Property::direct_tension, t.theta = theta;
    const bool joints = theta == 0.0 && !draw.bedding.empty() && !draw.bedding.front().unjointed();
    t.mean = joints ? std::min(draw.bedding.front().sigma_n, draw.matrix.sigma_c) : draw.matrix.sigma_c;
    targets.push_back(t);
  }
  const calibrate::StrengthTests tests(draw, targets, moduli);
  std::vector<Recipe> recipes;
  for (std::size_t i = 0; i < targets.size(); ++i)
    recipes.push_back(tests.of(draw, i, draw.packing.seed, calibrate::from_rest));
  return recipes;
}

/// Under the stresses that are asked for, and where the table has strengths.
std::vector<Recipe> compression_recipes(const Recipe& draw, const std::vector<double>& stresses,
                                        const std::vector<Target>& cells) {
  std::vector<Recipe> recipes;
  const auto asked = [&](const Target& t) {
    return std::find(stresses.begin(), stresses.end(), t.confining) != stresses.end() &&
           std::find(draw.test.angles.begin(), draw.test.angles.end(), t.theta) != draw.test.angles.end();
  };
  for (const Target& t : cells)
    if (!asked(t)) recipes.push_back(turned(study::confined_recipe(draw, t.confining), t.theta));
  for (const double stress : stresses)
    for (Recipe& single : study::single_recipes(study::confined_recipe(draw, stress)))
      // Rock between the layers is none of what a continuum is made of.
      if (layered(single)) recipes.push_back(std::move(single));
  return recipes;
}

/// NaN: it has not come to a strength.
double strength_of(const TestResult& result, Property property) {
  return calibrate::strength_of(result, property);
}

/// The elastic part of every draw.
std::vector<DrawTests> elasticity_of(const std::vector<ElasticResult>& results, std::size_t n_draws) {
  std::vector<DrawTests> draws(n_draws);
  constexpr std::size_t n = std::size(elastic_angles);
  for (std::size_t i = 0; i < results.size(); ++i)
    draws[i / n].elasticity.push_back(
        {elastic_angles[i % n], results[i].outcome.ok() ? results[i].E_gauge : nan, results[i].nu_gauge});
  return draws;
}

/// Whose test a recipe is.
struct Asked {
  std::size_t draw;
  bool tension;
};

void add_strengths(std::vector<DrawTests>& draws, const std::vector<Asked>& asked,
                   const std::vector<Recipe>& recipes, const std::vector<TestResult>& results) {
  for (std::size_t i = 0; i < results.size(); ++i) {
    const Property property = asked[i].tension ? Property::direct_tension : Property::confined;
    const double strength = strength_of(results[i], property);
    if (!std::isfinite(strength) || !(strength > 0.0)) continue;
    DrawTests& draw = draws[asked[i].draw];
    (asked[i].tension ? draw.tension : draw.compression)
        .push_back({results[i].theta, strength, asked[i].tension ? 0.0 : recipes[i].test.confining_stress});
  }
}

/// Residuals of the calibration with what its draws miss in tests, not by the search's stand-in for them.
std::vector<StrengthResidual> residuals_of(const DesignPlan& plan, const std::vector<DrawTests>& draws) {
  std::vector<StrengthResidual> residuals;
  for (StrengthResidual r : plan.calibration.residuals) {
    if (!is_compressive(r.target.property)) continue;
    r.of_draws.clear();
    for (const DrawTests& draw : draws) {
      const auto test = std::find_if(draw.compression.begin(), draw.compression.end(), [&](const auto& p) {
        return p.theta == r.target.theta && p.sigma_3 == r.target.confining;
      });
      // A draw without a strength there is corrected as the estimate is.
      r.of_draws.push_back(test != draw.compression.end() ? std::log(r.target.mean / test->ucs) : r.value);
    }
    residuals.push_back(std::move(r));
  }
  return residuals;
}

/// From the model's strengths to the rock's: a draw that is too strong is brought back, angle by angle and
/// stress by stress.
void correct(std::vector<DrawTests>& draws, const DesignPlan& plan) {
  if (plan.cells.empty()) return;
  const calibrate::Discrepancy discrepancy(residuals_of(plan, draws));
  for (std::size_t k = 0; k < draws.size(); ++k) {
    double variance = 0.0;
    for (design::StrengthPoint& p : draws[k].compression) {
      Target t;
      t.property = Property::confined, t.theta = p.theta, t.confining = p.sigma_3;
      const calibrate::Discrepancy::Term term = discrepancy.at(t);
      p.ucs *= std::exp(discrepancy.of_draw(term, k));
      variance += term.variance / static_cast<double>(draws[k].compression.size());
    }
    // Smooth over the angles and stresses: taken as one factor on all of them.
    draws[k].unknown_factor = std::sqrt(variance);
  }
}

/// Leaves the stresses that were asked for: others were tested for the sake of the table alone.
void keep_asked(std::vector<DrawTests>& draws, const std::vector<double>& stresses) {
  for (DrawTests& draw : draws)
    std::erase_if(draw.compression, [&](const design::StrengthPoint& p) {
      return std::find(stresses.begin(), stresses.end(), p.sigma_3) == stresses.end();
    });
}

/// A row per test.
std::string tests_csv(const design::DesignTests& tests) {
  std::string text = "draw,test,theta [deg],sigma_3 [Pa],number,simulated,corrected,unit\n";
  const auto row = [&](std::size_t k, const char* test, double theta, const std::string& stress,
                       const char* number, double value, const char* unit,
                       const std::string& corrected = "") {
    text += fmt::format("{},{},{},{},{},{},{},{}\n", k + 1, test, print_number(theta), stress, number,
                        print_number(value), corrected, unit);
  };
  for (std::size_t k = 0; k < tests.draws.size(); ++k) {
    for (const design::ElasticPoint& p : tests.draws[k].elasticity)
      row(k, "elastic", p.theta, "", "E", p.E, "Pa"), row(k, "elastic", p.theta, "", "nu", p.nu, "1");
    const design::StrengthPoints& compression = tests.draws[k].compression;
    for (std::size_t i = 0; i < compression.size(); ++i) {
      const design::StrengthPoint& p = compression[i];
      row(k, "biaxial", p.theta, print_number(p.sigma_3), "sigma_1", tests.simulated[k].compression[i].ucs,
          "Pa", tests.of_rock ? print_number(p.ucs) : "");
    }
    for (const design::StrengthPoint& p : tests.draws[k].tension)
      row(k, "direct_tension", p.theta, "", "sigma_t", p.ucs, "Pa");
  }
  return text;
}

std::string recipe_of(const std::string& calibration) {
  return fs::is_directory(calibration) ? (fs::path(calibration) / "calibrated.toml").string() : calibration;
}

std::vector<Target> table_of(const Calibration& calibration) {
  std::vector<Target> table;
  for (const Comparison& c : calibration.fitted) table.push_back(c.target);
  return table;
}

/// Tests that the table leaves open, as the verdict names them.
std::vector<std::string> undetermined_of(const Calibration& calibration) {
  std::vector<std::string> names;
  for (const Finding& f : calibration.verdict.not_good_for)
    if (f.kind == FindingKind::test_undetermined) names.push_back(f.names.front());
  return names;
}

/// Every file that a design may leave.
std::vector<std::string> files_in(const std::string& folder) {
  std::vector<std::string> names = {"design.csv", "covariance.csv", "tests.csv", "design.json",
                                    "report.html"};
  for (const design::Code& code : design::codes()) names.emplace_back(code.file);
  for (std::string& name : names) name = (fs::path(folder) / name).string();
  return names;
}

using Files = std::vector<std::pair<std::string, std::string>>;

/// What an earlier design in the folder left, and this one has no constants for, would be of another rock.
void remove_others(const std::string& folder, const Files& files) {
  for (const std::string& file : files_in(folder)) {
    const std::string name = fs::path(file).filename().string();
    const bool written =
        std::any_of(files.begin(), files.end(), [&](const auto& f) { return f.first == name; });
    // Changed by hand, it is no longer the program's.
    std::error_code none;
    if (!written && io::is_as_written(folder, name)) fs::remove(file, none);
  }
}

}  // namespace

std::size_t DesignPlan::n_tests() const {
  std::size_t n = 0;
  if (!sought) return n;
  for (const Recipe& draw : draws)
    n += std::size(ends) + compression_recipes(draw, request.stresses, cells).size();
  return n;
}

DesignPlan plan_design(const DesignRequest& request) {
  const std::string path = recipe_of(request.calibration);
  DesignPlan plan{request, io::read_recipe(path), {}, {}, {}};
  if (!layered(plan.recipe))
    throw InputError(Problem{path, "design", "", "a rock with layers",
                             "`phyllite envelope --ensemble` gives c, phi and m_i of a rock without any"});
  std::vector<Recipe> draws = read_draws(path, plan.recipe, "design");
  const std::size_t n = request.n_draws == 0 ? draws.size() : request.n_draws;
  if (n < fewest_draws || n > draws.size())
    throw InputError(Problem{"command line", "--draws", fmt::format("{}", n),
                             fmt::format("{} to {} draws", fewest_draws, draws.size()), ""});
  for (std::size_t k = 0; k < n; ++k) {
    plan.draws.push_back(draws[k * (draws.size() - 1) / (n - 1)]);
  }
  plan.calibration = read_judged(fs::path(path).parent_path().string());
  plan.sought = first_of(plan.calibration.verdict.not_good_for, FindingKind::strengths_of_recipe) == nullptr;
  for (const StrengthResidual& r : plan.calibration.residuals)
    if (!request.model_alone && is_compressive(r.target.property)) plan.cells.push_back(r.target);
  if (holds_calibration(request.out))
    throw InputError(Problem{"command line", "--out", request.out, "",
                             "it holds a calibration, and a design has a folder of its own"});
  io::check_outputs(files_in(request.out));
  io::check_writable(request.out);
  return plan;
}

design::Design run_design(const DesignPlan& plan, calibrate::Simulator& simulator) {
  const std::vector<ElasticResult> elastic =
      simulator.elastic(elastic_recipes(plan.draws), calibrate::Statics::one_sided);
  design::DesignTests tests{.rock = plan.calibration.rock,
                            .weak_planes = has_weak_planes(plan.recipe),
                            .stresses = plan.request.stresses,
                            .draws = elasticity_of(elastic, plan.draws.size()),
                            .laboratory = table_of(plan.calibration),
                            .E_is = plan.calibration.E_is,
                            .reading = plan.request.reading,
                            .of_rock = !plan.cells.empty(),
                            .strengths_sought = plan.sought,
                            .undetermined = undetermined_of(plan.calibration),
                            .dip = plan.request.dip};
  std::vector<Recipe> recipes;
  std::vector<Asked> asked;
  for (std::size_t k = 0; plan.sought && k < plan.draws.size(); ++k) {
    const auto& seen = tests.draws[k].elasticity;
    // Only the speed of the grips hangs on it, where a specimen has no solution.
    const auto modulus = [&](double E) { return E > 0.0 ? E : plan.draws[k].matrix.modulus(); };
    for (Recipe& r : tension_recipes(plan.draws[k], {modulus(seen.front().E), modulus(seen.back().E)}))
      recipes.push_back(std::move(r)), asked.push_back({k, true});
    for (Recipe& r : compression_recipes(plan.draws[k], plan.request.stresses, plan.cells))
      recipes.push_back(std::move(r)), asked.push_back({k, false});
  }
  add_strengths(tests.draws, asked, recipes, simulator.test(recipes));
  tests.n_without_strength = recipes.size();
  for (const DrawTests& draw : tests.draws)
    tests.n_without_strength -= draw.compression.size() + draw.tension.size();
  tests.simulated = tests.draws;
  correct(tests.draws, plan);
  keep_asked(tests.draws, plan.request.stresses), keep_asked(tests.simulated, plan.request.stresses);
  return design::design_of(std::move(tests));
}

std::vector<std::string> write_design(const std::string& folder, const design::Design& design) {
  const design::Values values = design.values();
  Files files = {{"design.csv", design::constants_csv(values)},
                 {"covariance.csv", design::covariance_csv(values)},
                 {"tests.csv", tests_csv(design.tests)},
                 {"design.json", design::sheet_json(design).dump(1)},
                 {"report.html", design::sheet_page(design)}};
  for (const design::Code& code : design::codes())
    if (auto text = design::file_of(code, values, design.tests.rock)) files.emplace_back(code.file, *text);
  std::vector<std::string> names;
  remove_others(folder, files);
  for (const auto& [name, text] : files)
    io::write_output((fs::path(folder) / name).string(), text), names.push_back(name);
  return names;
}

}  // namespace phy::jobs
