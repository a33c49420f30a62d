#include "calibrate/strength_tests.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "analysis/analyse.hpp"
#include "analysis/failure_plane.hpp"
#include "base/check.hpp"
#include "base/nan.hpp"
#include "base/stats.hpp"
#include "calibrate/elastic_response.hpp"
#include "lab/brazilian/reading.hpp"
#include "records/test_description.hpp"
#include "study/expected.hpp"

namespace phy::calibrate {
namespace {

constexpr double coarse_factor = 2.5;       // magnification of the grains
constexpr double fewest_grains = 1000.0;    // of a coarse packing
constexpr double approach_speed = 3.0;      // over the speed of the test behind it
constexpr double least_foreseen = 0.1;      // of the strength in the table
constexpr double step_safety = 0.99;        // of a limit that is proven: nothing is kept in reserve
constexpr std::int64_t disc_interval = 25;  // steps between rows: a disc breaks in some 2,000 steps or more
constexpr double until_it_slides = 4.0;     // of the displacement at which bedding is expected to break
constexpr double start_of_shear = 0.05;     // of that displacement, while the boxes come to speed

/// Moduli of the recipe at the angles of the targets.
std::vector<double> moduli_at(const Recipe& recipe, const std::vector<Target>& targets, std::int64_t seed,
                              Simulator& simulator) {
  std::vector<Recipe> recipes;
  for (const Target& t : targets) recipes.push_back(single_at(recipe, t.theta, seed));
  std::vector<double> moduli;
  for (const ElasticResult& r : simulator.elastic(recipes, Statics::two_sided)) moduli.push_back(r.E_gauge);
  return moduli;
}

const TestDescription& test_of(Property property) {
  const char* const test = measured(property).test;
  PHY_CHECK(test != nullptr, "only properties that a test has are pressed");
  return *TestKind(test);
}

/// The recipe of a target's test: its kind, the size of its disc, the stress that it keeps.
Recipe tested_as(Recipe recipe, const Target& t) {
  const TestDescription& test = test_of(t.property);
  recipe.test.kind = test;
  if (t.diameter > 0.0) recipe.test.disc_diameter = t.diameter;
  if (test.kept_stress.value != nullptr) recipe.test.*test.kept_stress.value = t.confining;
  if (measured(t.property).along_bedding)
    for (BeddingRecipe& b : recipe.bedding) b.offset = 0.0;  // the boxes meet on a plane
  return recipe;
}

/// Strain at the peak that the table has, times the modulus of the specimen [Pa].
double strain_times_modulus(const Recipe& recipe, const Target& t) {
  return test_of(t.property)
      .peak_of_value.strain_times_modulus(tested_as(recipe, t), t.mean / measured(t.property).share,
                                          t.confining);
}

/// Strain at which each target is expected to peak: laboratory strength over the modulus of the recipe; of a
/// disc, the approach over the diameter.
std::vector<double> peak_strains(const Recipe& recipe, const std::vector<Target>& targets,
                                 const std::vector<double>& moduli) {
  std::vector<double> strains;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    const auto of_plane = test_of(targets[i].property).peak_of_value.strain_of_plane;
    strains.push_back(of_plane != nullptr ? of_plane(recipe, targets[i].mean)
                                          : strain_times_modulus(recipe, targets[i]) / moduli[i]);
  }
  return strains;
}

/// Speed of platens, grips or rollers [m/s] at which a wave crosses the specimen as often as its test asks
/// for, until it peaks at `strain`.
double slow_speed(const Recipe& recipe, const Target& target, double strain) {
  const double modulus = test_of(target.property).peak_of_value.strain_of_plane != nullptr
                             ? recipe.matrix.modulus()
                             : strain_times_modulus(recipe, target) / strain;
  const double wave = std::sqrt(modulus / recipe.matrix.density);
  // The height cancels: it is the way of the wave and the length that is strained. Two platens share the
  // speed.
  return 0.5 * strain * wave / test_of(target.property).peak_of_value.wave_transits;
}

/// The target in whose test another is read.
std::size_t place_of(const std::vector<Target>& targets, const Target& read) {
  Target in = read;
  in.property = *measured(read.property).read_in;
  const auto it =
      std::find_if(targets.begin(), targets.end(), [&](const Target& t) { return same_cell(t, in); });
  PHY_CHECK(it != targets.end(), "a table with the strength in whose test another is read");
  return static_cast<std::size_t>(it - targets.begin());
}

/// Tests go on to several times the strain at which the laboratory's strength is expected.
double largest_strain(double peak) { return std::max(0.01, 6.0 * peak); }

/// Did a Brazilian disc begin to break outside the central third?
bool is_invalid(const TestResult& result) {
  for (const char* place : {"first_crack_x", "first_crack_y"})
    if (const Number* n = analysis::find(result.numbers, place);
        n != nullptr && std::fabs(n->value) > lab::central_third)
      return true;
  return false;
}

/// NaN where a test has come to neither peak nor knee.
double number_of(const TestResult& result, const std::string& name) {
  if (!has_strength(result.outcome.status)) return std::nan("");
  const Number* n = analysis::find(result.numbers, name);
  return n != nullptr ? n->value : std::nan("");
}

/// Of the tests with a strength.
FailureMode failure_of(std::span<const TestResult> results) {
  std::vector<double> shares, angles;
  FailureMode mode;
  for (const TestResult& result : results) {
    if (!has_strength(result.outcome.status)) continue;
    const double share = number_of(result, "bedding_share"), angle = number_of(result, "failure_angle");
    // The mirror image of such a specimen is as likely.
    const bool alike = result.intact || result.theta == 0.0 || result.theta == 90.0;
    if (std::isfinite(share)) shares.push_back(share);
    if (std::isfinite(angle)) angles.push_back(alike ? std::fabs(angle) : angle);
    ++mode.n_tests;
  }
  const Summary share = summarise(shares);
  const analysis::MeanDirection direction = analysis::mean_direction(angles);
  mode.bedding_share = share.mean, mode.bedding_share_sd = share.sd;
  mode.angle = direction.angle, mode.angle_sd = direction.sd;
  mode.n_planes = static_cast<int>(angles.size());
  return mode;
}

/// A number of the same test on several packings; `number`: whose marks of quality count.
template <class Value>
Comparison over_packings(const Target& target, std::span<const TestResult> results, const std::string& number,
                         const Value& value_of) {
  std::vector<double> values;
  Comparison c;
  for (const TestResult& result : results) {
    const double value = value_of(result);
    if (std::isfinite(value)) {
      values.push_back(value);
      c.quality.add(result.numbers, number);
      c.n_invalid += is_invalid(result) ? 1 : 0;
    } else if (c.missing.empty()) {
      c.missing = result.outcome.reason + (result.outcome.advice.empty() ? "" : "; " + result.outcome.advice);
    }
  }
  const Summary s = summarise(values);
  c.target = target, c.mean = s.mean, c.sd = s.sd, c.n_packings = static_cast<int>(values.size());
  return c;
}

}  // namespace

