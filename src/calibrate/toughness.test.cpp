// Fracture toughness in a calibration: its prior against the press, and tables with and without a grain size.
#include "calibrate/toughness.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "calibrate/calibration.hpp"
#include "calibrate/paper_press_fixture.hpp"
#include "calibrate/strength_tests.hpp"
#include "maps/prior_regression.hpp"
#include "records/reading_fixture.hpp"
#include "verdict/grain_size.hpp"

namespace phy::calibrate {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

Comparison row(double laboratory, double model) {
  Comparison c;
  c.target.property = Property::fracture_toughness, c.target.mean = laboratory, c.mean = model;
  return c;
}

// Twice the toughness at four times the size; over rows the geometric mean, those without an answer left out.
TEST(Toughness, GrowsWithTheRootOfTheGrains) {
  using verdict::grain_size_to_meet;
  EXPECT_NEAR(grain_size_to_meet({row(1e6, 2e6)}, 0.002), 0.0005, 1e-15);
  EXPECT_NEAR(grain_size_to_meet({row(1e6, 2e6), row(2e6, 1e6), row(1e6, std::nan(""))}, 0.002), 0.002,
              1e-15);
  EXPECT_TRUE(std::isnan(grain_size_to_meet({row(1e6, std::nan(""))}, 0.002)));
  Recipe fine, large;
  large.packing.radius_min *= 4.0, large.packing.radius_max *= 4.0;
  const std::vector<double> z(1, 0.0);
  EXPECT_NEAR(maps::prior_toughness(large, {}).value(z) - maps::prior_toughness(fine, {}).value(z),
              std::log(2.0), 1e-12);
}

TEST(Toughness, IsNoStressThatStrengthsAreMeasuredBy) {
  Rock rock;
  rock.bedded = false, rock.grains_stated = true;
  rock.readings = {reading(Property::confined, 0.0, 2e6), reading(Property::fracture_toughness, 0.0, 50e6)};
  rock.readings[0].confining = 0.1e6;
  const Evidence evidence(rock);
  EXPECT_LT(evidence.scales.strength, 2e6);
  EXPECT_EQ(evidence.n_compressive(), 1);
  EXPECT_EQ(evidence.n_tests(), 2);
}

// Bonds of the default recipe, 806 grains of 0.665 mm, 18 of them in the radius of the half disc; the mean of
// three packings, which differ by some 10 %, lies within the standard deviation of what is believed.
TEST(Toughness, IsExpectedWhereTheBendTestOfThePressHasIt) {
  Recipe r;
  r.specimen = {0.024, 0.013}, r.packing.n_grains = 806;
  r.matrix.tau_c = 1.7 * r.matrix.sigma_c, r.matrix.tau_c_sd = 0.1 * r.matrix.tau_c;
  Rock rock;
  rock.bedded = false, rock.grains_stated = true, rock.model = r;
  rock.readings = {reading(Property::ucs, 0.0, 100e6), reading(Property::fracture_toughness, 0.0, 2.5e6)};
  const Evidence evidence(rock);
  const maps::PriorMean prior = maps::prior_strength(evidence, r, evidence.strengths[1]);
  std::vector<double> z;
  for (const Parameter* p : strength_ratios(evidence)) z.push_back(p->normalised(p->get(r)));
  const auto simulator = make_simulator({2, "", nullptr, nullptr});
  const std::vector<Comparison> measured =
      strength_response(test_settings(r, evidence.strengths, {60e9, 60e9}), {evidence.strengths[1]},
                        {1, 2, 3}, as_measured, *simulator);
  ASSERT_EQ(measured[0].n_packings, 3) << measured[0].missing;
  EXPECT_NEAR(std::log(measured[0].mean / r.matrix.sigma_c), prior.value(z), prior.constant)
      << measured[0].mean * 1e-6 << " MPa sqrt(m)";
}

/// E, nu, UCS, BTS and K_Ic of an isotropic rock that the press of closed forms can be; its grains `factor`
/// times those of the model.
Rock table(bool stated, double factor = 1.0) {
  Rock rock;
  rock.name = "granite", rock.bedded = false, rock.grains_stated = stated;
  Recipe truth;
  truth.matrix.tau_c = 1.6 * truth.matrix.sigma_c;
  rock.readings = {
      reading(Property::E, 0.0, 60e9), reading(Property::nu, 0.0, 0.25),
      reading(Property::ucs, 0.0, PaperPress::ucs(truth)),
      reading(Property::brazilian, 0.0, PaperPress::splitting(truth)),
      reading(Property::fracture_toughness, 0.0, std::sqrt(factor) * PaperPress::toughness(truth))};
  return rock;
}

Calibration calibrated(const Rock& rock, PaperPress& press) {
  CalibrationOptions options;
  options.max_tests = 60;
  return calibrate(Evidence(rock), options, press);
}

const Comparison* toughness_in(const std::vector<Comparison>& rows) {
  for (const Comparison& c : rows)
    if (c.target.property == Property::fracture_toughness) return &c;
  return nullptr;
}

TEST(Toughness, IsMetWhereTheGrainSizeIsStated) {
  PaperPress press;
  const Calibration c = calibrated(table(true), press);
  const Comparison* K = toughness_in(c.verification);
  ASSERT_NE(K, nullptr);
  EXPECT_LT(std::fabs(K->error()), 0.1);
  EXPECT_TRUE(c.compared.empty());
  EXPECT_LE(c.counts.compression(), 60) << "bend tests are not counted";
  EXPECT_EQ(c.verdict.status, VerdictStatus::calibrated);
}

// Grains of 2.25 times the size have 1.5 times the toughness: no strength can make up for that.
TEST(Toughness, OfOtherGrainsIsNotMet) {
  PaperPress press;
  const Calibration c = calibrated(table(true, 2.25), press);
  EXPECT_NE(c.verdict.status, VerdictStatus::calibrated);
  EXPECT_THAT(c.verdict.not_good_for, Contains(testing::Truly([](const Finding& f) {
                return !f.cells.empty() && f.cells[0].property == Property::fracture_toughness;
              })));
}

TEST(Toughness, IsComparedWhereTheGrainSizeIsNotStated) {
  PaperPress press;
  const Calibration c = calibrated(table(false, 2.25), press);
  EXPECT_EQ(toughness_in(c.verification), nullptr);
  EXPECT_EQ(toughness_in(c.fitted), nullptr);
  EXPECT_EQ(c.verdict.status, VerdictStatus::calibrated);
  ASSERT_EQ(c.compared.size(), 1U);
  EXPECT_NEAR(c.compared[0].error(), 1.0 / 1.5 - 1.0, 0.1);
  EXPECT_EQ(c.compared[0].n_packings, c.verification.back().n_packings);
  // 0.665 mm times 2.25 is 1.5 mm, to within twice the error of the strengths
  const Finding* grains = first_of(c.notes, FindingKind::toughness_grains);
  ASSERT_NE(grains, nullptr);
  const double size = grains->number("wanted");
  EXPECT_NEAR(size, 1.5e-3, 0.3e-3);
  EXPECT_LT(grains->number("in_radius"), grains->number("fewest"));
  const Finding* compared = first_of(c.notes, FindingKind::toughness_compared);
  ASSERT_NE(compared, nullptr);
  EXPECT_NEAR(compared->number("grain_size"), 0.665e-3, 1e-9);
}

}  // namespace
}  // namespace phy::calibrate
