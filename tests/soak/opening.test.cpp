// An opening in elastic rock beside closed forms: hoop stress behind the wall, mean over ten packings, in six
// directions at each of five inclinations of the foliation, against Lekhnitskii; without foliation against
// Kirsch. The block is eight diameters wide: stresses on the edge of a finite block raise those inside by the
// square of diameter over width. PHY_OPENING_PACKINGS sets the number of packings.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <vector>

#include "base/exact_math.hpp"
#include "genesis/packing.hpp"
#include "genesis/specimen.hpp"
#include "lab/opening/reading.hpp"
#include "setting.hpp"
#include "statics/uniaxial.hpp"
#include "study/experiment.hpp"
#include "study/worker.hpp"
#include "theory/opening.hpp"

namespace phy {
namespace {

constexpr int n_directions = 6;               // of 30 degrees, over half a turn
constexpr double grain = 0.25e-3 + 0.415e-3;  // mean diameter [m]
constexpr double radius = 15.0 * grain;       // of the opening
const std::vector<double> angles = {0.0, 22.5, 45.0, 67.5, 90.0};

Recipe rock(double stiffness_ratio, double side) {
  Recipe r;
  r.specimen = {side, side};
  r.packing.n_grains = std::lround(2.5e6 * side * side);
  r.matrix.stiffness_ratio = stiffness_ratio;
  r.matrix.unbreakable = true;
  return r;
}

Recipe block(double stiffness_ratio) {
  Recipe r = rock(stiffness_ratio, 16.0 * radius);
  r.test.kind = TestKind("opening");
  r.test.opening_diameter = 2.0 * radius;
  r.test.vertical_stress = 20e6, r.test.horizontal_stress = 10e6;
  r.test.platen_speed = 0.2;
  r.test.n_snapshots = r.test.n_frames = 0;
  if (r.matrix.directional()) r.test.angles = angles;
  return r;
}

std::vector<Specimen> specimens_of(Recipe r, std::int64_t seed) {
  r.packing.seed = r.matrix.bond_seed = seed;
  const auto packing =
      std::make_shared<const Packing>(genesis::make_packing(r.specimen, r.packing, r.matrix));
  return genesis::make_specimens(packing, r);
}

/// Of the rock without an opening, in the axes of its foliation: by direct solution, mean of ten packings.
theory::PlaneCompliance compliance(double stiffness_ratio) {
  Recipe r = rock(stiffness_ratio, 0.06);
  if (r.matrix.directional()) r.test.angles = {0.0, 45.0, 90.0};
  std::vector<double> soft(3, 0.0), across(3, 0.0);  // 1/E, nu/E
  const int n = 10;
  for (int seed = 1; seed <= n; ++seed) {
    const auto results = statics::solve_all(specimens_of(r, 100 + seed), {}, 2);
    for (std::size_t i = 0; i < 3; ++i) {
      const ElasticResult& e = results[results.size() == 1 ? 0 : i];
      soft[i] += 1.0 / e.E_gauge / n, across[i] += e.nu_gauge / e.E_gauge / n;
    }
  }
  theory::PlaneCompliance S;
  // At 0 the load is across the foliation.
  S.S_yy = soft[0], S.S_xx = soft[2], S.S_xy = -0.5 * (across[0] + across[2]);
  S.S_ss = 4.0 * soft[1] - S.S_xx - S.S_yy - 2.0 * S.S_xy;
  return S;
}

/// Mean over the ring and the sector of 30 degrees about a direction.
double expected(const theory::AnisotropicOpening& opening, double direction) {
  double sum = 0.0;
  const int n = 12;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double r =
          radius + grain * (lab::hoop_ring[0] + (lab::hoop_ring[1] - lab::hoop_ring[0]) * (i + 0.5) / n);
      const double angle = direction + 30.0 * ((j + 0.5) / n - 0.5);
      const SinCos at = sin_cos_degrees(angle);
      sum += theory::polar(opening.at(r * at.cos, r * at.sin), angle).hoop / (n * n);
    }
  return sum;
}

/// The same of a test: three sectors, and those opposite.
double found(const TestResult& t, int direction) {
  double sum = 0.0;
  for (const int side : {0, n_directions})
    for (const int k : {-1, 0, 1}) {
      const int sector = (3 * (direction + side) + k + lab::n_wall_sectors) % lab::n_wall_sectors;
      sum += t.wall[static_cast<std::size_t>(sector)].hoop / 6.0;
    }
  return sum;
}

class ElasticOpening : public testing::TestWithParam<double> {};

TEST_P(ElasticOpening, HasTheHoopStressOfTheClosedForm) {
  const Recipe r = block(GetParam());
  const int n = static_cast<int>(setting("PHY_OPENING_PACKINGS", 10));
  study::MachineOptions machine;
  machine.threads = 2;
  std::vector<std::vector<double>> hoop;  // per specimen and direction
  std::vector<double> closure;
  double energy_error = 0.0;
  for (int seed = 1; seed <= n; ++seed) {
    const auto specimens = specimens_of(r, seed);
    std::vector<std::shared_ptr<const Specimen>> tested;
    for (const Specimen& s : specimens) tested.push_back(std::make_shared<const Specimen>(s));
    const auto results = study::run_tests(tested, r, machine);
    hoop.resize(results.size(), std::vector<double>(n_directions, 0.0)), closure.resize(results.size(), 0.0);
    for (std::size_t i = 0; i < results.size(); ++i) {
      ASSERT_EQ(results[i].wall.size(), 2U * lab::n_wall_sectors) << results[i].outcome.reason;
      for (int d = 0; d < n_directions; ++d) hoop[i][static_cast<std::size_t>(d)] += found(results[i], d) / n;
      closure[i] += results[i].history.rows.back().closure / n;
      for (const HistoryRow& row : results[i].history.rows)
        energy_error = std::max(energy_error, std::fabs(row.energy_error));
    }
  }
  const theory::PlaneCompliance S = compliance(GetParam());
  const theory::Opening opening{radius, {10e6, 20e6, 0.0}, 0.0};
  for (std::size_t i = 0; i < hoop.size(); ++i) {
    const double theta = r.test.angles.empty() ? 0.0 : r.test.angles[i];
    const theory::AnisotropicOpening closed_form(theory::rotated(S, theta), opening);
    double inwards = 0.0;
    for (int a = 0; a < 36; ++a) inwards += closed_form.closure(10.0 * a, theory::Loaded::before_hole) / 36.0;
    std::printf("%g deg: closure %.3f of the closed form; hoop", theta, closure[i] * radius / inwards);
    for (int d = 0; d < n_directions; ++d) {
      const double ratio = hoop[i][static_cast<std::size_t>(d)] / expected(closed_form, 30.0 * d);
      std::printf(" %.3f", ratio);
      EXPECT_NEAR(ratio, 1.0, 0.05) << theta << " deg, direction " << 30 * d;
    }
    std::printf("\n");
  }
  std::printf("E along over across the foliation %.2f, energy error %.1e\n", S.S_yy / S.S_xx, energy_error);
  EXPECT_LT(energy_error, 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Rocks, ElasticOpening, testing::Values(1.0, 2.5));

}  // namespace
}  // namespace phy