Loadings of_verification(bool reads_moduli, std::vector<double> foreseen) {
  if (reads_moduli) return as_measured;
  return {as_measured, strengths_as_measured, std::move(foreseen)};
}

StrengthTests::StrengthTests(const Recipe& recipe, const std::vector<Target>& targets, std::int64_t seed,
                             Simulator& simulator)
    : StrengthTests(recipe, targets, moduli_at(recipe, targets, seed, simulator)) {}

StrengthTests::StrengthTests(const Recipe& recipe, const std::vector<Target>& targets,
                             const std::vector<double>& moduli)
    : targets_(targets),
      strains_(peak_strains(recipe, targets, moduli)),
      reads_before_(targets.size(), false) {
  for (std::size_t i = 0; i < targets_.size(); ++i)
    speeds_.push_back(slow_speed(recipe, targets_[i], strains_[i]));
  for (std::size_t i = 0; i < targets_.size(); ++i) {  // what is read on the way has no test of its own
    if (!measured(targets_[i].property).read_in) continue;
    // An approach would jump over sigma_ci, which lies well below the peak.
    const std::size_t test = place_of(targets_, targets_[i]);
    strains_[i] = strains_[test], speeds_[i] = speeds_[test];
    reads_before_[i] = reads_before_[test] = true;
  }
}

