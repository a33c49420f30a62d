// Names of tests in a laboratory.
#include "records/lab_tests.hpp"

#include <gtest/gtest.h>

namespace phy {
namespace {

TEST(LabTests, OneTestAtSeveralPlacesIsNamedOnce) {
  EXPECT_EQ(
      names_of({between(Property::E, 80, 90), between(Property::E, 0, 15), between(Property::E, 30, 60)}),
      "E between 80 and 90 degrees, between 0 and 15 degrees and between 30 and 60 degrees");
  EXPECT_EQ(names_of({at_both_ends(Property::ucs), between(Property::ucs, 45, 60)}),
            "UCS at 0 and 90 degrees and between 45 and 60 degrees");
}

TEST(LabTests, OtherTestsAreNamedEach) {
  EXPECT_EQ(names_of({at_angle(Property::ucs, 0), at_angle(Property::E, 90)}),
            "UCS at 0 degrees, and E at 90 degrees");
  EXPECT_EQ(
      names_of({LabTests({at_angle(Property::ucs, 0), at_angle(Property::E, 90)}), LabTest{Property::nu}}),
      "UCS at 0 degrees, or E at 90 degrees, and nu");
}

}  // namespace
}  // namespace phy
