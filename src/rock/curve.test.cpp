// Curves of others: names, units, signs, and one error with everything that is wrong.
#include "rock/curve.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/check.hpp"

namespace phy::rock {
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
  EXPECT_THAT(cells, HasSubstr("and 1 more line"));
  EXPECT_THAT(error_of("strain [1],stress [MPa]\n0,0\n1,1\n"), HasSubstr("at least 5 rows"));
  EXPECT_THAT(error_of("strain [1],stress [m]\n" + five_rows), HasSubstr("[Pa], [kPa], [MPa] or [GPa]"));
  EXPECT_NE(error_of(""), "");
}

/// A curve of 25 GPa and 75 MPa as `line` writes its points.
std::string curve_of(const std::string& head, double strain_unit, double stress_unit,
                     const std::string& between) {
  std::string text = head + "\n";
  for (int i = 0; i < 60; ++i) {
    const double strain = 6e-5 * i, stress = i <= 50 ? 25e9 * strain : std::max(0.0, 75e6 - 12e6 * (i - 50));
    text += std::to_string(strain / strain_unit) + between + std::to_string(stress / stress_unit) + "\n";
  }
  return text;
}

TEST(CurveIn, UnitsAreThoseOfEveryOtherReader) {
  struct Written {
    const char* head;
    double strain, stress;
  };
  for (const Written& w :
       {Written{"strain [‰],stress [N/mm2]", 1e-3, 1e6},
        Written{"Axial strain (µε),Axial stress (MPa)", 1e-6, 1e6},
        Written{"Axial strain (microstrain),Stress (psi)", 1e-6, 6894.757293168361},
        Written{"axial-strain %,axial stress MN/m²", 1e-2, 1e6},
        Written{"strain,stress\n%,kgf/cm2", 1e-2, 98066.5}, Written{"ε [mm/mm],σ [bar]", 1.0, 1e5}}) {
    const ForeignCurve c = parse_curve(curve_of(w.head, w.strain, w.stress, ","), "theirs.csv");
    ASSERT_EQ(c.history.rows.size(), 60U) << w.head;
    EXPECT_NEAR(c.history.rows[50].axial_strain, 3e-3, 2e-6) << w.head;
    EXPECT_NEAR(c.history.rows[50].axial_stress, 75e6, 75e2) << w.head;
  }
  EXPECT_THAT(parse_curve("strain,stress\n1,MPa\n" + five_rows, "t.csv").notes,
              testing::Contains("units stand in a row of their own"));
  EXPECT_THAT(error_of("strain [%],stress [MPa]\n%,kPa\n" + five_rows),
              HasSubstr("theirs.csv:2: stress [MPa] = kPa"));
}

TEST(CurveIn, LinesOfTheInstrumentStandAbove) {
  const ForeignCurve c = parse_curve(
      "Specimen,U-2\nDiameter,20,mm\nHeight,40,mm\n\nTime,Stress,Strain,Lateral "
      "strain\ns,MPa,mm/mm,microstrain\n"
      "0,0,0,0\n1,10,0.1,1\n2,20,0.2,2\n3,25,0.3,3\n4,5,0.4,4\n",
      "theirs.csv");
  ASSERT_EQ(c.history.rows.size(), 5U);
  EXPECT_DOUBLE_EQ(c.history.rows[3].axial_stress, 25e6);
  EXPECT_THAT(c.notes, testing::Contains("lines 1 to 3, above the header, are passed over"));
}

TEST(CurveIn, WhatItCanBeComputedFromIsSaid) {
  const std::string rows = "0,0,0\n1,1,1\n2,2,2\n3,3,3\n4,4,4\n";
  const std::string load = error_of("Time,Axial load,Displacement\ns,kN,mm\n" + rows);
  EXPECT_THAT(load, HasSubstr("compute it from Axial load [kN]: axial_stress [MPa] is the load in N over the "
                              "cross-section of the specimen in mm2"));
  EXPECT_THAT(
      load,
      HasSubstr("compute it from Displacement [mm]: axial_strain [1] is the shortening over the height"));
  EXPECT_THAT(error_of("Stress [MPa],Axial strain 1 [1],Axial strain 2 [1]\n" + rows),
              HasSubstr("rename the one that it is: Axial strain 1 [1], Axial strain 2 [1]; or add a column "
                        "of their mean"));
  EXPECT_THAT(error_of("Stress [MPa],Axial strain 1 [1],Lateral strain 1 [1]\n" + rows),
              testing::EndsWith("rename the one that it is: Axial strain 1 [1]"));
}

TEST(CurveIn, CountsAreThoseSoFar) {
  const std::string rows = "0,0,0,0\n1,1,5,5\n2,2,3,8\n3,3,2,10\n4,4,1,11\n";
  EXPECT_EQ(parse_curve("strain [1],stress [Pa],counts,cumulative counts\n" + rows, "t.csv")
                .history.rows[4]
                .n_cracks,
            11.0);
  const std::string falls = error_of("strain [1],stress [Pa],counts,time\n" + rows);
  EXPECT_THAT(falls, HasSubstr("theirs.csv:4: counts = 3"));
  EXPECT_THAT(falls, HasSubstr("and 2 more lines"));
  EXPECT_THAT(error_of("strain [1],stress [Pa],hits\n0,0,-1\n1,1,1\n2,2,2\n3,3,3\n4,4,4\n"),
              HasSubstr("theirs.csv:2: counts = -1"));
}

TEST(CurveIn, CellsThatAreNoNumbersAreToldOncePerColumn) {
  std::string text = "strain [1],stress [MPa]\n0,0\n";
  for (int i = 0; i < 60; ++i) text += "1,x\n";
  const std::string told = error_of(text);
  EXPECT_THAT(told, HasSubstr("theirs.csv:3: stress [MPa] = x"));
  EXPECT_THAT(told, HasSubstr("and 59 more lines"));
  EXPECT_EQ(std::count(told.begin(), told.end(), '\n'), 0) << told;
}

}  // namespace
}  // namespace phy::rock
