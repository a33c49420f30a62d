// Curves of others: names, units, signs, and one error with everything that is wrong.
#include "io/curve_in.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/check.hpp"

namespace phy::io {
namespace {

using testing::HasSubstr;

const std::string five_rows = "0,0\n0.1,10\n0.2,20\n0.3,25\n0.4,5\n";

TEST(CurveIn, ColumnsAreFoundByNameAndReadInTheirUnits) {
  const ForeignCurve c = parse_curve(
      "step,Axial Strain (%),stress_top [MPa],Stress [MPa],cracks\n"
      "1,0,9,0,0\n2,0.1,9,10,0\n3,0.2,9,20,1\n4,0.3,9,25,4\n5,0.4,9,5,9\n",
      "theirs.csv");
  ASSERT_EQ(c.history.rows.size(), 5U);
  EXPECT_DOUBLE_EQ(c.history.rows[3].axial_strain, 0.003);
  EXPECT_DOUBLE_EQ(c.history.rows[3].axial_stress, 25e6);
  EXPECT_EQ(c.history.rows[2].n_cracks, 1.0);
  EXPECT_TRUE(c.notes.empty());
  EXPECT_DOUBLE_EQ(
      parse_curve("strain [microstrain],stress [kPa]\n" + five_rows, "m").history.rows[1].axial_strain, 1e-7);
}

TEST(CurveIn, CompressionThatIsNegativeIsTurned) {
  const ForeignCurve c =
      parse_curve("strain [1];stress [Pa]\n0;0\n-0,1;-10\n-0,2;-20\n-0,3;-25\n-0,4;-5\n", "theirs.csv");
  EXPECT_DOUBLE_EQ(c.history.rows[3].axial_stress, 25.0);
  EXPECT_DOUBLE_EQ(c.history.rows[3].axial_strain, 0.3);
  EXPECT_TRUE(std::isnan(c.history.rows[3].n_cracks)) << "no column of cracks is not no crack";
  ASSERT_FALSE(c.notes.empty());
  EXPECT_THAT(c.notes.back(), HasSubstr("strain and stress was turned"));
}

std::string error_of(const std::string& text) {
  try {
    parse_curve(text, "theirs.csv");
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(CurveIn, EverythingThatIsWrongIsOneError) {
  const std::string heads = error_of("strain,load [kN]\n" + five_rows);
  EXPECT_THAT(heads, HasSubstr("theirs.csv:1"));
  EXPECT_THAT(heads, HasSubstr("a unit behind the name, [1], [%] or [microstrain]"));
  EXPECT_THAT(heads, HasSubstr("axial_stress"));
  EXPECT_THAT(heads, HasSubstr("strain, load [kN]")) << "what there is";
  const std::string cells = error_of("strain [1],stress [MPa]\n0,0\n0.1,x\n0.2,\n0.3,25\n0.4,5\n");
  EXPECT_THAT(cells, HasSubstr("theirs.csv:3"));
  EXPECT_THAT(cells, HasSubstr("theirs.csv:4"));
  EXPECT_THAT(error_of("strain [1],stress [MPa]\n0,0\n1,1\n"), HasSubstr("at least 5 rows"));
  EXPECT_THAT(error_of("strain [1],stress [m]\n" + five_rows), HasSubstr("[Pa], [kPa], [MPa] or [GPa]"));
  EXPECT_NE(error_of(""), "");
}

}  // namespace
}  // namespace phy::io
