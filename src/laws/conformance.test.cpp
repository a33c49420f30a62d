// What every law in the list must obey, driven along random paths: no motion gives no change, slip never
// makes energy, the mirror image of a motion gives the mirror image of the force, a broken bond never comes
// back, and a lane of a pack computes the same bits as a lone double.
#include <gtest/gtest.h>

#include <cmath>
#include <string_view>
#include <vector>

#include "base/rng.hpp"
#include "laws/laws.hpp"

namespace phy::laws {
namespace {

/// One contact of a law from the list, with its typical parameters; what is typically 0 (angles) is not.
template <class Law>
struct Probe {
  static constexpr const char* name = Law::name;
  static constexpr bool viscous = std::string_view(Law::name) == "dashpot";
  Law law{values()};
  decltype(law.capacity()) closure{0.0}, rotation{0.0};
  using R = decltype(closure);
  Motion<R> motion{R(0.0), R(0.0), R(0.0), R(0.0)};

  static std::vector<double> values() {
    std::vector<double> v;
    for (const ParameterInfo& p : Law::parameters)
      v.push_back(p.typical == 0.0 && std::string_view(p.name) != "mode" ? 0.15 : p.typical);
    return v;
  }
  Reaction<R> step(R dc, R ds, R dr) {
    closure += dc, rotation += dr;
    motion = {closure, dc, ds, rotation, dr};
    return law.step(motion);
  }
  R energy(const Reaction<R>& r) const { return law.energy(motion, r); }
  R capacity() const { return law.capacity(); }
};

template <class T>
struct AsTypes;
template <class... Law>
struct AsTypes<std::tuple<Law...>> {
  using Type = testing::Types<Probe<Law>...>;
};

template <class P>
class Conformance : public testing::Test {};
using Probes = AsTypes<Laws<double>>::Type;
TYPED_TEST_SUITE(Conformance, Probes);

double draw(std::uint32_t i, std::uint32_t what) { return normal(11, Stream::test, i, what); }

TYPED_TEST(Conformance, NoMotionChangesNothing) {
  TypeParam law;
  auto before = law.step(2e-7, 1e-7, 1e-6);
  if (TypeParam::viscous) before = law.step(0.0, 0.0, 0.0);  // the speed itself has changed
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
    bool broken = false;
    for (std::uint32_t i = 0; i < 400; ++i) {
      const std::uint32_t k = path * 400 + i;
      const double pull = i % 200 < 100 ? 1.0 : -1.0;  // there and back, with noise
      const double dc = 2e-8 * (draw(k, 0) + 0.3 * pull), ds = 4e-8 * (draw(k, 1) + 0.3 * pull);
      const double dr = 3e-7 * draw(k, 2);
      const auto r = law.step(dc, ds, dr);
      // The trapezoid is exact along a spring; where the contact opens, closes or slips within the step, or
      // bends after breakage (it may open gradually), it errs by at most the triangle between the two forces.
      broken = broken || broke(r);
      if ((F_n == 0.0) != (r.F_n == 0.0) || r.dissipated != 0.0 || (broken && r.M != 0.0))
        within_steps +=
            0.5 * (std::fabs((r.F_n - F_n) * dc) + std::fabs((r.F_s - F_s) * ds) + std::fabs((r.M - M) * dr));
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
  const bool bonded = law.capacity() > 0.0;
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
  EXPECT_EQ(broken, bonded) << "the path is to break what can break";
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

template <class Wide, class Lone, int W>
void lanes_equal_scalar() {
  using R = Pack<double, W>;
  Probe<Wide> wide;
  Probe<Lone> lone[W];
  for (std::uint32_t i = 0; i < 2000; ++i) {
    R dc(0.0), ds(0.0), dr(0.0);
    for (int l = 0; l < W; ++l) {
      const auto lane = static_cast<std::uint32_t>(10 * l);
      dc.v[l] = 2e-8 * draw(i, lane), ds.v[l] = 4e-8 * draw(i, lane + 1), dr.v[l] = 3e-7 * draw(i, lane + 2);
    }
    const auto r = wide.step(dc, ds, dr);
    for (int l = 0; l < W; ++l) {
      const auto s = lone[l].step(dc[l], ds[l], dr[l]);
      ASSERT_EQ(r.F_n[l], s.F_n) << Lone::name << " step " << i << " lane " << l;
      ASSERT_EQ(r.F_s[l], s.F_s);
      ASSERT_EQ(r.M[l], s.M);
      ASSERT_EQ(r.dissipated[l], s.dissipated);
    }
  }
}
template <int W, class... Wide, class... Lone>
void all_lanes(const std::tuple<Wide...>*, const std::tuple<Lone...>*) {
  (lanes_equal_scalar<Wide, Lone, W>(), ...);
}
TEST(Lanes, EqualTheScalarBitByBit) {
  const Laws<double>* lone = nullptr;
  all_lanes<2>(static_cast<Laws<Pack<double, 2>>*>(nullptr), lone);
  all_lanes<4>(static_cast<Laws<Pack<double, 4>>*>(nullptr), lone);
}

}  // namespace
}  // namespace phy::laws
