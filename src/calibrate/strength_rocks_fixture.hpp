// Synthetic rocks for tests of the strength stage, and their tables.
#pragma once
#include <cmath>
#include <tuple>
#include <vector>

#include "base/rng.hpp"
#include "calibrate/paper_press_fixture.hpp"
#include "calibrate/strength_stage.hpp"
#include "records/reading_fixture.hpp"

namespace phy::calibrate {

inline const std::vector<double> angles = {0, 15, 30, 45, 60, 75, 90};
inline const std::vector<std::int64_t> seeds = {1, 2, 3, 4, 5};
inline constexpr double noise = 0.05;
inline constexpr int n_specimens = 3;

/// Synthetic rock k: strengths anywhere in the box of the twin trials.
inline Recipe truth(std::uint32_t k) {
  const auto between = [&](double low, double high, std::uint32_t what) {
    return low * std::pow(high / low, uniform(11, Stream::test, k, what));
  };
  Recipe r;
  r.bedding.resize(1);
  r.matrix.sigma_c = between(20e6, 120e6, 0), r.matrix.tau_c = r.matrix.sigma_c * between(1.0, 4.0, 1);
  r.matrix.mu = between(0.3, 0.9, 2);
  r.bedding[0].cohesion = r.matrix.tau_c * between(0.1, 0.6, 3);
  r.bedding[0].sigma_n = r.bedding[0].cohesion * between(0.1, 1.0, 4);
  r.bedding[0].mu = between(0.2, 0.8, 5);
  return r;
}

inline double response(Recipe r, double theta) {
  r.bedding[0].theta = theta;
  return PaperPress::ucs(r);
}

inline std::vector<Target> laboratory(const Recipe& rock, std::uint32_t k) {
  std::vector<Target> targets;
  for (const double theta : angles) {
    Target t{Property::ucs, theta, 0.0, 0.0, n_specimens, false};
    const double error =
        noise / std::sqrt(n_specimens) * normal(5, Stream::test, k, static_cast<std::uint32_t>(theta));
    t.mean = response(rock, theta) * (1.0 + error), t.sd = noise * t.mean;
    targets.push_back(t);
  }
  return targets;
}

/// Five of the seven angles: enough for what a search counts.
inline std::vector<Target> some_of(std::vector<Target> targets) {
  std::erase_if(targets, [](const Target& t) { return t.theta == 15.0 || t.theta == 75.0; });
  return targets;
}

/// A search and what the press was asked for.
struct Searched : StrengthFit {
  SimulatorCount counts;
  bool stopped = false;
};
inline Searched searched(const Rock& rock, const std::vector<Target>& targets, PaperPress& press,
                         const Budget& budget, const std::vector<std::int64_t>& packings = seeds) {
  const Evidence evidence(rock, targets);
  Searched found;
  try {
    fit_strength({evidence, rock.model, packings, budget, press, Listener{}}, found);
  } catch (const Stopped&) {
    found.stopped = true;
  }
  found.counts = press.count();
  return found;
}
inline Searched fit(const std::vector<Target>& targets, PaperPress& press, const Budget& budget = {252}) {
  Rock rock;
  rock.model.bedding.resize(1);
  return searched(rock, targets, press, budget);
}

/// A rock of strengths only.
inline Rock rock_of(const std::vector<std::tuple<Property, double, double>>& values, bool bedded) {
  Rock rock;
  rock.bedded = bedded;
  if (bedded) rock.model.bedding.resize(1);
  for (const auto& [property, theta, value] : values)
    rock.readings.push_back(reading(property, theta, value));
  return rock;
}

}  // namespace phy::calibrate
