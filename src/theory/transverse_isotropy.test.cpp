// E(theta) and nu(theta) against the rotated compliance matrix.
#include "theory/transverse_isotropy.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "base/exact_math.hpp"

namespace phy::theory {
namespace {

const TransverseIsotropy shale{38e9, 19e9, 0.21, 0.16, 9e9};
const JointedRock jointed{45e9, 32e9, 8.3e9, 0.24};

TEST(TransverseIsotropy, ModulusAndPoissonAreTheRotatedCompliance) {
  const PlaneCompliance body = plane_compliance(shale, PlaneState::stress);
  for (double theta = 0.0; theta <= 180.0; theta += 7.5) {
    const PlaneCompliance S = rotated(body, theta);
    EXPECT_NEAR(ti_E(shale, theta) * S.S_yy, 1.0, 1e-12) << theta;
    EXPECT_NEAR(ti_nu(shale, theta), -S.S_xy / S.S_yy, 1e-12) << theta;
  }
}

TEST(TransverseIsotropy, JointedRockIsTheRotatedCompliance) {
  const TransverseIsotropy m = ti_from_goodman(jointed);
  const PlaneCompliance body = plane_compliance(m, PlaneState::stress);
  for (double theta : {0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 90.0}) {
    const PlaneCompliance S = rotated(body, theta);
    EXPECT_NEAR(goodman_E(jointed, theta) * S.S_yy, 1.0, 1e-12) << theta;
    EXPECT_NEAR(goodman_nu(jointed, theta), -S.S_xy / S.S_yy, 1e-12) << theta;
    EXPECT_NEAR(ti_E(m, theta) / goodman_E(jointed, theta), 1.0, 1e-12) << theta;
  }
}

// Rotation checked by energy: sigma . S sigma must not depend on the axes in which both are written.
TEST(TransverseIsotropy, RotationKeepsTheStrainEnergy) {
  const PlaneCompliance body = plane_compliance(shale, PlaneState::stress);
  const auto energy = [](const PlaneCompliance& S, double xx, double yy, double xy) {
    return S.S_xx * xx * xx + S.S_yy * yy * yy + S.S_ss * xy * xy + 2.0 * S.S_xy * xx * yy +
           2.0 * S.S_xs * xx * xy + 2.0 * S.S_ys * yy * xy;
  };
  const double theta = 33.0;
  const double t = theta * pi / 180.0;
  Eigen::Matrix2d R;  // columns: body axes seen from the fixed ones
  R << std::cos(t), -std::sin(t), std::sin(t), std::cos(t);
  Eigen::Matrix2d fixed;
  fixed << 3e6, 1.3e6, 1.3e6, -2e6;
  const Eigen::Matrix2d turned = R.transpose() * fixed * R;
  const double in_body = energy(body, turned(0, 0), turned(1, 1), turned(0, 1));
  EXPECT_NEAR(energy(rotated(body, theta), 3e6, -2e6, 1.3e6) / in_body, 1.0, 1e-13);
}

TEST(TransverseIsotropy, JointedRockAndContinuumAreInverse) {
  const JointedRock back = goodman_from_ti(ti_from_goodman(jointed));
  EXPECT_NEAR(back.E / jointed.E, 1.0, 1e-12);
  EXPECT_NEAR(back.K_n_delta / jointed.K_n_delta, 1.0, 1e-12);
  EXPECT_NEAR(back.K_s_delta / jointed.K_s_delta, 1.0, 1e-12);
  EXPECT_NEAR(back.nu, jointed.nu, 1e-12);
}

TEST(TransverseIsotropy, Eq1IsTheGeneralOrthotropicLawInThePlane) {
  const JointedRock same = goodman_from_ti(shale);
  for (double theta = 0.0; theta <= 90.0; theta += 5.0) {
    EXPECT_NEAR(goodman_E(same, theta) / ti_E(shale, theta), 1.0, 1e-12) << theta;
    EXPECT_NEAR(goodman_nu(same, theta), ti_nu(shale, theta), 1e-12) << theta;
  }
}

TEST(TransverseIsotropy, SaintVenantMakesTheCurveMonotone) {
  TransverseIsotropy m = shale;
  m.G_n = saint_venant_G(m.E, m.E_n, m.nu_n);
  const PlaneCompliance body = plane_compliance(m, PlaneState::stress);
  for (double theta = 0.0; theta <= 90.0; theta += 5.0) {
    EXPECT_NEAR(saint_venant_E(m.E, m.E_n, theta) * rotated(body, theta).S_yy, 1.0, 1e-12) << theta;
    if (theta < 90.0) {
      EXPECT_LT(saint_venant_E(m.E, m.E_n, theta), saint_venant_E(m.E, m.E_n, theta + 5.0));
    }
  }
}

TEST(TransverseIsotropy, JointedRockObeysSaintVenantOnlyForEqualStiffnesses) {
  TransverseIsotropy m = ti_from_goodman({45e9, 12e9, 12e9, 0.24});
  EXPECT_NEAR(m.G_n / saint_venant_G(m.E, m.E_n, m.nu_n), 1.0, 1e-13);
  m = ti_from_goodman({45e9, 13e9, 12e9, 0.24});
  EXPECT_GT(std::abs(m.G_n / saint_venant_G(m.E, m.E_n, m.nu_n) - 1.0), 1e-3);
}

TEST(TransverseIsotropy, ThreeTestsGiveTheConstantsBack) {
  const TransverseIsotropy m = ti_from_three_tests(ti_E(shale, 0.0), ti_E(shale, 45.0), ti_E(shale, 90.0),
                                                   ti_nu(shale, 0.0), shale.nu);
  EXPECT_NEAR(m.E / shale.E, 1.0, 1e-12);
  EXPECT_NEAR(m.E_n / shale.E_n, 1.0, 1e-12);
  EXPECT_NEAR(m.G_n / shale.G_n, 1.0, 1e-12);
  EXPECT_NEAR(m.nu_n, shale.nu_n, 1e-12);
}

Eigen::Matrix<double, 6, 6> compliance_6x6(const TransverseIsotropy& m) {  // axis 3 = normal to the planes
  Eigen::Matrix<double, 6, 6> S = Eigen::Matrix<double, 6, 6>::Zero();
  S(0, 0) = S(1, 1) = 1.0 / m.E;
  S(2, 2) = 1.0 / m.E_n;
  S(0, 1) = S(1, 0) = -m.nu / m.E;
  S(0, 2) = S(2, 0) = S(1, 2) = S(2, 1) = -m.nu_n / m.E_n;
  S(3, 3) = S(4, 4) = 1.0 / m.G_n;
  S(5, 5) = 2.0 * (1.0 + m.nu) / m.E;
  return S;
}

TEST(TransverseIsotropy, PlaneStrainHoldsTheThirdAxis) {
  const Eigen::Matrix<double, 6, 6> S6 =
      compliance_6x6(shale);  // bedding along x: planar axes 0 (x) and 2 (y), out 1
  const PlaneCompliance S = plane_compliance(shale, PlaneState::strain);
  EXPECT_NEAR(S.S_xx / (S6(0, 0) - S6(0, 1) * S6(0, 1) / S6(1, 1)), 1.0, 1e-13);
  EXPECT_NEAR(S.S_yy / (S6(2, 2) - S6(2, 1) * S6(2, 1) / S6(1, 1)), 1.0, 1e-13);
  EXPECT_NEAR(S.S_xy / (S6(0, 2) - S6(0, 1) * S6(2, 1) / S6(1, 1)), 1.0, 1e-13);
}

TEST(TransverseIsotropy, JointTermsAreTheSameInPlaneStrain) {
  const PlaneConstants seen = seen_in_plane_strain({jointed.E, jointed.nu});
  const JointedRock in_strain{seen.E, jointed.K_n_delta, jointed.K_s_delta, seen.nu};
  const PlaneCompliance body = plane_compliance(ti_from_goodman(jointed), PlaneState::strain);
  for (double theta = 0.0; theta <= 90.0; theta += 15.0)
    EXPECT_NEAR(goodman_E(in_strain, theta) * rotated(body, theta).S_yy, 1.0, 1e-12) << theta;
  const PlaneConstants back = body_from_plane_strain(seen);
  EXPECT_NEAR(back.E / jointed.E, 1.0, 1e-14);
  EXPECT_NEAR(back.nu, jointed.nu, 1e-14);
}

TEST(TransverseIsotropy, AdmissibilityIsPositiveEnergy) {
  TransverseIsotropy m = shale;
  for (double nu_n : {0.1, 0.4, 0.44, 0.45, 0.6}) {
    m.nu_n = nu_n;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> eigen(compliance_6x6(m) * 1e9);
    EXPECT_EQ(is_admissible(m), eigen.eigenvalues().minCoeff() > 0.0) << nu_n;
  }
  m = shale;
  m.G_n = -1e9;
  EXPECT_FALSE(is_admissible(m));
}

}  // namespace
}  // namespace phy::theory
