// The strip between clamped ends, built from its polynomial stress field: sigma_x = sigma_normal = 0 on the
// sides, strains compatible, axis clamped at both ends. Axial coordinate a, transverse coordinate b, half
// width h:
//   tau = c0 (b^2 - h^2), sigma_a = -2 c0 a b + c2 - 2 c0 (S_ys/S_yy) b^2, sigma_b = 0.
#include "theory/end_constraint.hpp"

#include <gtest/gtest.h>

namespace phy::theory {
namespace {

struct Strip {
  PlaneCompliance S;
  double height, h;  // h: half width
  double c0, c2;
  double k() const { return -S.S_yy * c0 * height * height / 12.0; }
  double stress(double a, double b) const {
    return -2.0 * c0 * a * b + c2 - 2.0 * c0 * S.S_ys / S.S_yy * b * b;
  }
  double shear(double b) const { return c0 * (b * b - h * h); }
  double u(double a, double b) const {  // axial displacement
    return S.S_yy * (-c0 * a * a * b + c2 * a) - 2.0 * S.S_ys * c0 * b * b * a +
           S.S_ys * c0 * (b * b - h * h) * a + f(b);
  }
  double v(double a, double b) const {  // transverse displacement
    return S.S_xy * (-c0 * a * b * b + c2 * b - 2.0 / 3.0 * c0 * S.S_ys / S.S_yy * b * b * b) +
           S.S_xs * c0 * (b * b * b / 3.0 - h * h * b) + S.S_yy * c0 * a * a * a / 3.0 + k() * a;
  }
  double f(double b) const {
    const double cubic = (S.S_xy + S.S_ss - 2.0 * S.S_ys * S.S_ys / S.S_yy) * c0 / 3.0;
    return cubic * b * b * b + (S.S_ys * c2 - S.S_ss * c0 * h * h - k()) * b;
  }
};

Strip clamped_strip(const PlaneCompliance& S, double slenderness) {
  Strip s{S, 2.0 * slenderness, 1.0, 0.0, 1.0};
  s.c0 = 6.0 * S.S_ys * s.c2 / (6.0 * S.S_ss * s.h * s.h + S.S_yy * s.height * s.height);
  return s;
}

// Central differences are exact for these cubics in exact arithmetic except for a third-derivative term; the
// step is small enough to leave 1e-6.
constexpr double step = 1e-3;

TEST(EndConstraint, StressFieldIsElasticAndClamped) {
  const PlaneCompliance S = rotated(plane_compliance({3.0, 1.0, 0.2, 0.1, 0.4}, PlaneState::stress), 60.0);
  const Strip s = clamped_strip(S, 2.0);
  for (double a : {-1.5, -0.3, 0.7, 1.9})
    for (double b : {-0.9, 0.0, 0.4}) {
      const double eps_a = (s.u(a + step, b) - s.u(a - step, b)) / (2.0 * step);
      const double eps_b = (s.v(a, b + step) - s.v(a, b - step)) / (2.0 * step);
      const double gamma = (s.u(a, b + step) - s.u(a, b - step)) / (2.0 * step) +
                           (s.v(a + step, b) - s.v(a - step, b)) / (2.0 * step);
      EXPECT_NEAR(eps_a, S.S_yy * s.stress(a, b) + S.S_ys * s.shear(b), 2e-6);
      EXPECT_NEAR(eps_b, S.S_xy * s.stress(a, b) + S.S_xs * s.shear(b), 2e-6);
      EXPECT_NEAR(gamma, S.S_ys * s.stress(a, b) + S.S_ss * s.shear(b), 2e-6);
    }
  for (double end : {-0.5 * s.height, 0.5 * s.height}) {
    EXPECT_NEAR(s.v(end, 0.0), 0.0, 1e-13);
    EXPECT_NEAR((s.u(end, step) - s.u(end, -step)) / (2.0 * step), 0.0, 2e-6);
  }
  EXPECT_EQ(s.shear(s.h), 0.0);
}

TEST(EndConstraint, RatiosAreThoseOfTheField) {
  for (double theta : {15.0, 30.0, 45.0, 60.0, 75.0})
    for (double slenderness : {1.0, 2.0, 2.5}) {
      const PlaneCompliance S =
          rotated(plane_compliance(TransverseIsotropy{3.0, 1.0, 0.2, 0.1, 0.4}, PlaneState::stress), theta);
      const Strip s = clamped_strip(S, slenderness);
      const double strain = (s.u(0.5 * s.height, 0.0) - s.u(-0.5 * s.height, 0.0)) / s.height;
      const double mean = s.c2 - 2.0 / 3.0 * s.c0 * S.S_ys / S.S_yy * s.h * s.h;
      EXPECT_NEAR(end_constraint_ratio(S, slenderness), s.c2 / strain * S.S_yy, 1e-12);
      EXPECT_NEAR(end_constraint_mean_ratio(S, slenderness), mean / strain * S.S_yy, 1e-12);
    }
}

TEST(EndConstraint, VanishesWithoutCouplingAndForSlenderSpecimens) {
  const TransverseIsotropy m{45e9, 19e9, 0.24, 0.1, 7e9};
  const PlaneCompliance body = plane_compliance(m, PlaneState::stress);
  EXPECT_NEAR(end_constraint_ratio(rotated(body, 0.0), 2.0), 1.0, 1e-14);
  EXPECT_NEAR(end_constraint_ratio(rotated(body, 90.0), 2.0), 1.0, 1e-14);
  EXPECT_GT(end_constraint_ratio(rotated(body, 60.0), 2.0), 1.01);
  EXPECT_NEAR(end_constraint_ratio(rotated(body, 60.0), 200.0), 1.0, 1e-4);
  EXPECT_LT(end_constraint_mean_ratio(rotated(body, 60.0), 2.0),
            end_constraint_ratio(rotated(body, 60.0), 2.0));
}

}  // namespace
}  // namespace phy::theory
