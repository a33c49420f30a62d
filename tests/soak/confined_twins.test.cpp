// Whether strengths under three confining stresses tell friction: of the grains, of the joints.
//
// Rocks of the twin trials. The table: E, nu and UCS at four angles, sigma_1 under 5, 10 and 20 MPa at three,
// three specimens of 5 % scatter each. PHY_TWIN_MAGNIFICATION (6: 208 discs), PHY_TWIN_FIRST, PHY_TWIN_ROCKS,
// PHY_TWIN_STORE as in twin_trials.test.cpp.
#include <gtest/gtest.h>

#include <cstdio>
#include <thread>

#include "../calibration/twin_trial.hpp"
#include "calibrate/strength_tests.hpp"
#include "setting.hpp"

namespace phy {
namespace {

const std::vector<double> ucs_angles = {0, 30, 60, 90}, confined_angles = {0, 60, 90};
const std::vector<double> stresses = {5e6, 10e6, 20e6};
constexpr int n_packings = 5;

/// About what friction adds to UCS, for the speed of the tests.
constexpr double usual_growth = 4.0;

std::vector<Comparison> confined_response(const Recipe& truth, const std::vector<Comparison>& unconfined,
                                          const std::vector<std::int64_t>& seeds,
                                          calibrate::Simulator& simulator) {
  std::vector<Target> targets;
  for (const Comparison& c : unconfined)
    for (const double sigma_3 : stresses)
      if (c.target.property == Property::ucs && std::find(confined_angles.begin(), confined_angles.end(),
                                                          c.target.theta) != confined_angles.end()) {
        Target t = c.target;
        t.property = Property::confined, t.confining = sigma_3, t.mean = c.mean + usual_growth * sigma_3;
        targets.push_back(t);
      }
  const Recipe settings = calibrate::test_settings(truth, targets, seeds.front(), simulator);
  return calibrate::strength_response(settings, targets, seeds, calibrate::from_rest, simulator);
}

Rock table_of(const Recipe& truth, const Recipe& model, std::uint32_t k, calibrate::Simulator& simulator) {
  const std::vector<std::int64_t> seeds = table_packings(k, n_packings);
  std::vector<Comparison> response = calibrate::twin_response(truth, ucs_angles, seeds, simulator);
  const std::vector<Comparison> confined = confined_response(truth, response, seeds, simulator);
  Rock rock;
  rock.name = fmt::format("twin {}", k), rock.model = model;
  calibrate::TwinOptions options;
  options.noise_seed = k;
  rock.readings = calibrate::twin_readings(response, options);
  for (const Comparison& c : confined)
    for (int n = 0; n < options.n_specimens; ++n) {
      RockReading r;
      r.property = Property::confined, r.theta = c.target.theta, r.confining = c.target.confining;
      r.value =
          c.mean *
          (1.0 + options.noise * normal(trial_seed + k, Stream::test, static_cast<std::uint32_t>(r.confining),
                                        static_cast<std::uint32_t>(r.theta), static_cast<std::uint32_t>(n)));
      if (std::isfinite(r.value)) rock.readings.push_back(r);
    }
  return rock;
}

double rms_of(const Calibration& found, Property p) {
  double squares = 0.0;
  int n = 0;
  for (const Comparison& c : found.verification)
    if (c.target.property == p) squares += c.error() * c.error(), ++n;
  return std::sqrt(squares / n);
}

TEST(ConfinedTwins, ThreeStressesTellFrictionOfGrainsOrJoints) {
  const auto first = static_cast<std::uint32_t>(setting("PHY_TWIN_FIRST", 0));
  const auto end = first + static_cast<std::uint32_t>(setting("PHY_TWIN_ROCKS", 10));
  const Recipe model = magnified_model(setting("PHY_TWIN_MAGNIFICATION", 6.0));
  const int threads = static_cast<int>(setting("PHY_TWIN_THREADS", std::thread::hardware_concurrency()));
  const std::string folder = text_setting("PHY_TWIN_STORE");
  int told = 0;
  Coverage friction;
  for (std::uint32_t k = first; k < end; ++k) {
    const std::string store = folder.empty() ? "" : fmt::format("{}/confined-{}.sqlite", folder, k);
    const auto simulator = calibrate::make_simulator({threads, store, nullptr, nullptr});
    const Recipe truth = trial_rock(k, model);
    const Rock rock = table_of(truth, model, k, *simulator);
    const Calibration found = calibrate::calibrate(calibrate::Evidence(rock), {}, *simulator);
    bool any = false;
    std::string text;
    for (const ParameterEstimate& e : found.parameters) {
      if (e.symbol != "mu" && e.symbol != "mu_sj") continue;
      text += fmt::format(" {} {:.2f} [{:.2f}, {:.2f}]{} (truth {:.2f})", e.symbol, e.value, e.low, e.high,
                          e.determined ? "" : " open", true_value(truth, e));
      if (e.determined) any = true, friction.add(e.low, e.high, true_value(truth, e));
    }
    told += any ? 1 : 0;
    std::printf("rock %2u UCS %.1f %%, sigma_1 %.1f %%;%s; %s, %.0f s\n", k,
                100.0 * rms_of(found, Property::ucs), 100.0 * rms_of(found, Property::confined), text.c_str(),
                to_string(found.verdict.status), found.seconds);
    std::fflush(stdout);
  }
  std::printf("mu or mu_sj determined in %d of %u; truth inside the interval in %d of %d\n", told,
              end - first, friction.inside, friction.n);
  EXPECT_GE(told, 0.8 * (end - first));
}

}  // namespace
}  // namespace phy
