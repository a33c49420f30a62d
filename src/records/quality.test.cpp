// When a measure is a warning and when it makes a result untrusted.
#include "records/quality.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace phy {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Number measured(const char* name, double value) { return {name, value, "1", "", ""}; }

/// A specimen and a test with nothing to say against them.
std::vector<Number> sound() {
  return {measured("porosity", 0.1),        measured("overlap", 0.1),
          measured("rattlers", 0.02),       measured("grains_across", 50),
          measured("joints", 200),          measured("grains_per_spacing", 8),
          measured("peak_confirmed", 2.0),  measured("rows_to_peak", 500),
          measured("wave_transits", 90),    measured("platen_difference_95", 0.005),
          measured("kinetic_ratio", 1e-3),  measured("energy_error", 1e-3),
          measured("damping", 0.7),         measured("fall_seen", 1.0),
          measured("grains_in_radius", 20), measured("wall_to_edge", 0.0),
          measured("slow_share", 0.7),      measured("broken_at_start", 0.0),
          measured("area_change", 0.7),     measured("nu_spread", 0.01),
          measured("cracks_in_window", 0),  measured("sigma_n_error_rms", 0.02),
          measured("box_lifted", 0.0),      measured("sigma_n_error_residual", 0.02)};
}

std::vector<Number> sound_but(const char* name, double value) {
  std::vector<Number> numbers = sound();
  for (Number& n : numbers)
    if (n.name == name) n.value = value;
  return numbers;
}

std::vector<std::string> measures(const std::vector<QualityMark>& marks) {
  std::vector<std::string> names;
  for (const QualityMark& m : marks) names.emplace_back(m.limit->number);
  return names;
}

Grade grade(std::vector<Number> numbers, Status status = Status::peaked) {
  TestResult r;
  r.outcome.status = status, r.numbers = std::move(numbers);
  return grade_of(r);
}

TEST(Quality, ASoundResultHasNoMarks) {
  EXPECT_TRUE(quality_marks(sound()).empty());
  EXPECT_EQ(grade(sound()), Grade::good);
}

TEST(Quality, EveryMeasureOfTheListIsJudgedOnItsBadSide) {
  for (const QualityLimit& limit : quality_limits()) {
    EXPECT_TRUE(limit.least ? limit.untrusted < limit.warning : limit.untrusted > limit.warning)
        << limit.number;
    const double worse = limit.least ? -1e-6 : 1e-6;
    const auto with = [&](double value) { return sound_but(limit.number, value); };
    EXPECT_EQ(grade(with(limit.warning)), Grade::good) << limit.number;
    EXPECT_EQ(grade(with(limit.warning + worse)), Grade::warning) << limit.number;
    EXPECT_EQ(grade(with(limit.untrusted)), Grade::warning) << limit.number;
    ASSERT_EQ(quality_marks(with(limit.untrusted + worse)).size(), 1u) << limit.number;
    EXPECT_EQ(quality_marks(with(limit.untrusted + worse))[0].grade, Grade::untrusted) << limit.number;
    EXPECT_EQ(grade(with(limit.untrusted + worse)), limit.of.empty() ? Grade::untrusted : Grade::warning)
        << limit.number;
  }
}

// Whatever the measures say: there is nothing to be good.
TEST(Quality, NoGradeBesideAnOutcomeThatIsNoAnswer) {
  for (const Status s : all_statuses) {
    const Grade expected = s == Status::peaked || s == Status::knee || s == Status::solved ? Grade::good
                           : s == Status::untrusted                                        ? Grade::untrusted
                                                                                           : Grade::none;
    EXPECT_EQ(grade(sound(), s), expected) << to_string(s);
  }
  EXPECT_STREQ(to_string(Grade::none), "no result");
  EXPECT_EQ(grade(sound_but("energy_error", 0.5), Status::unstable), Grade::none);
}

