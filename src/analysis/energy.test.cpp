#include "analysis/energy.hpp"

#include <gtest/gtest.h>

#include "analysis/histories_fixture.hpp"

namespace phy::analysis {
namespace {

std::vector<Number> budget(const History& h) { return energy_budget(loading_branch(h), h); }
std::vector<Number> checked(const History& h, const WavePath& path = {}) {
  return run_checks(loading_branch(h), h, path);
}

TEST(Energy, BudgetAtThePeakAndAtTheEnd) {  // marble: work 1 J/m per row, peak in the 200th of 300 rows
  History h = marble();
  h.rows[199].slip = 7.0;
  h.rows.back().slip = 9.0;
  const auto numbers = budget(h);
  EXPECT_EQ(value(numbers, "energy_boundary_work_at_peak"), 200.0);
  EXPECT_EQ(value(numbers, "energy_boundary_work"), 300.0);
  EXPECT_EQ(value(numbers, "energy_strain_bond_at_peak"), 100.0);
  EXPECT_EQ(value(numbers, "energy_slip_at_peak"), 7.0);
  EXPECT_EQ(value(numbers, "energy_slip"), 9.0);
  EXPECT_EQ(numbers.size(), 18u);
  for (const Number& n : numbers) EXPECT_EQ(n.unit, "J/m");
}

TEST(Energy, WithoutAPeakOnlyTheEnd) {
  const auto numbers = budget(unfinished());
  EXPECT_EQ(value(numbers, "energy_boundary_work"), 200.0);
  EXPECT_TRUE(std::isnan(value(numbers, "energy_boundary_work_at_peak")));
  EXPECT_TRUE(note(numbers, "energy_boundary_work_at_peak").starts_with("no peak"));
}

TEST(Energy, ALaboratoryCurveHasNone) {
  History h = marble();
  for (HistoryRow& r : h.rows) r.boundary_work = r.strain_bond = 0.0;
  for (const auto& numbers : {budget(h), checked(h)}) {
    for (const Number& n : numbers) {
      if (n.name.starts_with("platen") || n.name == "rows_to_peak" || n.name == "wave_transits" ||
          n.name == "peak_confirmed")
        continue;
      EXPECT_TRUE(std::isnan(n.value)) << n.name;
      EXPECT_EQ(n.note, "the history holds no energies") << n.name;
    }
  }
}

TEST(RunChecks, LargestErrorsOfTheBalance) {
  History h = marble();
  h.rows[50].energy_error = -0.5;  // of a work of 51; the largest work is 300
  h.rows[0].energy_error = 0.8;    // of a work of 1
  EXPECT_NEAR(value(checked(h), "energy_error"), 0.5 * 51.0 / 300.0, 1e-12);
  EXPECT_NEAR(value(checked(h), "energy_error_of_row"), 0.8, 1e-12);
}

TEST(RunChecks, KineticEnergyFromTwentyPercentToThePeak) {
  History h = marble();
  h.rows[10].kinetic = 5.0;    // start-up: not counted
  h.rows[99].kinetic = 1.0;    // of 50 stored
  h.rows[250].kinetic = 90.0;  // after the peak: not counted
  EXPECT_NEAR(value(checked(h), "kinetic_ratio"), 0.02, 1e-12);
}

TEST(RunChecks, PlatensBeforeThePeak) {
  History h = marble();
  h.rows[60].stress_top += 3e6;
  h.rows[250].stress_top += 50e6;  // after the peak
  EXPECT_NEAR(value(checked(h), "platen_difference"), 0.03, 1e-12);
  EXPECT_EQ(value(checked(h), "platen_difference_95"), 0.0);
  for (std::size_t i = 0; i < 200; ++i)
    h.rows[i].stress_top = h.rows[i].stress_bottom + 1e4 * static_cast<double>(i);
  EXPECT_NEAR(value(checked(h), "platen_difference_95"), 0.019, 1e-9);  // 190 of 200 rows lie below
}

TEST(RunChecks, MissingPlatenStressesAndNoPeak) {
  History h = marble();
  for (HistoryRow& r : h.rows) r.stress_top = std::nan("");
  EXPECT_TRUE(std::isnan(value(checked(h), "platen_difference")));
  EXPECT_EQ(note(checked(h), "platen_difference"), "the history has no platen stresses");
  EXPECT_TRUE(note(checked(unfinished()), "platen_difference").starts_with("no peak"));
  EXPECT_EQ(value(checked(unfinished()), "platen_difference"), 0.0);
}

TEST(RunChecks, RowsAndWaveTransitsToThePeak) {
  // Marble: 100 MPa at a strain of 0.002. At 0.1 1/s that takes 20 ms; a wave of sqrt(50 GPa / 2000 kg/m^3) =
  // 5000 m/s crosses 0.1 m in 20 us: a thousand times.
  History h = marble();
  for (HistoryRow& r : h.rows) r.time = r.axial_strain / 0.1;
  EXPECT_EQ(value(checked(h), "rows_to_peak"), 200.0);
  EXPECT_NEAR(value(checked(h, {2000.0, 0.1}), "wave_transits"), 1000.0, 1e-6);
  EXPECT_NEAR(value(checked(h, {2000.0, 0.1, 4.0}), "wave_transits"), 2000.0, 1e-6);  // E four times as large
  EXPECT_TRUE(std::isnan(value(checked(h), "wave_transits")));
}

TEST(RunChecks, APeakIsConfirmedByAFallOrByStrainBehindIt) {
  // Marble falls by 1 % of its strength with every second row behind the 200th; its last row is at half of
  // it.
  EXPECT_NEAR(value(checked(marble()), "peak_confirmed"), 0.5 / 0.2, 1e-12);
  History h = marble();
  h.rows.resize(211);                            // 11 rows on: 5.5 % lower, 5.5 % more strain
  const auto over = [&](const StopRule& stop) {  // the recipe's idea of a peak
    return value(run_checks(loading_branch(h, stop), h, {}), "peak_confirmed");
  };
  EXPECT_TRUE(std::isnan(over({}))) << "no peak by the usual rule";
  EXPECT_NEAR(over({.stop_at = 0.95}), 0.055 / 0.2, 1e-9);
  for (std::size_t i = 200; i < h.rows.size(); ++i) h.rows[i].axial_stress = 99e6;
  h.rows.back().axial_strain = 0.0035;  // 75 % more strain, at 99 % of the peak
  EXPECT_NEAR(over({.post_peak = 0.5}), 0.75 / 0.5, 1e-9);
  EXPECT_TRUE(std::isnan(value(checked(unfinished()), "peak_confirmed")));
}

TEST(RunChecks, WaveTransitsCountByTheSpeedOfTheEnd) {
  // Ten times as fast from the middle of the way on, as after a ramp: the slow half does not help.
  History h = marble();
  for (HistoryRow& r : h.rows)
    r.time = std::min(r.axial_strain, 0.001) / 0.1 + std::max(0.0, r.axial_strain - 0.001);
  EXPECT_NEAR(value(checked(h, {2000.0, 0.1}), "wave_transits"), 0.002 * 5000.0 / 0.1, 1e-6);
  h.rows.erase(h.rows.begin(), h.rows.begin() + 198);  // a peak in the second row
  EXPECT_NEAR(value(checked(h, {2000.0, 0.1}), "wave_transits"), 100.0, 1e-6);
  h.rows.erase(h.rows.begin());  // in the first
  EXPECT_TRUE(std::isnan(value(checked(h, {2000.0, 0.1}), "wave_transits")));
}

}  // namespace
}  // namespace phy::analysis
