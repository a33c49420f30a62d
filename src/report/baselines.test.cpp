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

TEST(Baselines, AllAreJudgedOnTheSameCells) {
  Calibration c;
  c.fitted = c.left_out = table(Property::ucs, [](double t) { return 6e7 + 1e5 * t; });
  c.left_out.front().mean *= 10.0;  // an end, which a line cannot tell
  const std::vector<ErrorRow> rows = error_rows(c);
  ASSERT_EQ(rows.size(), 5U);
  EXPECT_NEAR(rows[1].rms[2], 0.1, 1e-12);
  EXPECT_NEAR(rows[2].rms[2], 0.0, 1e-12);
  EXPECT_TRUE(std::isnan(rows[1].rms[0]));
  EXPECT_EQ(miss_text(Property::nu, 0.0423), "0.042");
  EXPECT_EQ(miss_text(Property::ucs, std::nan("")), "-");
}

}  // namespace
}  // namespace phy::report
