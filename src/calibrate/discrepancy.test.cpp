// What a model misses of a table, between its angles.
#include "calibrate/discrepancy.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace phy::calibrate {
namespace {

const std::vector<double> angles = {0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 90.0};

std::vector<Target> table(Property property, double confining = 0.0) {
  std::vector<Target> all;
  for (const double theta : angles) {
    Target t{property, theta, 1e8, 5e6, 3};
    t.confining = confining;
    all.push_back(t);
  }
  return all;
}

double wave(double theta) { return 0.15 * std::cos(theta * std::acos(-1.0) / 45.0); }

std::vector<Residual> residuals(double (*f)(double)) {
  std::vector<Residual> all;
  for (const double theta : angles) all.push_back({f(theta), 4e-4, 1e-4});
  return all;
}

TEST(Discrepancy, ASmoothMissIsPredictedWhereNothingWasMeasured) {
  const std::vector<Target> targets = table(Property::ucs);
  const std::vector<Residual> missed = residuals(wave);
  for (std::size_t i = 1; i + 1 < targets.size(); ++i) {
    const Discrepancy::Term term = Discrepancy(targets, missed, i).of(i);
    EXPECT_EQ(term.weights[i], 0.0) << "its own value";
    EXPECT_LT(std::fabs(term.mean(missed) - wave(angles[i])), 0.05) << angles[i];
    EXPECT_LT(std::fabs(term.mean(missed) - wave(angles[i])), 2.0 * std::sqrt(term.variance)) << angles[i];
  }
}

TEST(Discrepancy, APerfectModelIsLeftAsItIs) {
  const std::vector<Residual> none = residuals([](double) { return 0.0; });
  const Discrepancy d(table(Property::ucs), none, 3);
  EXPECT_EQ(d.of(3).mean(none), 0.0);
  EXPECT_LT(std::sqrt(d.of(3).variance), 0.03);
}

// Tension has nothing of what compression misses, but a strength under a stress on the sides has.
TEST(Discrepancy, StrengthsInCompressionShareOneFunction) {
  std::vector<Target> targets = table(Property::ucs);
  const std::vector<Residual> missed = residuals([](double) { return 0.2; });
  const Discrepancy d(targets, missed);
  Target confined = targets.front(), far = targets.front();
  confined.property = far.property = Property::confined;
  confined.confining = 5e6, far.confining = 60e6;
  EXPECT_NEAR(d.at(targets.front(), 40.0).mean, 0.2, 0.02);
  EXPECT_NEAR(d.at(confined, 40.0).mean, std::exp(-0.5 * 0.0625) * d.at(targets.front(), 40.0).mean, 1e-9);
  EXPECT_LT(d.at(far, 40.0).mean, 0.02);

  std::vector<Target> both = targets;
  std::vector<Residual> more = missed;
  for (const Target& t : table(Property::brazilian)) both.push_back(t), more.push_back({0.0, 4e-4, 1e-4});
  EXPECT_EQ(Discrepancy(both, more).at(both.back(), 40.0).mean, 0.0);
}

// The weights of a draw are those of the estimate: a draw whose level is lower is corrected by more.
TEST(Discrepancy, ADrawOfAnotherLevelIsBroughtBack) {
  const std::vector<Target> targets = table(Property::ucs);
  std::vector<Residual> missed = residuals(wave), lower = missed;
  for (Residual& r : lower) r.value += 0.05;
  const Discrepancy::Term term = Discrepancy(targets, missed, 3).of(3);
  EXPECT_GT(term.mean(lower), term.mean(missed) + 0.01);
}

}  // namespace
}  // namespace phy::calibrate
