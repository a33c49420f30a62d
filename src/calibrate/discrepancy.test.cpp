// What a model misses of a table, between its angles.
#include "calibrate/discrepancy.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/rng.hpp"
#include "study/band.hpp"

namespace phy::calibrate {
namespace {

const std::vector<double> angles = {0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 90.0};

Target test_of(Property property, double theta, double confining = 0.0) {
  Target t{property, theta, 1e8, 5e6, 3};
  t.confining = confining;
  return t;
}

double wave(double theta) { return 0.15 * std::cos(theta * std::acos(-1.0) / 45.0); }

std::vector<StrengthResidual> residuals(double (*missed)(double), Property property = Property::ucs) {
  std::vector<StrengthResidual> all;
  for (const double theta : angles)
    all.push_back({test_of(property, theta), missed(theta), 4e-4, 1e-4, {missed(theta)}});
  return all;
}

TEST(Discrepancy, ASmoothMissIsPredictedWhereNothingWasMeasured) {
  const std::vector<StrengthResidual> missed = residuals(wave);
  for (std::size_t i = 1; i + 1 < missed.size(); ++i) {
    const Discrepancy::Term term = Discrepancy(missed, i).of(i);
    EXPECT_EQ(term.weights[i], 0.0) << "its own value";
    EXPECT_LT(std::fabs(term.mean - wave(angles[i])), 0.05) << angles[i];
    EXPECT_LT(std::fabs(term.mean - wave(angles[i])), 2.0 * std::sqrt(term.variance)) << angles[i];
  }
}

// A value that is left out is that of the stand-in, whose own error comes on top of a test's.
TEST(Discrepancy, AValueLeftOutIsKnownLessWellThanATest) {
  std::vector<StrengthResidual> missed = residuals(wave);
  const double exact = Discrepancy(missed, 3).at(missed[3].target).variance;
  for (const double unknown : {0.0, 1e-3, 4e-3}) {
    missed[3].unknown = unknown;
    EXPECT_NEAR(Discrepancy(missed, 3).of(3).variance - exact, unknown, 1e-12);
  }
}

TEST(Discrepancy, APerfectModelIsLeftAsItIs) {
  const Discrepancy d(residuals([](double) { return 0.0; }), 3);
  EXPECT_EQ(d.of(3).mean, 0.0);
  EXPECT_LT(std::sqrt(d.of(3).variance), 0.03);
}

// Tension has nothing of what compression misses, but a strength under a stress on the sides has.
TEST(Discrepancy, StrengthsInCompressionShareOneFunction) {
  std::vector<StrengthResidual> missed = residuals([](double) { return 0.2; });
  const Discrepancy d(missed);
  const double uniaxial = d.at(test_of(Property::ucs, 40.0)).mean;
  EXPECT_NEAR(uniaxial, 0.2, 0.02);
  const Discrepancy::Term confined = d.at(test_of(Property::confined, 40.0, 20e6));
  EXPECT_NEAR(confined.mean, uniaxial, 1e-9);
  EXPECT_GT(std::sqrt(confined.variance), 0.1) << "nothing is known of its change with the stress";
  EXPECT_TRUE(d.knows(Property::confined));
  EXPECT_FALSE(d.knows(Property::brazilian));

  for (const StrengthResidual& r : residuals([](double) { return 0.0; }, Property::brazilian))
    missed.push_back(r);
  EXPECT_EQ(Discrepancy(missed).at(test_of(Property::brazilian, 40.0)).mean, 0.0);
}

/// A rock whose strengths are those of a closed form times what the form misses, drawn like the prior: a
/// level and a slope over the stress, each smooth in theta; and twenty draws of the form's own level.
class MissedRock {
 public:
  explicit MissedRock(std::uint32_t seed) : seed_(seed) {
    for (std::uint32_t i = 0; i < 2; ++i)  // exponential
      sizes_[i] = -0.1 * std::log(1.0 - uniform(seed_, Stream::test, 1, i));
  }
  /// log(rock/form); stress as a part of the mean strength of 100 MPa.
  double missed(double theta, double stress) const {
    return sizes_[0] * smooth(2, theta) + sizes_[1] * smooth(3, theta) * stress / 0.2;
  }
  /// Level of a draw.
  double level(std::uint32_t draw) const { return 0.03 * normal(seed_, Stream::test, 4, draw); }
  /// Seven angles without stress, three specimens each of 6 % scatter.
  std::vector<StrengthResidual> table() const {
    std::vector<StrengthResidual> all;
    for (const double theta : angles) {
      const double noise = std::pow(0.06, 2) / 3.0;
      const double value = missed(theta, 0.0) + std::sqrt(noise) * normal(seed_, Stream::test, 5,
                                                                          static_cast<std::uint32_t>(theta));
      all.push_back({test_of(Property::ucs, theta), value, noise, 1e-4});
      for (std::uint32_t k = 0; k < 20; ++k) all.back().of_draws.push_back(value - level(k));
    }
    return all;
  }