Recipe StrengthTests::of(const Recipe& recipe, std::size_t target, std::int64_t seed, const Loading& loading,
                         double foreseen) const {
  Recipe one = tested_as(single_at(recipe, targets_[target].theta, seed), targets_[target]);
  one.test.platen_speed = speeds_[target] * loading.speed;
  // A disc that a fast approach throws about has no strength: jaws meet it in points.
  const double share =
      one.test.kind->cut != nullptr ? std::min(loading.approach, as_measured.approach) : loading.approach;
  if (share > 0.0 && one.test.kind->may_approach && !reads_before_[target]) {
    const Target& t = targets_[target];
    const double weaker = std::clamp((foreseen - t.confining) / (t.mean - t.confining), least_foreseen, 1.0);
    if (const double until = share * weaker * strains_[target]; until > one.test.ramp_strain)
      one.test.approach_strain = until, one.test.approach_speed = approach_speed * one.test.platen_speed;
  }
  if (one.test.kind->cut != nullptr || one.test.kind->runs_to_end) one.test.history_interval = disc_interval;
  if (one.test.kind->runs_to_end) {
    one.test.max_strain = until_it_slides * strains_[target];
    one.test.ramp_strain = start_of_shear * strains_[target];
  } else if (targets_[target].confining > 0.0)
    one.test.max_strain = largest_strain(strains_[target]);
  return one;
}

double strength_of(const TestResult& result, Property property) {
  return measured(property).share * number_of(result, measured(property).number);
}

double modulus_of(const TestResult& result, Property property, ModulusReading reading) {
  switch (reading) {
    case ModulusReading::tangent_50:
    case ModulusReading::average: return number_of(result, "E_tangent");
    case ModulusReading::secant_50: return number_of(result, "E_secant");
    // The curve's own stress: under confinement the platens bring on sigma_1 - sigma_3, not sigma_1.
    case ModulusReading::secant_at_peak:
      return number_of(result, test_of(property).curve.strength) / number_of(result, "peak_strain");
    case ModulusReading::small_strain: return number_of(result, "E_small");
  }
  return std::nan("");
}

Recipe coarse(Recipe r) {
  r.packing.radius_min *= coarse_factor, r.packing.radius_max *= coarse_factor;
  r.matrix.bond_gap *= coarse_factor;
  r.packing.n_grains =
      std::llround(static_cast<double>(r.packing.n_grains) / (coarse_factor * coarse_factor));
  for (BeddingRecipe& b : r.bedding) {
    b.spacing *= coarse_factor, b.zone_thickness *= coarse_factor, b.offset *= coarse_factor;
    // Stiffness times spacing is a modulus, which has to stay while the spacing grows.
    b.k_n /= coarse_factor, b.k_s /= coarse_factor;
  }
  return r;
}
double coarse_growth(Property property) { return std::pow(coarse_factor, measured(property).grain_exponent); }
bool has_coarse(const Recipe& r) {
  return r.packing.file.empty() && study::expected_grains(r) >= fewest_grains * coarse_factor * coarse_factor;
}

Recipe test_settings(const Recipe& recipe, const std::vector<Target>& all, std::int64_t seed,
                     Simulator& simulator) {
  std::vector<Target> targets = of_property(all, Property::ucs);
  if (targets.empty()) targets = of_property(all, Property::confined);
  return test_settings(recipe, targets, moduli_at(recipe, targets, seed, simulator));
}

