// A twin trial: a rock of known parameters is drawn, the program makes its laboratory table with noise, the
// calibration sees nothing but that table, and what it finds is held against the noise-free response
// (docs/theory/calibration.md, "Twin trials").
#pragma once
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/rng.hpp"
#include "calibrate/calibration.hpp"
#include "calibrate/elastic_response.hpp"
#include "calibrate/parameters.hpp"
#include "calibrate/twin.hpp"
#include "maps/mapped_model.hpp"

namespace phy {

constexpr std::uint32_t trial_seed = 20120158;

/// The paper's specimen with larger grains; planes and zones grow with them, joint stiffnesses fall.
inline Recipe magnified_model(double factor) {
  Recipe r;
  r.bedding.resize(1);
  r.packing.radius_min *= factor, r.packing.radius_max *= factor;
  r.packing.n_grains = std::llround(static_cast<double>(r.packing.n_grains) / (factor * factor));
  BeddingRecipe& b = r.bedding[0];
  b.spacing *= factor, b.zone_thickness *= factor, b.k_n /= factor, b.k_s /= factor;
  return r;
}

/// A family that was mapped.
inline const maps::MappedModel& family(const std::string& name) {
  for (const maps::MappedModel& f : maps::mapped_models())
    if (f.name == name) return f;
  throw std::runtime_error(name);
}

/// The matrix of a synthetic rock; `between` draws the next number, uniform in its logarithm.
template <class Between>
void draw_matrix(MatrixRecipe& m, const Between& between) {
  m.E_c = m.E_b = between(10e9, 60e9);
  m.ks_over_kn = m.bond_ks_over_kn = between(0.2, 0.6);
  m.sigma_c = between(20e6, 120e6), m.sigma_c_sd = 0.1 * m.sigma_c;
  m.tau_c = m.sigma_c * between(1.0, 4.0), m.tau_c_sd = 0.1 * m.tau_c;
  m.mu = between(0.3, 1.0);
}

/// Rock k of the box of docs/theory/calibration.md, everything uniform in its logarithm.
inline Recipe trial_rock(std::uint32_t k, const Recipe& model) {
  std::uint32_t what = 0;
  const auto between = [&](double low, double high) {
    return low * std::pow(high / low, uniform(trial_seed, Stream::test, k, what++));
  };
  Recipe r = model;
  BeddingRecipe& b = r.bedding[0];
  draw_matrix(r.matrix, between);
  b.k_n = r.matrix.E_c / b.spacing * 0.44 * between(0.25, 4.0);  // about the paper's joint, over a factor 16
  b.k_s = r.matrix.E_c / b.spacing * 0.126 * between(0.25, 4.0);
  b.cohesion = r.matrix.tau_c * between(0.1, 0.6);
  b.sigma_n = b.cohesion * between(0.1, 1.0);
  b.mu = between(0.2, 0.8);
  return r;
}

struct Trial {
  Recipe truth;
  std::vector<Comparison> response;  ///< of the truth on the packings of the table
  std::vector<Comparison> unseen;    ///< of the truth on the packings of the verification
  Calibration found;
  /// After each batch of the search, the one before the first included: over what is sought, the mean of
  /// log(high/low) of the 95 % intervals.
  std::vector<double> widths;
};

inline double mean_log_width(const std::vector<ParameterEstimate>& known) {
  double sum = 0.0;
  for (const ParameterEstimate& e : known) sum += std::log(e.high / e.low);
  return sum / static_cast<double>(known.size());
}

inline std::vector<std::int64_t> packings_from(std::int64_t first, int n) {
  std::vector<std::int64_t> seeds;
  for (int i = 0; i < n; ++i) seeds.push_back(first + i);
  return seeds;
}

/// What the calibration is given of a trial: the table alone, with noise.
inline Rock rock_of(const Trial& trial, std::uint32_t k, const Recipe& model,
                    const std::vector<double>& angles) {
  calibrate::TwinOptions options;
  options.angles = angles, options.noise_seed = k;
  Rock rock;
  rock.name = fmt::format("twin {}", k), rock.model = model;
  rock.readings = calibrate::twin_readings(trial.response, options);
  return rock;
}

/// Packings behind the table of rock k, of each rock its own: twenty rocks on the same five would share one
/// luck.
inline std::vector<std::int64_t> table_packings(std::uint32_t k, int n) {
  return packings_from(1001 + 100 * static_cast<std::int64_t>(k), n);
}
inline std::vector<std::int64_t> unseen_packings() { return packings_from(6, 5); }

inline Trial run_trial(std::uint32_t k, const Recipe& model, const std::vector<double>& angles,
                       const calibrate::Budget& budget, calibrate::Simulator& simulator, int n_table = 5,
                       const std::vector<std::int64_t>& unseen = unseen_packings()) {
  Trial t;
  t.truth = trial_rock(k, model);
  t.response = calibrate::twin_response(t.truth, angles, table_packings(k, n_table), simulator);
  t.unseen = calibrate::twin_response(t.truth, angles, unseen, simulator);
  calibrate::CalibrationOptions how;
  how.max_tests = budget.max_tests, how.effort = budget.effort;
  how.listener.estimates = [&](const std::vector<ParameterEstimate>& known) {
    if (known.front().symbol == "sigma_c") t.widths.push_back(mean_log_width(known));
  };
  t.found = calibrate::calibrate(Evidence(rock_of(t, k, model, angles)), how, simulator);
  return t;
}

/// The elastic part of a trial alone.
inline Trial run_elastic_trial(std::uint32_t k, const Recipe& model, const std::vector<double>& angles,
                               calibrate::Simulator& simulator, int n_table = 5) {
  Trial t;
  t.truth = trial_rock(k, model);
  std::vector<Target> moduli;
  for (const Property p : {Property::E, Property::nu})
    for (const double theta : angles) moduli.push_back({p, theta, 1.0, 1.0, 1, true});
  t.response = calibrate::elastic_response(t.truth, moduli, table_packings(k, n_table), simulator);
  t.unseen = calibrate::elastic_response(t.truth, moduli, unseen_packings(), simulator);
  calibrate::CalibrationOptions how;
  how.elastic_only = true;
  t.found = calibrate::calibrate(Evidence(rock_of(t, k, model, angles)), how, simulator);
  return t;
}

/// Of `rows` against `truth`, matched by property and angle; relative.
inline double rmse_against(const std::vector<Comparison>& rows, const std::vector<Comparison>& truth,
                           Property property) {
  double squares = 0.0;
  int n = 0;
  for (const Comparison& a : rows)
    for (const Comparison& b : truth)
      if (a.target.property == property && b.target.property == property &&
          a.target.theta == b.target.theta) {
        const double e = a.mean / b.mean - 1.0;
        squares += e * e, ++n;
      }
  return std::sqrt(squares / n);
}

/// What the truth has of an estimated parameter: of the number of the recipe, or of the ratio that was
/// sought.
inline double true_value(const Recipe& r, const ParameterEstimate& e) {
  if (e.number != nullptr) return e.number(r);
  for (const Parameter* p : strength_parameters(r))
    if (e.key == sought(*p).key) return p->get(r);
  return std::nan("");
}

/// How often the 95 % intervals held the truth, and how wide they were.
struct Coverage {
  int inside = 0, n = 0;
  std::vector<double> widths;  ///< high/low - 1
  void add(double low, double high, double value) {
    inside += low <= value && value <= high ? 1 : 0, ++n;
    widths.push_back(high / low - 1.0);
  }
  double share() const { return static_cast<double>(inside) / n; }
  double median_width() const {
    std::vector<double> w = widths;
    std::sort(w.begin(), w.end());
    return w.empty() ? 0.0 : w[w.size() / 2];
  }
};

/// Intervals of the rock's own response.
inline void add_response(const Trial& t, Property property, Coverage& coverage) {
  for (const Comparison& c : t.found.fitted)
    for (const Comparison& truth : t.response)
      if (c.target.property == property && truth.target.property == property &&
          c.target.theta == truth.target.theta)
        coverage.add(c.low, c.high, truth.mean);
}

/// Intervals of the parameters that are said to be determined.
inline void add_parameters(const Trial& t, Coverage& coverage) {
  for (const ParameterEstimate& e : t.found.parameters)
    if (e.determined) coverage.add(e.low, e.high, true_value(t.truth, e));
}

}  // namespace phy
