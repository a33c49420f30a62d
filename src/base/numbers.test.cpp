// Random numbers, elementary functions, packs and hashes.
#include <gtest/gtest.h>

#include <cmath>

#include "base/exact_math.hpp"
#include "base/hash.hpp"
#include "base/pack.hpp"
#include "base/rng.hpp"

namespace phy {
namespace {

// Known answers published with the generator (Random123, kat_vectors).
TEST(Philox, KnownAnswers) {
  const std::uint32_t f = 0xffffffffU;
  EXPECT_EQ(philox4x32({0, 0, 0, 0}, {0, 0}),
            (PhiloxBlock{0x6627e8d5U, 0xe169c58dU, 0xbc57ac4cU, 0x9b00dbd8U}));
  EXPECT_EQ(philox4x32({f, f, f, f}, {f, f}),
            (PhiloxBlock{0x408f276dU, 0x41c83b0eU, 0xa20bc7c6U, 0x6d5451fdU}));
  EXPECT_EQ(philox4x32({0x243f6a88U, 0x85a308d3U, 0x13198a2eU, 0x03707344U}, {0xa4093822U, 0x299f31d0U}),
            (PhiloxBlock{0xd16cfe09U, 0x94fdccebU, 0x5001e420U, 0x24126ea1U}));
}

TEST(Random, UniformStaysInside) {
  double sum = 0.0;
  for (std::uint32_t i = 0; i < 100000; ++i) {
    const double u = uniform(3, Stream::test, i);
    ASSERT_GT(u, 0.0);
    ASSERT_LT(u, 1.0);
    sum += u;
  }
  EXPECT_NEAR(sum / 1e5, 0.5, 3.0 * std::sqrt(1.0 / 12.0 / 1e5));
}

TEST(Random, UniformNeverRoundsToItsEnds) {
  const std::uint64_t last = (std::uint64_t{1} << 53U) - 1;
  EXPECT_EQ(open_unit(0), 0x1.0p-54);
  EXPECT_EQ(open_unit(last), 1.0 - 0x1.0p-53);
  EXPECT_EQ(open_unit(last - 1), 1.0 - 0x1.0p-52);  // ties to even: the half is lost
  EXPECT_EQ(open_unit(std::uint64_t{1} << 51U), 0.25 + 0x1.0p-54);
  EXPECT_TRUE(std::isfinite(normal_quantile(open_unit(0))));
  EXPECT_TRUE(std::isfinite(normal_quantile(open_unit(last))));
}

TEST(Random, NormalQuantile) {
  EXPECT_EQ(normal_quantile(0.5), 0.0);
  EXPECT_NEAR(normal_quantile(0.975), 1.959963984540054, 1e-14);
  EXPECT_NEAR(normal_quantile(0.99), 2.326347874040841, 1e-14);
  EXPECT_NEAR(normal_quantile(1e-10), -6.361340902404056, 1e-12);
  for (const double p : {1e-12, 0.01, 0.07, 0.3, 0.6, 0.93, 0.999})
    EXPECT_NEAR(0.5 * std::erfc(-normal_quantile(p) / std::sqrt(2.0)), p, 1e-14 + 1e-12 * p);
}

TEST(ExactMath, AgreesWithTheLibrary) {
  for (double x = 1e-300; x < 1e300; x *= 3.7)
    EXPECT_NEAR(exact_log(x), std::log(x), 4e-16 * (1.0 + std::fabs(std::log(x))));
  for (double a = -720.0; a <= 720.0; a += 0.37) {
    // Turned back to [-180, 180] exactly, in degrees, because the argument in radians carries its own
    // rounding.
    const double radians = std::remainder(a, 360.0) * pi / 180.0;
    EXPECT_NEAR(sin_cos_degrees(a).sin, std::sin(radians), 1e-15) << a;
    EXPECT_NEAR(sin_cos_degrees(a).cos, std::cos(radians), 1e-15) << a;
  }
}

TEST(ExactMath, RightAnglesAndMirrorsAreExact) {
  EXPECT_EQ(sin_cos_degrees(90.0).sin, 1.0);
  EXPECT_EQ(sin_cos_degrees(90.0).cos, 0.0);
  EXPECT_EQ(sin_cos_degrees(180.0).cos, -1.0);
  for (const double a : {0.0, 12.5, 30.0, 45.0, 61.0, 75.0}) {
    EXPECT_EQ(sin_cos_degrees(180.0 - a).sin, sin_cos_degrees(a).sin) << a;
    EXPECT_EQ(sin_cos_degrees(180.0 - a).cos, -sin_cos_degrees(a).cos) << a;
  }
}

template <class R>
class Packs : public testing::Test {};
using PackTypes = testing::Types<Pack<double, 2>, Pack<double, 4>, Pack<float, 4>, Pack<float, 8>>;
TYPED_TEST_SUITE(Packs, PackTypes);

TYPED_TEST(Packs, DoLaneByLaneWhatScalarsDo) {
  using T = typename TypeParam::Scalar;
  for (std::uint32_t i = 0; i < 200; ++i) {
    TypeParam a(T(0)), b(T(0));
    for (int l = 0; l < TypeParam::width; ++l) {
      a.v[l] = T(normal(1, Stream::test, i, static_cast<std::uint32_t>(l)));
      b.v[l] = i % 5 == 0 ? T(0) : T(normal(2, Stream::test, i, static_cast<std::uint32_t>(l)));
    }
    for (int l = 0; l < TypeParam::width; ++l) {
      const T x = a[l], y = b[l];
      EXPECT_EQ((a + b)[l], x + y);
      EXPECT_EQ((a * b)[l], x * y);
      EXPECT_EQ((a / (b * b + TypeParam(T(1))))[l], x / (y * y + T(1)));
      EXPECT_EQ(sqrt(a * a)[l], std::sqrt(x * x));
      EXPECT_EQ(abs(a)[l], std::fabs(x));
      EXPECT_EQ(select(a < b, a, b)[l], x < y ? x : y);
      EXPECT_EQ(clip(a, abs(b))[l], std::max(std::min(x, std::fabs(y)), -std::fabs(y)));
      EXPECT_EQ(sign(b)[l], y > 0 ? T(1) : y < 0 ? T(-1) : T(0));
      EXPECT_EQ((!(a > b))[l], !(x > y));
    }
    bool some = false;
    for (int l = 0; l < TypeParam::width; ++l) some = some || a[l] >= b[l];
    EXPECT_EQ(any(a >= b), some);
  }
  EXPECT_FALSE(std::signbit(abs(TypeParam(T(-0.0)))[0]));
}

// Published test vectors of FNV-1a, 64 bit.
TEST(Hash, KnownAnswers) {
  Hash a;
  EXPECT_EQ(a.text(), "cbf29ce484222325");
  a.bytes("a", 1);
  EXPECT_EQ(a.text(), "af63dc4c8601ec8c");
  Hash f;
  f.bytes("foobar", 6);
  EXPECT_EQ(f.text(), "85944171f73967e8");
}

// As the program xxhsum -H128 prints them.
TEST(Fingerprint, IsXxh3OfOneHundredAndTwentyEightBits) {
  EXPECT_EQ(fingerprint_of(""), "99aa06d3014798d86001c324468d497f");
  EXPECT_EQ(fingerprint_of("abc"), "06b05ab6733a618578af5f94892f3950");
}

}  // namespace
}  // namespace phy
