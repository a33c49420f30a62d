// What every law in the list must obey, driven along random paths: no motion gives no change, slip never
// makes energy, the mirror image of a motion gives the mirror image of the force, a broken bond never comes
// back, and a lane of a pack computes the same bits as a lone double.
#include <gtest/gtest.h>

#include <cmath>

#include "base/rng.hpp"
#include "laws/laws.hpp"

namespace phy {
namespace {

/// One law with its typical parameters, behind one interface: a step of motion in, a reaction out.
template <class R>
struct LinearProbe {
  static constexpr const char* name = "linear";
  linear::Parameters<R> p{R(38e9), R(11.4e9), R(1 / 11.4e9), R(0.8)};
  linear::State<R> s{R(0)};
  R closure = R(0);
  Reaction<R> step(R dc, R ds, R) {
    closure += dc;
    return linear::respond(p, s, Motion<R>{closure, dc, ds, R(0)});
  }
  R energy(const Reaction<R>& r) const { return linear::strain_energy(p, r.F_n, r.F_s); }
  R capacity() const { return R(0); }
};
template <class R>
struct BondProbe {
  static constexpr const char* name = "parallel_bond";
  parallel_bond::Parameters<R> p{R(32e9), R(9.6e9), R(1e3), R(9000), R(40e3), R(0.3), R(0)};
  parallel_bond::State<R> s{R(0), R(40e3)};
  R closure = R(0), rotation = R(0);
  Reaction<R> step(R dc, R ds, R dr) {
    closure += dc, rotation += dr;
    return parallel_bond::respond(p, s, Motion<R>{closure, dc, ds, rotation});
  }
  R energy(const Reaction<R>& r) const { return parallel_bond::strain_energy(p, r.F_n, r.F_s, r.M); }
  R capacity() const { return s.capacity; }
};
template <class R>
struct JointProbe {
  static constexpr const char* name = "smooth_joint";
  smooth_joint::Parameters<R> p{R(2e9), R(0.6e9), R(0.4), R(18e3), R(0.2), R(0.15), R(0)};
  smooth_joint::State<R> s{R(0), R(0), R(6e3), R(0)};
  Reaction<R> step(R dc, R ds, R) { return smooth_joint::respond(p, s, Motion<R>{R(0), dc, ds, R(0)}); }
  R energy(const Reaction<R>& r) const { return smooth_joint::strain_energy(p, r.F_n, r.F_s); }
  R capacity() const { return s.capacity; }
};

static_assert(std::size(laws) == 3, "a new law needs a probe here");

template <class P>
class Conformance : public testing::Test {};
using Probes = testing::Types<LinearProbe<double>, BondProbe<double>, JointProbe<double>>;
TYPED_TEST_SUITE(Conformance, Probes);

double draw(std::uint32_t i, std::uint32_t what) { return normal(11, Stream::test, i, what); }

TYPED_TEST(Conformance, NoMotionChangesNothing) {
  TypeParam law;
  const auto before = law.step(2e-7, 1e-7, 1e-6);
  for (int i = 0; i < 10; ++i) {
    const auto now = law.step(0.0, 0.0, 0.0);
    EXPECT_EQ(now.F_n, before.F_n);
    EXPECT_EQ(now.F_s, before.F_s);
    EXPECT_EQ(now.M, before.M);
    EXPECT_EQ(now.dissipated, 0.0);
  }
}

// The work that the grains put in is never less than what is stored now: whatever else went is dissipated or
// released. Trapezoidal work of a linear spring is exact; the bound allows for the rounding of the sums and
// for breakage within a step, whose forces the trapezoid counts by half.
TYPED_TEST(Conformance, NeverMakesEnergy) {
  for (std::uint32_t path = 0; path < 200; ++path) {
    TypeParam law;
    double work = 0.0, most = 0.0, F_n = 0.0, F_s = 0.0, M = 0.0, stored = 0.0;
    double within_steps = 0.0;
    for (std::uint32_t i = 0; i < 400; ++i) {
      const std::uint32_t k = path * 400 + i;
      const double pull = i % 200 < 100 ? 1.0 : -1.0;  // there and back, with noise
      const double dc = 2e-8 * (draw(k, 0) + 0.3 * pull), ds = 4e-8 * (draw(k, 1) + 0.3 * pull);
      const double dr = 3e-7 * draw(k, 2);
      const auto r = law.step(dc, ds, dr);
      // The trapezoid is exact along a spring; where the contact opens, closes or slips within the step it
      // errs by at most the triangle between the two forces.
      if ((F_n == 0.0) != (r.F_n == 0.0) || r.dissipated != 0.0)
        within_steps += 0.5 * std::fabs((r.F_n - F_n) * dc) + 0.5 * std::fabs((r.F_s - F_s) * ds);
      work += 0.5 * (F_n + r.F_n) * dc - 0.5 * (F_s + r.F_s) * ds - 0.5 * (M + r.M) * dr;
      F_n = r.F_n, F_s = r.F_s, M = r.M;
      stored = law.energy(r);
      most = std::max(most, stored);
      // The slip of one step is charged at its mean force. Where the force turns its sign within the step
      // this can be negative by second order, never more than the spring's work over that step, k_s ds^2.
      ASSERT_GE(r.dissipated, -12e9 * ds * ds - 1e-12 * most) << "slip gave energy back at step " << i;
      ASSERT_GE(work - stored, -within_steps - 1e-12 * most) << "path " << path << ", step " << i;
    }
  }
}

TYPED_TEST(Conformance, MirrorImage) {
  TypeParam left, right;
  for (std::uint32_t i = 0; i < 500; ++i) {
    const double dc = 1e-8 * draw(i, 0), ds = 4e-8 * draw(i, 1), dr = 3e-7 * draw(i, 2);
    const auto a = left.step(dc, ds, dr), b = right.step(dc, -ds, -dr);
    ASSERT_EQ(a.F_n, b.F_n);
    ASSERT_EQ(a.F_s, -b.F_s);
    ASSERT_EQ(a.M, -b.M);
    ASSERT_EQ(a.dissipated, b.dissipated);
  }
}

TYPED_TEST(Conformance, BrokenStaysBroken) {
  TypeParam law;
  bool broken = false;
  for (std::uint32_t i = 0; i < 3000; ++i) {
    const auto r = law.step(-3e-9 + 5e-8 * draw(i, 0), 1e-7 * draw(i, 1), 0.0);
    if (broken) {
      ASSERT_EQ(law.capacity(), 0.0);
      ASSERT_FALSE(broke(r));
      ASSERT_GE(r.F_n, 0.0) << "tension without a bond";
    }
    broken = broken || broke(r);
  }
}

TYPED_TEST(Conformance, StateIsAllThereIs) {
  TypeParam law;
  for (std::uint32_t i = 0; i < 100; ++i) law.step(1e-8 * draw(i, 0), 4e-8 * draw(i, 1), 3e-7 * draw(i, 2));
  TypeParam copy = law;
  for (std::uint32_t i = 100; i < 200; ++i) {
    const double dc = 1e-8 * draw(i, 0), ds = 4e-8 * draw(i, 1), dr = 3e-7 * draw(i, 2);
    ASSERT_EQ(law.step(dc, ds, dr).F_s, copy.step(dc, ds, dr).F_s);
  }
}

template <template <class> class Probe, int W>
void lanes_equal_scalar() {
  using R = Pack<double, W>;
  Probe<R> wide;
  Probe<double> lone[W];
  for (std::uint32_t i = 0; i < 2000; ++i) {
    R dc(0.0), ds(0.0), dr(0.0);
    for (int l = 0; l < W; ++l) {
      const auto lane = static_cast<std::uint32_t>(10 * l);
      dc.v[l] = 2e-8 * draw(i, lane), ds.v[l] = 4e-8 * draw(i, lane + 1), dr.v[l] = 3e-7 * draw(i, lane + 2);
    }
    const auto r = wide.step(dc, ds, dr);
    for (int l = 0; l < W; ++l) {
      const auto s = lone[l].step(dc[l], ds[l], dr[l]);
      ASSERT_EQ(r.F_n[l], s.F_n) << Probe<R>::name << " step " << i << " lane " << l;
      ASSERT_EQ(r.F_s[l], s.F_s);
      ASSERT_EQ(r.M[l], s.M);
      ASSERT_EQ(r.dissipated[l], s.dissipated);
    }
  }
}
TEST(Lanes, EqualTheScalarBitByBit) {
  lanes_equal_scalar<LinearProbe, 2>();
  lanes_equal_scalar<BondProbe, 2>();
  lanes_equal_scalar<JointProbe, 2>();
  lanes_equal_scalar<LinearProbe, 4>();
  lanes_equal_scalar<BondProbe, 4>();
  lanes_equal_scalar<JointProbe, 4>();
}

// A joint that broke in tension closes again where it opened, not earlier.
TEST(SmoothJoint, RemembersItsOpening) {
  JointProbe<double> law;
  for (int i = 0; i < 1000; ++i) law.step(-1e-8, 0.0, 0.0);  // opens by 10 um and breaks at 3 um
  ASSERT_EQ(law.capacity(), 0.0);
  double back = 0.0;
  Reaction<double> r{};
  while (r.F_n == 0.0) r = law.step(1e-9, 0.0, 0.0), back += 1e-9;
  EXPECT_NEAR(back, 1e-5, 2e-9);
}

TEST(Linear, StiffnessConventionsAgreeForEqualRadii) {
  EXPECT_EQ(linear::stiffness_factor(false, 1.0, 3.0), 1.0);
  EXPECT_EQ(linear::stiffness_factor(true, 2.0, 2.0), 1.0);
  EXPECT_EQ(linear::stiffness_factor(true, 1.0, 3.0), 0.5);
}

}  // namespace
}  // namespace phy