 private:
  std::uint32_t seed_;
  double sizes_[2];
  double smooth(std::uint32_t which, double theta) const {
    const double a = theta * std::acos(-1.0) / 90.0;
    double sum = 0.0;
    for (std::uint32_t i = 0; i < 3; ++i)
      sum += normal(seed_, Stream::test, which, i) * std::cos(i * a) / std::sqrt(2.0);
    return sum;
  }
};

/// The band of twenty draws of the form at an angle and a stress; all logarithms are about zero.
study::Band predicted(const MissedRock& rock, const Discrepancy& discrepancy, double theta, double stress) {
  const Discrepancy::Term term = discrepancy.at(test_of(Property::confined, theta, 1e8 * stress));
  std::vector<study::Predictions> draws;
  for (std::uint32_t k = 0; k < 20; ++k)
    draws.push_back({{{},
                      "sigma_1",
                      "Pa",
                      std::exp(rock.level(k)),
                      discrepancy.of_draw(term, k),
                      std::sqrt(term.variance)}});
  return study::bands_of(draws).front();
}

// Between the angles of a table and under stresses that it lacks: the model's band holds some of the rocks,
// the rock's band nine of ten. Some more at the table's own stress, as these rocks are smoother than the
// prior.
TEST(Discrepancy, BandsOfDrawsHoldRocksThatTheModelMisses) {
  constexpr std::uint32_t n_rocks = 150;
  const std::vector<double> stresses = {0.0, 0.1, 0.3};
  std::vector<int> rock_held(stresses.size()), model_held(stresses.size());
  for (std::uint32_t k = 0; k < n_rocks; ++k) {
    const MissedRock rock(1000 + k);
    const Discrepancy discrepancy(rock.table());
    for (std::size_t i = 0; i < stresses.size(); ++i) {
      const study::Band band = predicted(rock, discrepancy, 37.0, stresses[i]);
      const double truth = std::exp(rock.missed(37.0, stresses[i]));
      rock_held[i] += band.rock_low <= truth && truth <= band.rock_high ? 1 : 0;
      model_held[i] += band.low <= truth && truth <= band.high ? 1 : 0;
    }
  }
  for (std::size_t i = 0; i < stresses.size(); ++i) {
    EXPECT_GT(rock_held[i], 0.85 * n_rocks) << stresses[i];
    EXPECT_LT(rock_held[i], 0.98 * n_rocks) << stresses[i];
    EXPECT_LT(model_held[i], 0.75 * n_rocks) << stresses[i];
  }
}

// At an angle of the table the rock's band lies about the table's value and is narrower than the miss.
TEST(Discrepancy, AtATestedAngleThePredictionIsDrawnToTheTable) {
  std::vector<StrengthResidual> missed = residuals([](double) { return 0.2; });
  for (StrengthResidual& r : missed) r.of_draws = {r.value, r.value + 0.05, r.value - 0.05};
  const Discrepancy d(missed);
  const Discrepancy::Term term = d.at(test_of(Property::ucs, 45.0));
  for (std::size_t k = 0; k < 3; ++k)  // the draw's answer is 1e8 exp(-value)
    EXPECT_NEAR(d.of_draw(term, k) - missed[3].of_draws[k], 0.0, 0.01) << "back at the table's 100 MPa";
  EXPECT_LT(std::sqrt(term.variance), 0.02);
}

// The weights of a draw are those of the estimate: a draw whose level is lower is corrected by more.
TEST(Discrepancy, ADrawOfAnotherLevelIsBroughtBack) {
  std::vector<StrengthResidual> missed = residuals(wave);
  for (StrengthResidual& r : missed) r.of_draws.push_back(r.value + 0.05);
  const Discrepancy d(missed, 3);
  const Discrepancy::Term term = d.of(3);
  ASSERT_EQ(d.n_draws(), 2U);
  EXPECT_DOUBLE_EQ(d.of_draw(term, 0), term.mean);
  EXPECT_GT(d.of_draw(term, 1), term.mean + 0.01);
}

}  // namespace
}  // namespace phy::calibrate
