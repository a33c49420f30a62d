// Each law's stated tangent stiffness against the finite difference of its force update.
#include <gtest/gtest.h>

#include "laws/laws.hpp"

namespace phy::statics {
namespace {

constexpr double step = 1e-9;

/// Slopes of a law at a state, by one small step in each movement. `respond` takes increments and closures.
template <class Law>
laws::Tangent<double> slopes(const Law& law) {
  const laws::Reaction<double> still = law(0.0, 0.0, 0.0);
  return {(law(step, 0.0, 0.0).F_n - still.F_n) / step, -(law(0.0, step, 0.0).F_s - still.F_s) / step,
          -(law(0.0, 0.0, step).M - still.M) / step};
}

void expect_equal(const laws::Tangent<double>& stated, const laws::Tangent<double>& found) {
  EXPECT_NEAR(found.k_n, stated.k_n, 1e-6 * stated.k_n);
  EXPECT_NEAR(found.k_s, stated.k_s, 1e-6 * stated.k_s);
  EXPECT_NEAR(found.k_m, stated.k_m, 1e-6 * stated.k_m);
}

TEST(Tangent, ClosedStickingLinearContact) {
  const laws::linear::Parameters<double> p{38e9, 11.4e9, 1.0 / 11.4e9, 0.8};
  expect_equal(laws::linear::tangent(p), slopes([&](double n, double s, double w) {
                 laws::linear::State<double> state{100.0};
                 return laws::linear::respond(p, state, laws::Motion<double>{1e-7 + n, n, s, w});
               }));
}

TEST(Tangent, BondUnderTensionShearAndBending) {
  const laws::parallel_bond::Parameters<double> p{32e9, 9.6e9, 1e3, 9000.0, 40e3, 0.0, 0.0};
  const auto law = [&](double n, double s, double w) {
    laws::parallel_bond::State<double> state{500.0, 40e3};
    return laws::parallel_bond::respond(p, state, laws::Motion<double>{-1e-7 + n, n, s, 1e-6 + w});
  };
  ASSERT_FALSE(laws::broke(law(0.0, 0.0, 0.0)));
  expect_equal(laws::parallel_bond::tangent(p), slopes(law));
}

TEST(Tangent, BondedSmoothJoint) {
  const laws::smooth_joint::Parameters<double> p{2e9, 0.6e9, 0.4, 18e3, 0.0, 0.1, 0.0};
  const auto law = [&](double n, double s, double w) {
    laws::smooth_joint::State<double> state{200.0, -1e-6, 6e3, 0.0};
    return laws::smooth_joint::respond(p, state, laws::Motion<double>{0.0, n, s, w});
  };
  ASSERT_FALSE(laws::broke(law(0.0, 0.0, 0.0)));
  expect_equal(laws::smooth_joint::tangent(p), slopes(law));
}

TEST(Tangent, BrokenSmoothJointThatSticks) {
  const laws::smooth_joint::Parameters<double> p{2e9, 0.6e9, 0.4, 18e3, 0.0, 0.1, 0.0};
  expect_equal(laws::smooth_joint::tangent(p), slopes([&](double n, double s, double w) {
                 laws::smooth_joint::State<double> state{200.0, 1e-6, 0.0, 0.0};
                 return laws::smooth_joint::respond(p, state, laws::Motion<double>{0.0, n, s, w});
               }));
}

}  // namespace
}  // namespace phy::statics
