// When a measure is a warning and when it makes a result untrusted.
#include "records/quality.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace phy {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Number measured(const char* name, double value) { return {name, value, "1", "", ""}; }

/// A specimen and a test with nothing to say against them.
std::vector<Number> sound() {
  return {measured("porosity", 0.1),       measured("overlap", 0.1),
          measured("rattlers", 0.02),      measured("grains_across", 50),
          measured("joints", 200),         measured("grains_per_spacing", 8),
          measured("peak_confirmed", 2.0), measured("rows_to_peak", 500),
          measured("wave_transits", 90),   measured("platen_difference_95", 0.005),
          measured("kinetic_ratio", 1e-3), measured("energy_error", 1e-3),
          measured("damping", 0.7),        measured("fall_seen", 1.0),
          measured("slow_share", 0.7)};
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

TEST(Quality, ASoundResultHasNoMarks) {
  EXPECT_TRUE(quality_marks(sound()).empty());
  EXPECT_EQ(grade_of(sound()), Grade::good);
}

TEST(Quality, EveryMeasureOfTheListIsJudgedOnItsBadSide) {
  for (const QualityLimit& limit : quality_limits()) {
    EXPECT_TRUE(limit.least ? limit.untrusted < limit.warning : limit.untrusted > limit.warning)
        << limit.number;
    const double worse = limit.least ? -1e-6 : 1e-6;
    EXPECT_EQ(grade_of(sound_but(limit.number, limit.warning)), Grade::good) << limit.number;
    EXPECT_EQ(grade_of(sound_but(limit.number, limit.warning + worse)), Grade::warning) << limit.number;
    EXPECT_EQ(grade_of(sound_but(limit.number, limit.untrusted)), Grade::warning) << limit.number;
    EXPECT_EQ(grade_of(sound_but(limit.number, limit.untrusted + worse)), Grade::untrusted) << limit.number;
  }
}

TEST(Quality, WhatEndsTheTestComesFirst) {
  std::vector<Number> numbers = sound_but("grains_across", 8.0);
  for (Number& n : numbers)
    if (n.name == "energy_error") n.value = 0.5;
  EXPECT_THAT(measures(quality_marks(numbers)), ElementsAre("energy_error", "grains_across"));
  EXPECT_EQ(grade_of(numbers), Grade::untrusted);
}

TEST(Quality, AMarkTellsValueLimitAndTrouble) {
  const std::vector<QualityMark> marks = quality_marks(sound_but("wave_transits", 4.2));
  ASSERT_EQ(marks.size(), 1u);
  EXPECT_EQ(marks[0].name(), "wave_transits below 10");
  EXPECT_THAT(marks[0].text(), HasSubstr("wave_transits 4.2, below 10: "));
  EXPECT_THAT(quality_marks(sound_but("wave_transits", 9.996))[0].text(), HasSubstr("9.996, below 10: "));
}

TEST(Quality, WhatIsNotKnownIsNoMarkAndAnOldResultIsNotCalledGood) {
  EXPECT_EQ(grade_of(sound_but("wave_transits", std::nan(""))), Grade::good);
  EXPECT_EQ(grade_of({measured("ucs", 50e6)}), Grade::unknown);
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
  QualityTally old;
  old.add({measured("ucs", 50e6)});
  EXPECT_EQ(old.text(), "1 of 1 tests are of an older version, which did not assess them");
}

}  // namespace
}  // namespace phy