Recipe test_settings(Recipe recipe, const std::vector<Target>& targets, const std::vector<double>& moduli) {
  const std::vector<double> strains = peak_strains(recipe, targets, moduli);
  double slowest = infinity;
  for (std::size_t i = 0; i < targets.size(); ++i)
    slowest = std::min(slowest, slow_speed(recipe, targets[i], strains[i]));
  const double largest = strains.empty() ? 0.0 : *std::max_element(strains.begin(), strains.end());
  TestRecipe& test = recipe.test;
  if (std::isfinite(slowest)) test.platen_speed = slowest, test.max_strain = largest_strain(largest);
  // Shorter windows took a first small maximum of soft joints for the peak (docs/decisions/0004).
  test.stop_at = 0.8, test.post_peak = 1.0;
  test.pre_strain = test.approach_strain = test.approach_speed = 0.0;  // what the Loading of each test says
  test.n_snapshots = 0, test.n_frames = 0;
  test.angles.clear(), test.intact = false;
  recipe.engine.precision = Precision::single_precision;
  recipe.engine.grain_inertia = GrainInertia::equal;
  recipe.engine.step_safety = step_safety;
  return recipe;
}

TestSeries::TestSeries(Recipe recipe, std::vector<Target> targets, std::int64_t first_packing,
                       Loadings loadings, Simulator& simulator)
    : recipe_(std::move(recipe)),
      targets_(std::move(targets)),
      first_packing_(first_packing),
      loadings_(std::move(loadings)),
      simulator_(simulator),
      tests_(recipe_, targets_, first_packing, simulator),
      results_(targets_.size()),
      approach_(targets_.size()) {}

Recipe TestSeries::recipe_of(std::size_t target, std::int64_t packing) const {
  const bool first = packing == first_packing_;
  const double foreseen = first || loadings_.foreseen.empty() ? infinity : loadings_.foreseen[target];
  Recipe test = tests_.of(recipe_, target, packing, first ? loadings_.first : loadings_.others, foreseen);
  // Pictures are for the eye, and one specimen shows what all would; frames take far more memory than curves.
  if (!first || test.test.kind != TestKind()) test.test.n_snapshots = test.test.n_frames = 0;
  return test;
}

void TestSeries::take(const std::vector<std::int64_t>& packings) {
  std::vector<Recipe> recipes;
  for (std::size_t i = 0; i < targets_.size(); ++i)
    for (const std::int64_t packing : packings) {
      recipes.push_back(recipe_of(i, packing));
      approach_[i].push_back(recipes.back().test.approach_strain);
    }
  const std::vector<TestResult> results = simulator_.test(recipes);
  for (std::size_t k = 0; k < results.size(); ++k) results_[k / packings.size()].push_back(results[k]);
}

std::vector<Comparison> TestSeries::strengths() const {
  std::vector<Comparison> rows;
  for (std::size_t i = 0; i < targets_.size(); ++i) {
    const Property property = targets_[i].property;
    rows.push_back(over_packings(targets_[i], results_[i], measured(property).number,
                                 [&](const TestResult& r) { return strength_of(r, property); }));
    rows.back().failure = failure_of(results_[i]);
  }
  return rows;
}

std::vector<Comparison> TestSeries::moduli(ModulusReading reading) const {
  std::vector<Comparison> rows;
  for (std::size_t i = 0; i < targets_.size(); ++i) {
    const Property property = targets_[i].property;
    if (!is_compressive(property)) continue;
    const auto without_value = [&](Property p) {
      Target t{p, targets_[i].theta, std::nan(""), std::nan("")};
      t.confining = targets_[i].confining;
      return t;
    };
    const std::span<const TestResult> all(results_[i]);
    // A farther approach ends within the range that E is read in: the change of speed would bend the curve
    // there.
    const auto read = all.first(approach_[i].back() > approach_[i].front() ? 1 : all.size());
    rows.push_back(over_packings(without_value(Property::E), read, "E_tangent",
                                 [&](const TestResult& r) { return modulus_of(r, property, reading); }));
    rows.push_back(over_packings(without_value(Property::nu), read, "nu",
                                 [](const TestResult& r) { return number_of(r, "nu"); }));
  }
  return rows;
}

std::vector<Comparison> strength_response(const Recipe& recipe, const std::vector<Target>& targets,
                                          const std::vector<std::int64_t>& packings, const Loadings& loadings,
                                          Simulator& simulator) {
  TestSeries series(recipe, targets, packings.front(), loadings, simulator);
  series.take(packings);
  return series.strengths();
}

}  // namespace phy::calibrate
