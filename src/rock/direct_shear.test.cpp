// Direct shear of bedding in a table: rows of a normal stress and the strengths under it, without an angle.
#include "rock/file_fixture.hpp"

namespace phy::rock {
namespace {

const std::string table =
    "theta [deg],UCS [MPa],sigma_n [MPa],tau_peak [MPa],tau_residual [MPa]\n"
    "0,100,,,\n45,60,,,\n90,120,,,\n,,2,15.5,1\n,,10,18.5,4.4\n,,10,19.5,4.6\n";

TEST_F(RockFile, ShearIsReadUnderItsNormalStress) {
  const std::vector<Target> all = targets_of(rock(table));
  const std::vector<Target> peak = of_property(all, Property::shear_peak),
                            residual = of_property(all, Property::shear_residual);
  ASSERT_THAT(peak, SizeIs(2));
  ASSERT_THAT(residual, SizeIs(2));
  EXPECT_DOUBLE_EQ(peak[0].confining, 2e6);
  EXPECT_DOUBLE_EQ(peak[1].mean, 19e6) << "two boxes under one stress are replicates";
  EXPECT_EQ(peak[1].n, 2);
  EXPECT_DOUBLE_EQ(residual[1].mean, 4.5e6);
  EXPECT_EQ(peak[0].theta, 0.0) << "bedding lies level in the box";
  EXPECT_THAT(of_property(all, Property::ucs), SizeIs(3));
}

TEST_F(RockFile, ShearIsReadUnderTheNamesOfLaboratories) {
  const Rock r = rock(
      "theta (deg),UCS (MPa),s_n(kPa),t_p(kPa),t_r(kPa)\n0,100,,,\n45,60,,,\n90,120,,,\n,,500,900,300\n");
  const std::vector<Target> peak = of_property(targets_of(r), Property::shear_peak);
  ASSERT_THAT(peak, SizeIs(1));
  EXPECT_DOUBLE_EQ(peak[0].mean, 0.9e6);
  EXPECT_DOUBLE_EQ(peak[0].confining, 0.5e6);
}

// Stress across bedding and stress on the sides of a specimen are two things, however near they are.
TEST_F(RockFile, ANormalStressIsNoConfinement) {
  const std::vector<Target> all =
      targets_of(rock("theta [deg],sigma_1 [MPa],confining [MPa],sigma_n [MPa],tau_peak [MPa]\n"
                      "0,200,10,,\n45,90,10,,\n90,210,10,,\n,,,10.2,19\n"));
  EXPECT_DOUBLE_EQ(of_property(all, Property::shear_peak)[0].confining, 10.2e6);
  EXPECT_DOUBLE_EQ(of_property(all, Property::confined)[0].confining, 10e6);
}

TEST_F(RockFile, ShearThatCannotBeIsRefused) {
  const std::string rows =
      "theta [deg],UCS [MPa],sigma_n [MPa],tau_peak [MPa],tau_residual [MPa]\n"
      "0,100,,,\n45,60,,,\n90,120,,,\n";
  EXPECT_THAT(problems(rows + ",,,15,1\n"), Contains(HasSubstr("r.csv:5: sigma_n")));
  EXPECT_THAT(problems(rows + ",,5,,1\n"), Contains(HasSubstr("tau_peak in the same row")));
  EXPECT_THAT(problems(rows + ",,5,1,15\n"), Contains(HasSubstr("are two columns swapped?")));
  EXPECT_THAT(problems(rows + ",70,5,15,1\n"), Contains(HasSubstr("an angle in every row"))) << "UCS has one";
  EXPECT_THAT(problems("UCS [MPa],sigma_n [MPa],tau_peak [MPa]\n100,5,15\n", "bedded = false\n"),
              Contains(HasSubstr("a rock with bedding")));
}

}  // namespace
}  // namespace phy::rock
