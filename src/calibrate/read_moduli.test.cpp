// E and nu as they are read: what stiffnesses can follow is no miss, what they cannot is one.
#include "calibrate/read_moduli.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/exact_math.hpp"
#include "calibrate/reading_fixture.hpp"

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
      read.add(theta, {z, k / 2}, test, solution);
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
const std::vector<double> middle = {0.0, 0.0};

TEST(ReadModuli, AreLearntOverTheBox) {
  const ReadModuli read =
      learnt([](double, const std::vector<double>& z) { return 0.8 * std::exp(0.1 * z[0]); },
             [](double theta, const std::vector<double>& z) { return 1e-3 * theta * (1.0 + z[1]); });
  const Softenings at = read.at(std::vector<double>{0.5, -0.5});
  ASSERT_EQ(at.size(), inclinations.size());
  EXPECT_NEAR(at.at(30.0).factor, 0.8 * std::exp(0.05), 0.01);
  EXPECT_NEAR(at.at(60.0).addition, 0.03, 0.01);
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

TEST(ReadModuli, BeforeTheFirstSolutionNothingIsMissed) {
  EXPECT_TRUE(ReadModuli(Evidence(rock())).misses(middle).empty());
}

}  // namespace
}  // namespace phy::calibrate
