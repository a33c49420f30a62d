// Three twin trials with the press, on specimens of some 200 grains so that they end in seconds. Such
// packings differ by more than 10 % in strength and modulus, so the bounds are wide;
// tests/soak/twin_trials.test.cpp has twenty rocks on larger specimens.
#include <gtest/gtest.h>

#include <thread>

#include "twin_trial.hpp"

namespace phy {
namespace {

TEST(TwinTrial, ThreeRocksAreRecoveredFromNoisyTables) {
  const auto simulator = calibrate::make_simulator(
      {static_cast<int>(std::max(1U, std::thread::hardware_concurrency())), "", nullptr, nullptr});
  const Recipe model = magnified_model(6.0);
  const std::vector<double> angles = {0, 30, 60, 90};
  Coverage parameters, responses;
  std::vector<double> E, ucs;
  for (std::uint32_t k = 0; k < 3; ++k) {
    const Trial t = run_trial(k, model, angles, {60}, *simulator);
    SCOPED_TRACE(fmt::format("rock {}: {}", k, to_string(t.found.verdict.status)));
    EXPECT_LE(t.found.counts.tests, 60);
    ASSERT_EQ(t.found.verification.size(), 12U);
    E.push_back(rmse_against(t.found.verification, t.unseen, Property::E));
    ucs.push_back(rmse_against(t.found.verification, t.unseen, Property::ucs));
    add_parameters(t, parameters), add_response(t, Property::ucs, responses);
  }
  // below 95 %: the five packings of the table scatter as much as those of the fit, which no interval knows
  EXPECT_GE(parameters.share(), 0.55);
  EXPECT_GE(responses.share(), 0.6);
  std::sort(E.begin(), E.end()), std::sort(ucs.begin(), ucs.end());
  EXPECT_LT(E[1], 0.15);
  EXPECT_LT(ucs[1], 0.20);
}

}  // namespace
}  // namespace phy
