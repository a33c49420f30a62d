#include "analysis/elastic.hpp"

#include <gtest/gtest.h>

#include "analysis/histories_fixture.hpp"

namespace phy::analysis {
namespace {

constexpr StressRange middle = {0.4, 0.6};

Number tangent(const History& h, StressRange range = middle, StrainFrom from = StrainFrom::gauge) {
  return tangent_modulus(loading_branch(h), range, from, "E");
}
Number secant(const History& h, double fraction = 0.5, StrainFrom from = StrainFrom::gauge) {
  return secant_modulus(loading_branch(h), fraction, from, "E");
}
Number ratio(const History& h, StrainFrom from = StrainFrom::gauge) {
  return poisson_ratio(loading_branch(h), middle, from, "nu");
}

/// Strains of 1e-3 per row; stress 2 per row up to row 30, 1 per row up to row 80 (stress 110), then falling.
/// nu: 0.2, 0.5.
History bent() {
  History h;
  double lateral = 0.0;
  for (int i = 1; i <= 100; ++i) {
    HistoryRow r;
    r.axial_strain = r.axial_strain_gauge = 1e-3 * i;
    r.axial_stress = i <= 30 ? 2.0 * i : i <= 80 ? 30.0 + i : 190.0 - i;
    lateral -= i <= 30 ? 0.2e-3 : 0.5e-3;
    r.lateral_strain_gauge = lateral;
    h.rows.push_back(r);
  }
  return h;
}

TEST(Elastic, StraightLineByGaugeAndByPlatens) {
  const History h = marble();
  EXPECT_NEAR(tangent(h).value / (50e9 / 0.9), 1.0, 1e-12);
  EXPECT_NEAR(tangent(h, middle, StrainFrom::platen).value / 50e9, 1.0, 1e-12);
  EXPECT_NEAR(secant(h).value / (50e9 / 0.9), 1.0, 1e-12);
  EXPECT_NEAR(secant(h, 0.5, StrainFrom::platen).value / 50e9, 1.0, 1e-12);
  EXPECT_NEAR(ratio(h).value, 0.25, 1e-12);
  EXPECT_NEAR(ratio(h, StrainFrom::platen).value, 0.225, 1e-12);
  EXPECT_EQ(tangent(h).note + secant(h).note + ratio(h).note, "");
}

TEST(Elastic, PiecewiseLinearByHand) {  // largest 110: the bend lies at 60 = 54.5 %
  EXPECT_NEAR(tangent(bent(), {0.1, 0.5}).value, 2000.0, 1e-9);
  EXPECT_NEAR(tangent(bent(), {0.6, 0.9}).value, 1000.0, 1e-9);
  EXPECT_NEAR(secant(bent(), 0.5).value, 2000.0, 1e-9);
  EXPECT_NEAR(secant(bent(), 0.8).value, 88.0 / 0.058, 1e-9);
  EXPECT_NEAR(poisson_ratio(loading_branch(bent()), {0.1, 0.5}, StrainFrom::gauge, "nu").value, 0.2, 1e-12);
  EXPECT_NEAR(poisson_ratio(loading_branch(bent()), {0.6, 0.9}, StrainFrom::gauge, "nu").value, 0.5, 1e-12);
}

TEST(Elastic,
     TheRangeIsThatOfTheFirstPassage) {  // unloading and reloading after 60 % of ucs is not in the fit
  History h = marble();
  for (std::size_t i = 121; i < 150; ++i) h.rows[i].axial_stress = 45e6;
  EXPECT_NEAR(tangent(h).value / (50e9 / 0.9), 1.0, 1e-12);
  const auto rows = first_passage(loading_branch(h), middle);
  EXPECT_DOUBLE_EQ(rows.front().axial_stress, 40e6);
  EXPECT_DOUBLE_EQ(rows.back().axial_stress, 60e6);
}

/// The three measures of a range.
std::vector<Number> window(const History& h, StressRange range,
                           const std::vector<double>& crack_strains = {}) {
  std::vector<CrackEvent> cracks(crack_strains.size());
  for (std::size_t i = 0; i < cracks.size(); ++i) cracks[i].strain = crack_strains[i];
  return window_checks(loading_branch(h), cracks, range);
}

// 0.4 to 0.6318 of 110: rows 22 to 30, where nu is 0.2, and as many, 31 to 39, where it is 0.5.
TEST(Window, NuChangesByTwiceItsSpread) {
  EXPECT_NEAR(value(window(bent(), {0.4, 0.6318}), "nu_spread"), 0.15, 1e-12);
  EXPECT_NEAR(value(window(bent(), {0.1, 0.5}), "nu_spread"), 0.0, 1e-12);
}

TEST(Window, TheAreaShrinksByOneLessNu) {
  EXPECT_NEAR(value(window(marble(), middle), "area_change"), 0.75, 1e-12);
  EXPECT_NEAR(value(window(straight(50e9, 1.6, 100e6, 200), middle), "area_change"), -0.6, 1e-9);
}

// The range is that of rows 22 to 36, strains 0.022 to 0.036; the peak is at 0.080.
TEST(Window, CracksOfTheRangeOverThoseUpToTheStrength) {
  EXPECT_NEAR(value(window(bent(), middle, {0.01, 0.023, 0.03, 0.0355, 0.05, 0.09}), "cracks_in_window"), 0.6,
              1e-12);
  EXPECT_EQ(value(window(bent(), middle, {0.01, 0.023, 0.03, 0.05, 0.09}), "cracks_in_window"), 0.0)
      << "two may be chance";
}

TEST(Window, WithFewRowsNothingIsKnownOfIt) {
  for (const Number& n : window(straight(50e9, 0.25, 100e6, 10), {0.4, 0.5})) {
    if (n.name != "cracks_in_window") {
      EXPECT_TRUE(std::isnan(n.value)) << n.name;
    }
  }
  for (const Number& n : window(History{}, middle)) EXPECT_TRUE(std::isnan(n.value)) << n.name;
}

TEST(Elastic, ScalingTheStressScalesTheModuliAlone) {
  History h = bent();
  const double E = tangent(h).value, S = secant(h, 0.8).value, nu = ratio(h).value;
  for (HistoryRow& r : h.rows) r.axial_stress *= 2.0;
  EXPECT_EQ(tangent(h).value, 2.0 * E);
  EXPECT_EQ(secant(h, 0.8).value, 2.0 * S);
  EXPECT_EQ(ratio(h).value, nu);
}

TEST(Elastic, ScalingTheStrainsScalesTheModuliInversely) {
  History h = bent();
  const double E = tangent(h).value, nu = ratio(h).value;
  for (HistoryRow& r : h.rows) r.axial_strain_gauge *= 4.0, r.lateral_strain_gauge *= 4.0;
  EXPECT_EQ(tangent(h).value, 0.25 * E);
  EXPECT_EQ(ratio(h).value, nu);
}

TEST(Elastic, RowsAfterThePeakChangeNothing) {
  History h = bent();
  const double E = tangent(h).value, S = secant(h).value, nu = ratio(h).value;
  for (int i = 0; i < 500; ++i) {
    HistoryRow r = h.rows.back();
    r.axial_stress = 30.0 + i % 50, r.axial_strain_gauge += 1e-4;
    h.rows.push_back(r);
  }
  EXPECT_EQ(tangent(h).value, E);
  EXPECT_EQ(secant(h).value, S);
  EXPECT_EQ(ratio(h).value, nu);
}

TEST(Elastic, NoiseAveragesOut) {  // +-0.2 MPa on 40 rows spanning 20 MPa: standard error of the slope 0.3 %
  History h = marble();
  for (std::size_t i = 0; i < h.rows.size(); ++i)
    h.rows[i].axial_stress +=
        0.4e6 * (0.618034 * static_cast<double>(i) - std::floor(0.618034 * static_cast<double>(i)) - 0.5);
  const Number n = tangent(h);
  EXPECT_NEAR(n.value / (50e9 / 0.9), 1.0, 0.01);
  EXPECT_EQ(n.note, "");
}

TEST(Elastic, WhereTheStressNeverRises) {
  const History h;
  for (const Number& n : {tangent(h), secant(h), ratio(h)}) {
    EXPECT_TRUE(std::isnan(n.value));
    EXPECT_EQ(n.note, "the stress never rises above zero");
  }
}

TEST(Elastic, TooFewRows) {
  const Number n = tangent(straight(50e9, 0.25, 100e6, 10), {0.4, 0.5});
  EXPECT_TRUE(std::isnan(n.value));
  EXPECT_EQ(n.note,
            "only 2 usable rows between 40 and 50 % of the largest stress, 3 are needed: write the history "
            "more often");
}

TEST(Elastic, WithoutAPeakTheLargestStressCounts) {
  const Number n = tangent(unfinished());
  EXPECT_EQ(n.value, tangent(marble()).value);
  EXPECT_EQ(n.note, "no peak and no knee: the largest stress is 100 MPa");
  EXPECT_EQ(secant(unfinished()).note, n.note);
}

TEST(Elastic, HistoryThatStartsLate) {  // as after an affine pre-strain
  History h = marble();
  h.rows.erase(h.rows.begin(), h.rows.begin() + 89);
  EXPECT_NEAR(tangent(h).value / (50e9 / 0.9), 1.0, 1e-12);
  EXPECT_EQ(tangent(h).note, "the history starts at 45 % of the largest stress");
  EXPECT_TRUE(std::isnan(tangent(h, {0.1, 0.2}).value));
  EXPECT_TRUE(std::isnan(secant(h, 0.4).value));
  EXPECT_EQ(secant(h, 0.4).note, "no row below 40 % of the largest stress");
}

TEST(Elastic, StrainAtRestOrBackwards) {
  History h = marble();
  for (HistoryRow& r : h.rows) r.axial_strain_gauge = 0.0;
  EXPECT_TRUE(std::isnan(tangent(h).value));
  EXPECT_EQ(tangent(h).note, "the strain does not change in the range");
  EXPECT_TRUE(std::isnan(secant(h).value));
  EXPECT_EQ(secant(h).note, "the strain at this stress is not positive");
}

TEST(Elastic, ScatterIsTold) {
  History h = marble();
  for (std::size_t i = 0; i < h.rows.size(); ++i) h.rows[i].lateral_strain_gauge += i % 2 == 0 ? 1e-3 : -1e-3;
  EXPECT_TRUE(ratio(h).note.starts_with("no straight line: R2 = 0.")) << ratio(h).note;
}

TEST(Elastic, RowsWithoutANumberArePassedOver) {
  History h = marble();
  for (const std::size_t i : {0u, 90u, 100u, 110u}) h.rows[i].axial_stress = std::nan("");
  h.rows[95].axial_strain_gauge = h.rows[99].axial_strain_gauge = std::nan("");
  EXPECT_NEAR(tangent(h).value / (50e9 / 0.9), 1.0, 1e-12);
  EXPECT_NEAR(secant(h).value / (50e9 / 0.9), 1.0, 1e-12);
  for (HistoryRow& r : h.rows) r.lateral_strain_gauge = std::nan("");  // no lateral gauge
  EXPECT_TRUE(std::isnan(ratio(h).value));
  EXPECT_TRUE(ratio(h).note.starts_with("only 0 usable rows"));
}

}  // namespace
}  // namespace phy::analysis
