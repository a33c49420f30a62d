// What is told of a result that does not come out again, and which tests of a store are run again.
#include "study/replay.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/nan.hpp"

namespace phy::study {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

TestResult stored() {
  TestResult r;
  r.outcome.status = Status::peaked;
  r.numbers = {{"ucs", 50e6, "Pa", "", ""}, {"sigma_cd", nan, "Pa", "", "never"}};
  r.history.rows.resize(3);
  for (std::size_t i = 0; i < 3; ++i) r.history.rows[i].axial_stress = 1e6 * static_cast<double>(i);
  r.cracks.resize(2);
  r.cracks[1].step = 300;
  r.hash = "0123";
  return r;
}

TEST(Differences, OfAnEqualResultAreNone) {
  TestResult now = stored();
  now.numbers.insert(now.numbers.begin(), {"measured_since", 1.0, "1", "", ""});
  now.seconds = 12.0;
  EXPECT_THAT(differences(stored(), now), IsEmpty());
}

TEST(Differences, NameNumbersTheFirstRowAndTheFirstCrack) {
  TestResult now = stored();
  now.numbers[0].value = 51e6;
  now.history.rows[1].axial_stress = now.history.rows[2].axial_stress = 3e6;
  now.cracks[1].energy = 1.0;
  now.hash = "4567";
  EXPECT_THAT(differences(stored(), now),
              ElementsAre(HasSubstr("ucs [Pa]: stored 5e+07, now 5.1e+07 (+2 %)"),
                          HasSubstr("history from row 2 of 3 on: axial_stress [Pa]: stored 1e+06, now 3e+06"),
                          HasSubstr("cracks: 2 stored, 2 now; the first that differs is number 2"),
                          HasSubstr("stored 0123, now 4567")));
  now = stored();
  now.numbers.pop_back(), now.history.rows.pop_back(), now.cracks.clear();
  now.outcome = {Status::unstable, "it flew apart", ""};
  EXPECT_THAT(differences(stored(), now),
              ElementsAre(HasSubstr("stored \"peaked\", now \"unstable\": it flew apart"),
                          HasSubstr("sigma_cd: stored nan, not measured now"),
                          HasSubstr("history: 3 rows stored, 2 now"), HasSubstr("cracks: 2 stored, 0 now")));
}

TEST(Spread, TakesOneOfEachKindAndAngleBeforeASecond) {
  std::vector<Recipe> singles(6);
  for (std::size_t i : {0U, 1U, 2U, 3U}) singles[i].bedding.resize(1);  // three at 0 degrees, one at 30
  singles[3].bedding[0].theta = 30.0;
  singles[5].test.kind = TestKind("brazilian");
  EXPECT_THAT(spread(singles, 4), UnorderedElementsAre(0, 3, 4, 5));
  EXPECT_THAT(spread(singles, 5), UnorderedElementsAre(0, 1, 3, 4, 5));
  EXPECT_THAT(spread(singles, 60), ElementsAre(0, 1, 2, 3, 4, 5));
  EXPECT_EQ(spread(singles, 2).size(), 2U);
  EXPECT_THAT(spread({}, 3), IsEmpty());
}

}  // namespace
}  // namespace phy::study
