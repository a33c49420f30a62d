// What simpler rules say of a value that they were not shown.
#include "report/baselines.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "report/words.hpp"

namespace phy::report {
namespace {

const std::vector<double> angles = {0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 90.0};

std::vector<Comparison> table(Property p, double (*value)(double)) {
  std::vector<Comparison> rows;
  for (const double theta : angles) {
    Comparison c;
    c.target = {p, theta, value(theta), 1e6, 3, false};
    c.mean = 1.1 * c.target.mean;
    rows.push_back(c);
  }
  return rows;
}

double predicted(const char* key, const std::vector<Comparison>& rows, std::size_t i) {
  for (const Baseline& y : baselines())
    if (std::string(y.key) == key) return y.predict(rows, rows[i].target);
  return std::nan("");
}

TEST(Baselines, AParabolaFindsWhatItMadeAtTheEndsToo) {
  const auto rows = table(Property::E, [](double t) { return 4e10 - 3e8 * t + 5e6 * t * t; });
  for (std::size_t i = 0; i < rows.size(); ++i)
    EXPECT_NEAR(predicted("parabola", rows, i), rows[i].target.mean, 1e-6 * rows[i].target.mean);
  EXPECT_TRUE(std::isnan(predicted("interpolated", rows, 0)));
  // the mean of its neighbours lies above a parabola by the second difference: 5e6 * 15^2
  EXPECT_NEAR(predicted("interpolated", rows, 3) - rows[3].target.mean, 5e6 * 225.0, 1.0);
}

TEST(Baselines, APlaneOfWeaknessFindsWhatItMade) {
  // Coulomb: c = 15 MPa, tan phi = 0.4, matrix 100 MPa, by the drive on the plane
  const auto rows = table(Property::ucs, [](double t) {
    const double a = t * std::acos(-1.0) / 180.0;
    const double drive = std::sin(a) * std::cos(a) - 0.4 * std::cos(a) * std::cos(a);
    return drive > 1e-9 ? std::min(100e6, 15e6 / drive) : 100e6;
  });
  for (std::size_t i = 0; i < rows.size(); ++i)
    EXPECT_NEAR(predicted("jaeger", rows, i), rows[i].target.mean, 0.01 * rows[i].target.mean) << angles[i];
  EXPECT_TRUE(std::isnan(predicted("jaeger", table(Property::brazilian, [](double) { return 5e6; }), 3)));
}

double cosines(double t) {
  const double a = t * std::acos(-1.0) / 90.0;
  return 8e7 + 2e7 * std::cos(a) - 1e7 * std::cos(2.0 * a);
}

TEST(Baselines, CosinesFindWhatTheyMade) {
  const auto rows = table(Property::brazilian, cosines);
  const auto one =
      table(Property::nu, [](double t) { return 0.2 + 0.1 * std::cos(t * std::acos(-1.0) / 90.0); });
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_NEAR(predicted("cos_4", rows, i), rows[i].target.mean, 1.0);
    EXPECT_NEAR(predicted("cos_2", one, i), one[i].target.mean, 1e-12);
  }
  EXPECT_GT(std::fabs(predicted("cos_2", rows, 3) / rows[3].target.mean - 1.0), 0.1);
}

TEST(Baselines, AGaussianProcessFollowsASmoothCurve) {
  const auto rows = table(Property::ucs, cosines);
  for (std::size_t i = 1; i + 1 < rows.size(); ++i)
    EXPECT_NEAR(predicted("gaussian_process", rows, i) / rows[i].target.mean, 1.0, 0.04) << angles[i];
}

TEST(Baselines, ACurveNeedsItsAngles) {
  auto rows = table(Property::ucs, cosines);
  rows.resize(3);  // two others
  for (const Baseline& y : baselines())
    EXPECT_EQ(std::isfinite(y.predict(rows, rows[1].target)), y.fewest <= 2) << y.key;
}

/// A straight line, which the model has missed by a tenth everywhere.
Calibration line_left_out() {
  Calibration c;
  c.fitted = c.left_out = table(Property::ucs, [](double t) { return 6e7 + 1e5 * t; });
  c.left_out.front().mean *= 10.0;  // an end, which a line cannot tell
  return c;
}

TEST(Baselines, AllAreJudgedOnTheSameCells) {
  const std::vector<ErrorRow> rows = error_rows(line_left_out());
  ASSERT_EQ(rows.size(), 2U + baselines().size());
  EXPECT_NEAR(rows[1].rms[2], 0.1, 1e-12);
  EXPECT_NEAR(rows[2].rms[2], 0.0, 1e-12);
  EXPECT_TRUE(std::isnan(rows[1].rms[0]));
  EXPECT_EQ(miss_text(Property::nu, 0.0423), "0.042");
  EXPECT_EQ(miss_text(Property::ucs, std::nan("")), "-");
}

TEST(Baselines, TheBestCurveStandsBesideTheModel) {
  Calibration c = line_left_out();
  for (Comparison& row : c.left_out) row.with_discrepancy = 1.05 * row.target.mean;
  const std::vector<LeftOutErrors> all = left_out_errors(c);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].cells, 5);
  EXPECT_NEAR(all[0].model, 0.1, 1e-12);
  EXPECT_NEAR(all[0].with_discrepancy, 0.05, 1e-12);
  ASSERT_NE(all[0].best, nullptr);
  EXPECT_LT(all[0].curve, 1e-9);
}

TEST(Baselines, ACurveThatMissesACellForWantOfAnglesIsNotTheBest) {
  Calibration c = line_left_out();
  c.fitted.resize(3), c.left_out.resize(3);  // two others of the one inside
  for (const LeftOutErrors& e : left_out_errors(c)) {
    ASSERT_NE(e.best, nullptr);
    EXPECT_LE(e.best->fewest, 2U);
  }
  c.fitted.resize(2), c.left_out.resize(2);
  EXPECT_TRUE(left_out_errors(c).empty()) << "no cell between two others";
}

}  // namespace
}  // namespace phy::report
