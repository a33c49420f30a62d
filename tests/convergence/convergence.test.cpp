// The order in which errors vanish, measured: with the time step, with the speed of the platens, with the
// number of grains. A scheme that has lost its order is wrong before its numbers are.
#include <gtest/gtest.h>

#include <cmath>

#include "base/exact_math.hpp"
#include "engine/lane_group.hpp"
#include "genesis/specimen.hpp"
#include "records/assembly.hpp"
#include "statics/uniaxial.hpp"
#include "study/experiment.hpp"
#include "study/worker.hpp"

namespace phy {
namespace {

constexpr double R = 1e-3;

/// p of error ~ h^p from errors at h, h/2, h/4, ...
std::vector<double> orders(const std::vector<double>& errors) {
  std::vector<double> p;
  for (std::size_t i = 1; i < errors.size(); ++i) p.push_back(std::log2(errors[i - 1] / errors[i]));
  return p;
}

/// Angular frequency with which two bonded discs swing against each other along their branch, as stepped.
double stepped_frequency(double step_safety) {
  Specimen s = assembly({{0.0, 0.0, R}, {2.0 * R, 0.0, R}}, soft_contact());
  bond_touching(s);
  const auto specimen = std::make_shared<const Specimen>(std::move(s));
  engine::GroupOptions options;
  options.isa = engine::native_isa(), options.interval = 1;
  const auto group = engine::make_group(specimen->packing, options);
  engine::LaneSetup setup;
  setup.damping = 0.0, setup.step_safety = step_safety;
  group->load(0, specimen, setup);
  group->set_motion(0, 0, {}, {1e-6, 0.0}, 0.0);
  group->set_motion(0, 1, {}, {-1e-6, 0.0}, 0.0);
  std::vector<double> u{0.0};
  for (int i = 0; i < 400; ++i) {
    group->advance();
    u.push_back(group->snapshot(0).grains[0].ux);
  }
  double above = 0.0, below = 0.0;  // u(n+1) + u(n-1) = 2 cos(w dt) u(n)
  for (std::size_t i = 1; i + 1 < u.size(); ++i) above += (u[i + 1] + u[i - 1]) * u[i], below += u[i] * u[i];
  return std::acos(0.5 * above / below) / group->time_step(0);
}

// Two discs of mass m, a spring E_b A / L between them with A = L = 2 R: w^2 = 2 E_b / m.
TEST(Convergence, TheTimeStepIsOfSecondOrder) {
  const MatrixRecipe m = soft_contact();
  const double exact = std::sqrt(2.0 * m.E_b / (m.density * pi * R * R));
  std::vector<double> errors;
  for (const double safety : {0.4, 0.2, 0.1, 0.05}) errors.push_back(stepped_frequency(safety) / exact - 1.0);
  for (const double p : orders(errors)) EXPECT_NEAR(p, 2.0, 0.1);
  EXPECT_NEAR(orders(errors).back(), 2.0, 0.01);
  // Of the leap-frog: w dt / 2 = asin(w_exact dt / 2), so the error is (w dt)^2 / 24 to lowest order.
  EXPECT_GT(errors.back(), 0.0);
}

/// Of an elastic press at a speed [m/s] per platen: kinetic energy over boundary work, mean of the second
/// half of the test.
double kinetic_ratio(const Specimen& specimen, Recipe r, double speed) {
  r.test.platen_speed = speed, r.test.ramp_strain = 1e-4, r.test.max_strain = 1e-3, r.test.stop_at = 0.0;
  r.matrix.unbreakable = true;
  auto s = std::make_shared<Specimen>(specimen);
  s->matrix.unbreakable = true;
  const TestResult result = study::run_tests({s}, r, {}).front();
  double sum = 0.0, n = 0.0;
  for (const HistoryRow& row : result.history.rows)
    if (row.axial_strain > 5e-4) sum += row.kinetic / row.boundary_work, n += 1.0;
  return sum / n;
}

// Once the waves of the start have died away, grains move in proportion to the platens: kinetic energy goes
// with the square of their speed, the work to a given strain does not.
TEST(Convergence, InertiaVanishesWithTheSquareOfThePlatenSpeed) {
  Recipe r;
  r.specimen = {0.008, 0.016};
  r.packing.n_grains = 330;
  r.bedding.resize(1);
  r.bedding[0].theta = 45.0, r.bedding[0].spacing = 0.002;
  const auto s = study::specimen_of(study::packing_of(r), r);
  std::vector<double> ratios;
  for (const double speed : {0.4, 0.2, 0.1, 0.05, 0.025}) ratios.push_back(kinetic_ratio(*s, r, speed));
  for (const double p : orders(ratios)) EXPECT_GT(p, 1.5) << "waves of the start";
  EXPECT_NEAR(orders(ratios).back(), 2.0, 0.1);
}

// Between rigid platens a lattice has a boundary layer of a fixed number of rows: E over the platens differs
// from E of the middle by its share of the height.
TEST(Convergence, TheEffectOfThePlatensFallsWithTheHeightInGrains) {
  std::vector<double> errors;
  for (const int n : {8, 16, 32, 64}) {
    MatrixRecipe m;
    Specimen s = assembly(hexagonal(n, 2 * n + 1, R), m);
    bond_touching(s);
    statics::UniaxialStatics solver;
    statics::ElasticOptions options;
    options.bilateral = true;
    const ElasticResult e = solver.solve(s, options);
    ASSERT_TRUE(e.outcome.ok());
    errors.push_back(std::fabs(e.E_platen / e.E_gauge - 1.0));
  }
  for (const double p : orders(errors)) EXPECT_GT(p, 0.8);
  EXPECT_NEAR(orders(errors).back(), 1.0, 0.05);
}

}  // namespace
}  // namespace phy