// The strength stands; nu is not given, and the measure that says so stays.
TEST(Quality, AMarkOfSingleNumbersTakesTheseAndLeavesTheTest) {
  std::vector<Number> numbers = sound_but("area_change", -0.6);
  for (const char* name : {"ucs", "nu_platen", "nu"}) numbers.push_back(measured(name, 1.6));
  note_marks(numbers);
  const auto of = [&](const char* name) {
    return *std::find_if(numbers.begin(), numbers.end(), [&](const Number& n) { return n.name == name; });
  };
  EXPECT_EQ(of("ucs").value, 1.6);
  EXPECT_EQ(of("ucs").note, "");
  for (const char* name : {"nu_platen", "nu"}) {
    EXPECT_TRUE(std::isnan(of(name).value)) << name;
    EXPECT_THAT(of(name).note, HasSubstr("area_change -0.6, below 0: "));
  }
  EXPECT_EQ(of("area_change").value, -0.6);
  EXPECT_EQ(grade(numbers), Grade::warning);
  ASSERT_EQ(quality_marks(numbers).size(), 1u);
  EXPECT_THAT(quality_marks(numbers)[0].heading(), HasSubstr("nu, nu_platen"));
  EXPECT_THAT(quality_marks(numbers)[0].heading(), HasSubstr("not given"));
}

TEST(Quality, AWarningOfSingleNumbersLeavesThem) {
  std::vector<Number> numbers = sound_but("nu_spread", 0.06);
  numbers.push_back(measured("nu", 0.3)), numbers.push_back(measured("E_tangent", 5e9));
  note_marks(numbers);
  EXPECT_EQ(numbers[numbers.size() - 2].value, 0.3);
  EXPECT_THAT(numbers[numbers.size() - 2].note, HasSubstr("nu_spread"));
  EXPECT_EQ(numbers.back().note, "") << "E is read in the same range, and has no such doubt";
}

TEST(Quality, WhatEndsTheTestComesFirst) {
  std::vector<Number> numbers = sound_but("grains_across", 8.0);
  for (Number& n : numbers)
    if (n.name == "energy_error") n.value = 0.5;
  EXPECT_THAT(measures(quality_marks(numbers)), ElementsAre("energy_error", "grains_across"));
  EXPECT_EQ(grade(numbers), Grade::untrusted);
}

TEST(Quality, AMarkTellsValueLimitAndTrouble) {
  const std::vector<QualityMark> marks = quality_marks(sound_but("wave_transits", 4.2));
  ASSERT_EQ(marks.size(), 1u);
  EXPECT_EQ(marks[0].name(), "wave_transits below 10");
  EXPECT_THAT(marks[0].text(), HasSubstr("wave_transits 4.2, below 10: "));
  EXPECT_THAT(quality_marks(sound_but("wave_transits", 9.996))[0].text(), HasSubstr("9.996, below 10: "));
}

TEST(Quality, WhatIsNotKnownIsNoMarkAndAnOldResultIsNotCalledGood) {
  EXPECT_EQ(grade(sound_but("wave_transits", std::nan(""))), Grade::good);
  EXPECT_EQ(grade({measured("ucs", 50e6)}), Grade::unknown);
}

TEST(Quality, ATallyCountsResultsAndMeasures) {
  QualityTally tally;
  EXPECT_EQ(tally.text(), "");
  tally.add(sound());
  tally.add(sound_but("energy_error", 0.02));
  QualityTally more;
  more.add(sound_but("energy_error", 0.03));
  more.add(sound_but("rattlers", 0.2));
  tally.add(more);
  EXPECT_EQ(tally.text(), "3 of 4 tests carry a warning: energy_error (2), rattlers (1)");
  QualityTally strengths;  // a strength has nothing to do with nu
  strengths.add(sound_but("nu_spread", 0.1), "ucs");
  EXPECT_EQ(strengths.text(), "");
  strengths.add(sound_but("nu_spread", 0.1), "nu");
  EXPECT_EQ(strengths.text(), "1 of 2 tests carry a warning: nu_spread (1)");
  QualityTally old;
  old.add({measured("ucs", 50e6)});
  EXPECT_EQ(old.text(), "1 of 1 tests are of an older version, which did not assess them");
}

}  // namespace
}  // namespace phy
