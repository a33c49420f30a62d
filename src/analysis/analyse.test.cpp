// Numbers of histories whose answers are known by construction.
#include "analysis/analyse.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace phy {
namespace {

/// Straight line of modulus E and Poisson's ratio nu up to ucs in n rows, then a drop to half in n/2 rows.
History straight(double E, double nu, double ucs, int n) {
  History h;
  for (int i = 1; i <= n + n / 2; ++i) {
    HistoryRow r;
    r.axial_strain = ucs / E * i / n;
    r.axial_stress = i <= n ? E * r.axial_strain : ucs * (1.0 - static_cast<double>(i - n) / n);
    r.axial_strain_gauge = 0.9 * r.axial_strain;
    r.lateral_strain_gauge = -nu * r.axial_strain_gauge;
    r.stress_top = r.stress_bottom = r.axial_stress;
    r.boundary_work = i;
    h.rows.push_back(r);
  }
  return h;
}

double value(const std::vector<Number>& numbers, const std::string& name) {
  const Number* n = find(numbers, name);
  return n != nullptr ? n->value : -1.0;
}

TEST(Analyse, StraightLine) {
  const auto numbers = analyse(straight(50e9, 0.25, 100e6, 200), {});
  EXPECT_DOUBLE_EQ(value(numbers, "ucs"), 100e6);
  EXPECT_NEAR(value(numbers, "peak_strain"), 0.002, 1e-15);
  EXPECT_NEAR(value(numbers, "E_tangent") / (50e9 / 0.9), 1.0, 1e-12);
  EXPECT_NEAR(value(numbers, "E_secant") / (50e9 / 0.9), 1.0, 1e-12);
  EXPECT_NEAR(value(numbers, "E_small") / (50e9 / 0.9), 1.0, 1e-12);
  EXPECT_NEAR(value(numbers, "E_tangent_platen") / 50e9, 1.0, 1e-12);
  EXPECT_NEAR(value(numbers, "nu"), 0.25, 1e-12);
}

TEST(Analyse, SecantAndTangentDifferOnABentCurve) {
  History h;
  for (int i = 1; i <= 1000; ++i) {  // s = e - e^2/2 up to its peak s = 1/2 at e = 1
    HistoryRow r;
    r.axial_strain = r.axial_strain_gauge = i / 1000.0;
    r.axial_stress = r.axial_strain - 0.5 * r.axial_strain * r.axial_strain;
    h.rows.push_back(r);
  }
  const auto numbers = analyse(h, {});
  const double e50 = 1.0 - std::sqrt(0.5);
  EXPECT_NEAR(value(numbers, "E_secant"), 0.25 / e50, 1e-5);
  EXPECT_NEAR(value(numbers, "E_tangent"), 1.0 - e50, 5e-3);
}

TEST(Analyse, CrackInitiationAtTheThirdCrackOrOnePercent) {
  const History h = straight(50e9, 0.25, 100e6, 200);
  std::vector<CrackEvent> cracks(1000);
  for (std::size_t i = 0; i < cracks.size(); ++i) cracks[i].strain = 0.001 + 1e-6 * static_cast<double>(i);
  EXPECT_NEAR(value(analyse(h, cracks), "sigma_ci"), 50e9 * (0.001 + 9e-6), 1.0);  // 1 % of 1000 = the tenth
  EXPECT_NEAR(value(analyse(h, cracks), "sigma_first_crack"), 50e9 * 0.001, 1.0);
  cracks.resize(40);
  EXPECT_NEAR(value(analyse(h, cracks), "sigma_ci"), 50e9 * (0.001 + 2e-6), 1.0);
  cracks.resize(2);
  const auto few = analyse(h, cracks);
  EXPECT_TRUE(std::isnan(value(few, "sigma_ci")));
  EXPECT_EQ(find(few, "sigma_ci")->note, "fewer than 3 cracks before the peak");
}

TEST(Analyse, CracksAreCountedByModeAndPlace) {
  const History h = straight(50e9, 0.25, 100e6, 200);
  std::vector<CrackEvent> cracks(5);
  cracks[0].mode = CrackMode::shear;
  cracks[1].place = CrackPlace::bedding;
  cracks[4].strain = 1.0;  // after the peak
  const auto numbers = analyse(h, cracks);
  EXPECT_EQ(value(numbers, "cracks_tension_matrix"), 3.0);
  EXPECT_EQ(value(numbers, "cracks_tension_matrix_at_peak"), 2.0);
  EXPECT_EQ(value(numbers, "cracks_shear_matrix"), 1.0);
  EXPECT_EQ(value(numbers, "cracks_tension_bedding"), 1.0);
}

TEST(Analyse, VolumeReversal) {
  History h = straight(50e9, 0.25, 100e6, 200);
  for (std::size_t i = 150; i < h.rows.size(); ++i)
    h.rows[i].lateral_strain_gauge -= 2e-5 * static_cast<double>(i - 149);
  EXPECT_NEAR(value(analyse(h, {}), "sigma_cd"), h.rows[149].axial_stress, 1.0);
  EXPECT_TRUE(std::isnan(value(analyse(straight(50e9, 0.25, 100e6, 200), {}), "sigma_cd")));
}

TEST(Analyse, RowsAfterThePeakChangeNothingBeforeIt) {
  History h = straight(50e9, 0.25, 100e6, 200);
  const auto with = analyse(h, {});
  h.rows.resize(200);
  const auto without = analyse(h, {});
  for (const char* name : {"ucs", "E_tangent", "E_secant", "nu"})
    EXPECT_EQ(value(with, name), value(without, name));
}

TEST(Analyse, NoHistoryGivesNotesNotCrashes) {
  for (const Number& n : analyse(History{}, {})) {
    if (n.name.rfind("cracks_", 0) == 0) continue;
    EXPECT_TRUE(std::isnan(n.value)) << n.name;
    EXPECT_FALSE(n.note.empty()) << n.name;
  }
  History one;
  one.rows.resize(1);
  one.rows[0].axial_stress = 5.0;
  EXPECT_EQ(value(analyse(one, {}), "ucs"), 5.0);
}

TEST(Analyse, LargestErrorsAreReported) {
  History h = straight(50e9, 0.25, 100e6, 200);
  h.rows[50].energy_error = -0.5;  // of a work of 51; the total is 300
  h.rows[60].stress_top += 3e6;
  const auto numbers = analyse(h, {});
  EXPECT_NEAR(value(numbers, "energy_error"), 0.5 * 51 / 300, 1e-12);
  EXPECT_NEAR(value(numbers, "platen_difference"), 0.03, 1e-12);
  EXPECT_EQ(value(numbers, "platen_difference_95"), 0.0);
}

}  // namespace
}  // namespace phy
