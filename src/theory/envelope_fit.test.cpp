#include "theory/envelope_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/rng.hpp"
#include "base/stats.hpp"
#include "theory/hoek_brown.hpp"
#include "theory/jaeger.hpp"

namespace phy::theory {
namespace {

std::vector<EnvelopeReading> readings(const std::vector<double>& confining, auto sigma_1) {
  std::vector<EnvelopeReading> all;
  for (const double s : confining) all.push_back({s, sigma_1(s)});
  return all;
}
const std::vector<double> four = {0.0, 5e6, 10e6, 20e6};

TEST(MohrCoulombFit, FindsTheCoulombRock) {
  const auto fit = fit_mohr_coulomb(readings(four, [](double s) {
    return coulomb_sigma_1({25e6, 38.0}, s);
  }));
  ASSERT_TRUE(fit.ok) << fit.reason;
  EXPECT_NEAR(fit.cohesion.value, 25e6, 1.0);
  EXPECT_NEAR(fit.friction.value, 38.0, 1e-6);
  EXPECT_NEAR(fit.cohesion.se, 0.0, 10.0);
}

TEST(HoekBrownFit, FindsTheHoekBrownRock) {
  const auto fit = fit_hoek_brown(readings(four, [](double s) { return hoek_brown_sigma_1(90e6, 12.0, s); }));
  ASSERT_TRUE(fit.ok) << fit.reason;
  EXPECT_NEAR(fit.ucs.value, 90e6, 1.0);
  EXPECT_NEAR(fit.m_i.value, 12.0, 1e-6);
  EXPECT_NEAR(fit.m_i.se, 0.0, 1e-6);
}

// A normal variable from two uniform ones.
double normal(std::uint32_t i, std::uint32_t j) {
  return std::sqrt(-2.0 * std::log(1.0 - uniform(i, Stream::test, 2 * j))) *
         std::cos(6.283185307179586 * uniform(i, Stream::test, 2 * j + 1));
}

// The spread of estimates over 400 noisy data sets is what one data set's standard error says (4 % is its own
// standard error; the draws are fixed).
TEST(EnvelopeFits, StandardErrorsAreThoseOfRepetitions) {
  std::vector<double> c, phi, ucs, m, c_se, phi_se, ucs_se, m_se;
  for (std::uint32_t i = 0; i < 400; ++i) {
    std::uint32_t j = 0;
    const auto noisy = [&](double sigma_1) { return sigma_1 + 2e6 * normal(i, j++); };
    const std::vector<double> seven = {0.0, 3e6, 6e6, 10e6, 15e6, 20e6, 30e6};
    const auto mc = fit_mohr_coulomb(readings(seven, [&](double s) {
      return noisy(coulomb_sigma_1({25e6, 38.0}, s));
    }));
    const auto hb =
        fit_hoek_brown(readings(seven, [&](double s) { return noisy(hoek_brown_sigma_1(90e6, 12.0, s)); }));
    ASSERT_TRUE(mc.ok && hb.ok);
    c.push_back(mc.cohesion.value), c_se.push_back(mc.cohesion.se * mc.cohesion.se);
    phi.push_back(mc.friction.value), phi_se.push_back(mc.friction.se * mc.friction.se);
    ucs.push_back(hb.ucs.value), ucs_se.push_back(hb.ucs.se * hb.ucs.se);
    m.push_back(hb.m_i.value), m_se.push_back(hb.m_i.se * hb.m_i.se);
  }
  const auto ratio = [](const std::vector<double>& values, const std::vector<double>& variances) {
    return summarise(values).sd / std::sqrt(summarise(variances).mean);
  };
  EXPECT_NEAR(ratio(c, c_se), 1.0, 0.12);
  EXPECT_NEAR(ratio(phi, phi_se), 1.0, 0.12);
  EXPECT_NEAR(ratio(ucs, ucs_se), 1.0, 0.12);
  EXPECT_NEAR(ratio(m, m_se), 1.0, 0.12);
}

TEST(EnvelopeFits, SayWhyNot) {
  EXPECT_EQ(fit_mohr_coulomb({{0.0, 90e6}, {0.0, 91e6}}).reason,
            "fewer than two confining stresses have a strength");
  EXPECT_EQ(fit_mohr_coulomb({{0.0, 90e6}, {10e6, 95e6}}).reason, "the strength grows less than sigma_3");
  EXPECT_EQ(fit_hoek_brown({{0.0, 90e6}, {10e6, 95e6}}).reason,
            "the strength does not grow faster than sigma_3");
  EXPECT_EQ(fit_hoek_brown({{10e6, 9e6}, {0.0, 95e6}}).reason,
            "a strength is not above its confining stress");
  EXPECT_TRUE(std::isnan(fit_hoek_brown({{0.0, 90e6}, {10e6, 130e6}}).m_i.se))
      << "two readings, two unknowns";
}

}  // namespace
}  // namespace phy::theory
