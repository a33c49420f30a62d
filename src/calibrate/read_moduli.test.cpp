// E and nu as they are read: what stiffnesses can follow is no miss, what they cannot is one.
#include "calibrate/read_moduli.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/exact_math.hpp"
#include "records/reading_fixture.hpp"

namespace phy::calibrate {
namespace {

constexpr double E_0 = 40e9, nu_0 = 0.2;
const std::vector<double> inclinations = {0, 15, 30, 45, 60, 75, 90};

Rock rock() {
  Rock r;
  r.E_is = ModulusReading::tangent_50;
  r.model.bedding.resize(1);
  for (const double theta : inclinations) {
    r.readings.push_back(reading(Property::E, theta, E_0));
    r.readings.push_back(reading(Property::nu, theta, nu_0));
  }
  return r;
}

/// After two tests on each of eight packings that soften E by `factor` and add to nu, both functions of angle
/// and place; the solution is the table's.
template <class Factor, class Addition>
ReadModuli learnt(const Factor& factor, const Addition& addition) {
  const Evidence evidence(rock());
  ReadModuli read(evidence);
  ElasticResult solution;
  solution.E_gauge = E_0, solution.nu_gauge = nu_0;
  for (int k = 0; k < 16; ++k)
    for (const double theta : inclinations) {
      const std::vector<double> z = {std::sin(3.0 * k), std::cos(5.0 * k)};
      TestResult test;
      test.outcome.status = Status::peaked;
      test.numbers.push_back({"E_tangent", E_0 * factor(theta, z), "Pa", "", ""});
      test.numbers.push_back({"nu", nu_0 + addition(theta, z), "1", "", ""});
      read.add({Property::ucs, theta, 100e6, 5e6, 3}, {z, k / 2}, test, solution);
    }
  read.learn();
  std::vector<Comparison> solved;
  for (const Target& t : evidence.moduli) {
    Comparison c;
    c.target = t, c.mean = t.mean;
    solved.push_back(c);
  }
  read.take_solution(solved);
  return read;
}

double largest(const std::vector<ReadModuli::Miss>& misses, Property property) {
  double most = 0.0;
  for (const ReadModuli::Miss& m : misses)
    if (m.property == property) most = std::max(most, std::fabs(m.error));
  return most;
}

const auto firm = [](double, const std::vector<double>&) { return 1.0; };
const auto no_addition = [](double, const std::vector<double>&) { return 0.0; };
const std::vector<double> middle = {0.0, 0.0, 0.0};  // the last is the place of sigma_c

TEST(ReadModuli, AreLearntOverTheBox) {
  const ReadModuli read =
      learnt([](double, const std::vector<double>& z) { return 0.8 * std::exp(0.1 * z[0]); },
             [](double theta, const std::vector<double>& z) { return 1e-3 * theta * (1.0 + z[1]); });
  const Softenings at = read.at(std::vector<double>{0.5, -0.5, 0.3});
  ASSERT_EQ(at.size(), inclinations.size());
  EXPECT_NEAR(at.at({0.0, 30.0}).factor, 0.8 * std::exp(0.05), 0.01);
  EXPECT_NEAR(at.at({0.0, 60.0}).addition, 0.03, 0.01);
}

// Planes have three stiffnesses: a constant, cos 2 theta, cos 4 theta.
TEST(ReadModuli, WhatStiffnessesFollowIsNoMiss) {
  const auto followed = [](double theta, const std::vector<double>&) {
    return std::exp(-0.2 + 0.05 * sin_cos_degrees(2.0 * theta).cos - 0.05 * sin_cos_degrees(4.0 * theta).cos);
  };
  const auto all = learnt(followed, no_addition).misses(middle);
  ASSERT_EQ(all.size(), 2 * inclinations.size());
  EXPECT_LT(largest(all, Property::E), 0.005);
  const auto spike = [](double theta, const std::vector<double>&) { return theta == 45.0 ? 0.8 : 1.0; };
  EXPECT_GT(largest(learnt(spike, no_addition).misses(middle), Property::E), 0.1);
}

TEST(ReadModuli, OnlyNuBeyondWhatASolutionCanLeaveIsAMiss) {
  const auto some = [](double, const std::vector<double>&) { return 0.08; };
  const auto much = [](double, const std::vector<double>&) { return 0.3; };
  EXPECT_NEAR(largest(learnt(firm, some).misses(middle), Property::nu), 0.0, 1e-3);
  EXPECT_NEAR(largest(learnt(firm, much).misses(middle), Property::nu), 0.2, 0.01);
}

Target under(double confining, Property property, double theta, double value) {
  Target t{property, theta, value, 0.05 * value, 3};
  t.confining = confining;
  return t;
}

// At two angles under two stresses each: planes follow any two values over the angle, but none over the
// stress. How far tests soften under confinement depends on sigma_c too.
TEST(ReadModuli, WhatAStressOnTheSidesChangesIsAMissOfItsOwn) {
  constexpr double stress = 10e6;
  std::vector<Target> table;
  for (const double theta : {0.0, 90.0})
    for (const double confining : {0.0, stress}) {
      const Property strength = confining > 0.0 ? Property::confined : Property::ucs;
      table.push_back(under(confining, Property::E, theta, theta > 0.0 && confining > 0.0 ? 1.3 * E_0 : E_0));
      table.push_back(under(confining, strength, theta, 100e6));
    }
  const Evidence evidence(rock(), table);
  ReadModuli read(evidence);
  ElasticResult solution;
  solution.E_gauge = E_0, solution.nu_gauge = nu_0;
  for (int k = 0; k < 16; ++k)
    for (const Target& t : evidence.strengths) {
      std::vector<double> z = {std::sin(3.0 * k)};
      double factor = 1.0;
      if (t.confining > 0.0) z.push_back(std::cos(5.0 * k)), factor = std::exp(0.1 * z.back());
      TestResult test;
      test.outcome.status = Status::peaked;
      test.numbers = {{"E_tangent", E_0 * factor, "Pa", "", ""}, {"nu", nu_0, "1", "", ""}};
      EXPECT_TRUE(read.reads(t));
      read.add(t, {z, k / 2}, test, solution);
    }
  read.learn();
  std::vector<Comparison> solved;
  for (const Target& t : evidence.moduli) {
    Comparison c;
    c.target = t, c.mean = E_0;
    solved.push_back(c);
  }
  read.take_solution(solved);
  const Softenings at = read.at(std::vector<double>{0.0, 0.5});
  EXPECT_NEAR(at.at({stress, 0.0}).factor, std::exp(0.05), 0.01);
  EXPECT_NEAR(at.at({0.0, 0.0}).factor, 1.0, 0.01);
  const auto misses = read.misses(std::vector<double>{0.0, 0.0});
  ASSERT_EQ(misses.size(), 4U);
  EXPECT_NEAR(misses[0].error, 0.0, 0.01);
  EXPECT_NEAR(misses[2].error, -0.5 * std::log(1.3), 0.01) << "half of it below, half above";
  EXPECT_NEAR(misses[3].error, 0.5 * std::log(1.3), 0.01);
}

TEST(ReadModuli, BeforeTheFirstSolutionNothingIsMissed) {
  EXPECT_TRUE(ReadModuli(Evidence(rock())).misses(middle).empty());
}

}  // namespace
}  // namespace phy::calibrate
