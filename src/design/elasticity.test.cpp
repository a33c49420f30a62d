#include "design/elasticity.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace phy::design {
namespace {

using theory::TransverseIsotropy;

constexpr double per_mille = 1e-3;

/// Points of a body by rotating its compliance, as no formula of the fit does.
std::vector<ElasticPoint> points_of(const TransverseIsotropy& body, theory::PlaneState state) {
  std::vector<ElasticPoint> points;
  for (const double theta : {0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 90.0}) {
    const theory::PlaneCompliance S = rotated(plane_compliance(body, state), theta);
    points.push_back({theta, 1.0 / S.S_yy, -S.S_xy / S.S_yy});
  }
  return points;
}

void expect_body(const Fit& fit, const TransverseIsotropy& body) {
  ASSERT_TRUE(fit.ok()) << static_cast<int>(fit.refusal);
  const TransverseIsotropy found = body_of(fit);
  EXPECT_NEAR(found.E / body.E, 1.0, per_mille);
  EXPECT_NEAR(found.E_n / body.E_n, 1.0, per_mille);
  EXPECT_NEAR(found.nu / body.nu, 1.0, per_mille);
  EXPECT_NEAR(found.nu_n / body.nu_n, 1.0, per_mille);
  EXPECT_NEAR(found.G_n / body.G_n, 1.0, per_mille);
}

const TransverseIsotropy shale = {.E = 31e9, .E_n = 14e9, .nu = 0.27, .nu_n = 0.21, .G_n = 6.3e9};

TEST(Elasticity, FindsTheBodyInPlaneStress) {
  expect_body(
      fit_elasticity(points_of(shale, theory::PlaneState::stress), {theory::PlaneState::stress, shale.nu}),
      shale);
}

TEST(Elasticity, FindsTheBodyInPlaneStrain) {
  expect_body(
      fit_elasticity(points_of(shale, theory::PlaneState::strain), {theory::PlaneState::strain, shale.nu}),
      shale);
}

// Where nothing is given, Poisson's ratio in the planes is that of isotropic rock between them: of such rock
// it is right in both readings.
TEST(Elasticity, FindsRockBetweenPlanesWithoutBeingToldNu) {
  const TransverseIsotropy jointed =
      theory::ti_from_goodman({.E = 30e9, .K_n_delta = 40e9, .K_s_delta = 11e9, .nu = 0.24});
  for (const auto state : {theory::PlaneState::stress, theory::PlaneState::strain})
    expect_body(fit_elasticity(points_of(jointed, state), {state}), jointed);
}

TEST(Elasticity, RefusesBodiesThatNobodyHas) {
  auto points = points_of(shale, theory::PlaneState::stress);
  EXPECT_EQ(fit_elasticity(points, {theory::PlaneState::stress, 0.99}).refusal, Refusal::not_admissible);
  points.resize(2);
  EXPECT_EQ(fit_elasticity(points).refusal, Refusal::too_few);
  // Loads along and across the planes do not shear them: G' changes nothing.
  const auto ends = points_of(shale, theory::PlaneState::stress);
  EXPECT_EQ(fit_elasticity({ends[0], ends[0], ends[6]}).refusal, Refusal::undetermined);
}

}  // namespace
}  // namespace phy::design
