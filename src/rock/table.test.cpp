// Tables as laboratories have them: what columns are taken for, and what is asked for.
#include "rock/table.hpp"

#include "rock/file_fixture.hpp"

namespace phy::rock {
namespace {

TEST_F(RockFile, NamesOfLaboratoriesAreReadAndTold) {
  const Rock r = rock(
      "Sample;β (°);Et50 (GPa);σc (MPa);σ3 (MPa);q "
      "(MPa)\nA;0;23,5;105;;\nB;45;20;53;;\nC;90;59;138;;\nD;0;;;10;150\n");
  ASSERT_THAT(r.readings, SizeIs(7));
  EXPECT_EQ(r.readings[0].theta, 90.0);
  EXPECT_EQ(r.readings[6].property, Property::confined);
  EXPECT_EQ(r.readings[6].value, 160e6);  // q and the confining stress
  EXPECT_EQ(r.E_is, ModulusReading::tangent_50);
  EXPECT_THAT(r.notes, Contains(HasSubstr(
                           "columns by other names: β (°) is beta, Et50 (GPa) is E, σc (MPa) is UCS, σ3 "
                           "(MPa) is confining, q (MPa) is deviator")));
  EXPECT_THAT(r.notes, Contains("columns passed over: Sample"));
}

TEST_F(RockFile, UnitsMayStandInARowOfTheirOwn) {
  const Rock r = rock("theta,E,nu,UCS\ndeg,[GPa],-,MPa\n0,23,0.2,105\n45,20,0.2,53\n90,59,0.2,138\n");
  ASSERT_THAT(r.readings, SizeIs(9));
  EXPECT_EQ(r.readings[0].value, 23e9);
  EXPECT_EQ(r.readings[0].line, 3);
}

TEST_F(RockFile, ARowOfUnitsMayNotContradictTheHeader) {
  EXPECT_THAT(problems("theta,E [MPa],w\ndeg,GPa,%\n0,23,1\n45,20,1\n90,59,1\n"),
              Contains(AllOf(HasSubstr("E [MPa] = GPa"), HasSubstr("one unit"))));
}

TEST_F(RockFile, TheUserSaysWhatAColumnHolds) {
  const std::string csv = "angle [deg],UCS [MPa],Festigkeit,spread [MPa]\n0,1,105,5\n45,1,53,4\n90,1,138,7\n";
  EXPECT_THAT(problems(csv), AllOf(Contains(HasSubstr("an angle that says from where it counts")),
                                   Contains(AllOf(HasSubstr("\"Festigkeit\", \"spread [MPa]\""),
                                                  HasSubstr("\"spread [MPa]\" = ")))));
  const Rock r = rock(
      csv, "[columns]\nangle = \"beta\"\n\"Festigkeit [MPa]\" = \"UCS\"\n\"spread [MPa]\" = \"UCS_sd\"\n");
  ASSERT_THAT(r.readings, SizeIs(3));
  EXPECT_EQ(r.readings[0].value, 105e6);
  EXPECT_EQ(r.readings[0].sd, 5e6);
  EXPECT_EQ(r.readings[0].theta, 90.0);
  EXPECT_THAT(r.notes, Contains("columns passed over: UCS [MPa]"));
  EXPECT_THAT(problems(csv, "[columns]\nangle = \"betta\"\nSpread = \"UCS_sd\"\n\"spread\" = \"-\"\n"),
              AllOf(Contains(HasSubstr("did you mean \"beta\"?")),
                    Contains(AllOf(HasSubstr("Spread"), HasSubstr("a header of this table"),
                                   HasSubstr("Festigkeit")))));
}

TEST_F(RockFile, TwoColumnsOfOneNameAndValuesWithoutAHeaderAreRefused) {
  EXPECT_THAT(problems("theta [deg],Et [GPa],Es [GPa]\n0,1,2\n45,1,2\n90,1,2\n"),
              Contains(AllOf(HasSubstr("one column of E"), HasSubstr("[columns] \"Es\" = \"E\""))));
  EXPECT_THAT(problems("theta [deg],UCS [MPa],,\n0,100,,\n45,60,71,\n90,120,,\n"),
              Contains(AllOf(HasSubstr("column 3"), HasSubstr("line 3 has a value there"))));
}

TEST_F(RockFile, AHeaderAndE_isMayNotDiffer) {
  const std::string csv = "theta [deg],Es [GPa]\n0,23\n45,20\n90,59\n";
  EXPECT_THAT(rock(csv).notes, Contains("E_is = \"secant 50 %\", as the header Es says"));
  EXPECT_THAT(problems(csv, "E_is = \"average\"\n"), Contains(HasSubstr("what the header Es says")));
}

TEST_F(RockFile, AWorkbookIsATable) {
  const std::string seeds = PHY_SOURCE_DIR "/tests/fuzz/seeds/workbook/";
  const Rock r = read_rock(write("x.toml", "data = \"" + seeds + "openpyxl.xlsx\"\nsheet = \"Results\"\n"));
  EXPECT_THAT(of_property(targets_of(r), Property::ucs), SizeIs(4));
  EXPECT_THAT(of_property(targets_of(r), Property::brazilian), SizeIs(3));
  try {
    read_rock(seeds + "openpyxl.xlsx");
    ADD_FAILURE() << "a table is no rock file";
  } catch (const InputError& e) {
    ASSERT_THAT(e.problems(), SizeIs(1));
    EXPECT_THAT(to_line(e.problems()[0]), HasSubstr("phyllite rock new NAME --data"));
  }
}

TEST_F(RockFile, SummaryRowsAreNoSpecimens) {
  for (const char* word : {"Mean", "SD", "St. dev.", "average"})
    EXPECT_THAT(problems("Specimen,theta [deg],UCS [MPa]\nS1,0,100\nS2,45,60\nS3,90,120\n" +
                         std::string(word) + ",0,98\n"),
                Contains(AllOf(HasSubstr("r.csv:5"), HasSubstr("a row of specimens"))))
        << word;
}

TEST_F(RockFile, RowsWithoutAValueAreNone) {
  const Rock r =
      rock("Results of May\nsample,theta [deg],UCS [MPa]\na,0,100\n,,\nb,45,60\nc,90,120\nby N.N.,,\n,,\n");
  EXPECT_THAT(r.readings, SizeIs(3));
  EXPECT_THAT(r.notes, Contains(HasSubstr("line 1, a title, is passed over")));
  EXPECT_THAT(rock("sep=;\ntheta [deg];UCS [MPa]\n0;100\n45;60,5\n90;120\n;\n").readings, SizeIs(3));
}

TEST_F(RockFile, PorosityAndLoadAreNoCounts) {
  for (const char* head : {"n (%)", "N (kN)", "nu (%)", "v [km/s]"})
    EXPECT_THAT(problems("theta [deg],UCS [MPa]," + std::string(head) + "\n0,100,12\n45,60,14\n90,120,9\n"),
                Contains(AllOf(HasSubstr("without a unit"), HasSubstr("= \"-\" in the rock file"))))
        << head;
}

TEST_F(RockFile, AnglesThatSayNotFromWhereTheyCountAreAskedFor) {
  for (const char* head : {"Angle to bedding", "Angle to bedding (°)", "dip direction [deg]"})
    EXPECT_THAT(problems(std::string(head) + ",UCS [MPa]\n0,100\n45,60\n90,120\n"),
                Contains(HasSubstr("an angle that says from where it counts")))
        << head;
  const std::string csv = "Angle to bedding,UCS [MPa],Bedding\n0,100,clear\n45,60,clear\n90,120,weak\n";
  EXPECT_EQ(rock(csv, "[columns]\n\"Angle to bedding [deg]\" = \"beta\"\n").readings[0].theta, 90.0);
}

TEST_F(RockFile, TheUserChoosesBetweenTwoColumns) {
  const std::string csv = "theta [deg],UCS (MPa) dry,UCS (MPa) wet\n0,100,80\n45,60,50\n90,120,90\n";
  EXPECT_THAT(problems(csv), SizeIs(1));  // two unknown columns in one question
  const Rock r = rock(csv, "[columns]\n\"UCS (MPa) dry\" = \"UCS\"\n\"UCS wet\" = \"-\"\n");
  ASSERT_THAT(r.readings, SizeIs(3));
  EXPECT_EQ(r.readings[0].value, 100e6);
  EXPECT_THAT(problems("theta [deg],UCS [MPa],UCS [MPa]\n0,100,80\n"), Contains(HasSubstr("rename one")));
  EXPECT_THAT(
      problems("theta [deg],sigma_1 [MPa],q [MPa],sigma_3 [MPa]\n0,100,80,20\n45,90,70,20\n90,99,79,20\n"),
      Contains(HasSubstr("sigma_1 or the deviator stress")));
}

TEST_F(RockFile, AMergedValueIsOneSpecimens) {
  const Rock r = read_rock(write("x.toml", "data = \"" + std::string(PHY_SOURCE_DIR) +
                                               "/tests/fuzz/seeds/workbook/merged.xlsx\"\nbedded = false\n"));
  ASSERT_THAT(of_property(targets_of(r), Property::E), SizeIs(1));
  EXPECT_EQ(of_property(targets_of(r), Property::E)[0].n, 3);
  EXPECT_EQ(of_property(targets_of(r), Property::ucs)[0].n, 1);
  EXPECT_THAT(r.notes, Contains("2 cell(s) merged with the row above count once, in the first row"));
}

TEST_F(RockFile, E50IsSaidToBeTheTangent) {
  EXPECT_THAT(rock("theta [deg],E50 [GPa]\n0,23\n45,20\n90,59\n").notes,
              Contains("E50 is taken as \"tangent 50 %\"; a secant is E_is = \"secant 50 %\""));
}

}  // namespace
}  // namespace phy::rock
