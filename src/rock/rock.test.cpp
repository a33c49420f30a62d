// Rock files: what is read, what is told, and that everything wrong is told at once with its line.
#include <cmath>

#include "base/in_folder_fixture.hpp"
#include "base/rng.hpp"
#include "io/table.hpp"
#include "records/calibration.hpp"
#include "rock/file_fixture.hpp"
#include "rock/schema.hpp"
#include "rock/template.hpp"
#include "theory/envelope_fit.hpp"
#include "theory/jaeger.hpp"

namespace phy::rock {
namespace {

TEST_F(RockFile, DiscsHaveADiameterPerRowOrOneForAll) {
  const Rock r = rock("theta [deg],UCS [MPa],BTS [MPa],diameter [mm]\n0,100,9,30\n45,60,8,\n90,120,5,20\n",
                      "[brazilian]\ndiameter = \"25 mm\"\nloading_angle = \"15 deg\"\n");
  EXPECT_DOUBLE_EQ(r.model.test.disc_diameter, 0.025);
  EXPECT_DOUBLE_EQ(r.model.test.loading_angle, 15.0);
  const std::vector<Target> discs = of_property(targets_of(r), Property::brazilian);
  ASSERT_THAT(discs, SizeIs(3));
  EXPECT_DOUBLE_EQ(discs[0].diameter, 0.03);
  EXPECT_EQ(discs[1].diameter, 0.0);  // that of all
  EXPECT_DOUBLE_EQ(discs[2].diameter, 0.02);
}

// What the first page of a report says; a rock without the table says nothing there.
TEST_F(RockFile, HeadOfAReport) {
  const std::string more = "[report]\nauthor = \"A. N.\"\nproject = \"North tunnel\"\n";
  EXPECT_EQ(rock(good, more).readings.size(), 6U);
  const ReportHead head = report_head(at("r.toml"));
  EXPECT_EQ(head.table, "r.csv");
  EXPECT_THAT(head.lines,
              ElementsAre(testing::Pair("project", "North tunnel"), testing::Pair("author", "A. N.")));
  EXPECT_THAT(report_head(write("bare.toml", "data = \"r.csv\"\n")).lines, IsEmpty());
  EXPECT_THAT(problems(good, "[report]\nauthr = \"A. N.\"\n"), Contains(HasSubstr("author")));
}

TEST_F(RockFile, ADiscLargerThanTheSpecimenOrAJawTooWideIsRefused) {
  const std::string csv = "theta [deg],UCS [MPa],BTS [MPa],diameter [mm]\n0,100,9,54\n45,60,,\n90,120,,\n";
  EXPECT_THAT(problems(csv, "[brazilian]\nloading_angle = \"120 deg\"\n"),
              testing::UnorderedElementsAre(
                  AllOf(HasSubstr("r.csv:2: diameter"), HasSubstr("at most the smaller side, 38 mm")),
                  HasSubstr("r.toml:3: brazilian.loading_angle")));
  EXPECT_THAT(problems(csv, "[brazilian]\ndiameter = \"60 mm\"\n"), Contains(HasSubstr("60 mm")));
  EXPECT_THAT(problems(csv, "[specimen]\nwidth = \"54 mm\"\nheight = \"108 mm\"\n"), IsEmpty());
}

TEST_F(RockFile, ReadsValuesInSiWithMissingCells) {
  const Rock r = rock(good);
  ASSERT_THAT(r.readings, SizeIs(6));
  EXPECT_TRUE(r.bedded);
  EXPECT_EQ(r.readings[0].property, Property::E);
  EXPECT_DOUBLE_EQ(r.readings[0].value, 23e9);
  EXPECT_TRUE(std::isnan(r.readings[0].sd));
  EXPECT_DOUBLE_EQ(r.readings[1].sd, 5e6);
  EXPECT_EQ(r.readings[1].n, 3);
  EXPECT_EQ(r.readings[5].line, 4);
}

TEST_F(RockFile, BothAngleConventionsAreOneRock) {
  const Rock beta = rock("beta_deg,E_GPa\n90,23\n45,20\n0,59\n");
  EXPECT_DOUBLE_EQ(beta.readings[0].theta, 0.0);
  EXPECT_DOUBLE_EQ(beta.readings[2].theta, 90.0);
  EXPECT_THAT(beta.notes, Contains(HasSubstr("theta = 90 deg - beta")));
}

TEST_F(RockFile, ByteOrderMarkWindowsLinesSemicolonsAndDecimalCommasAreReadAndSaid) {
  const Rock r = rock("\xEF\xBB\xBFtheta [deg];E [GPa]\r\n0;23,5\r\n45;20,25\r\n90;59\r\n");
  EXPECT_DOUBLE_EQ(r.readings[0].value, 23.5e9);
  EXPECT_DOUBLE_EQ(r.readings[1].value, 20.25e9);
  EXPECT_THAT(r.notes, Contains(HasSubstr("byte-order mark")));
  EXPECT_THAT(r.notes, Contains(HasSubstr("Windows")));
  EXPECT_THAT(r.notes, Contains(HasSubstr("decimal commas")));
}

TEST_F(RockFile, EverythingWrongIsToldAtOnceWithItsLine) {
  const auto p =
      problems("theta [deg],E [GPa],UCS [MPa]\n0,23,105\n120,20,53\n45,20 MPa,-4\n90,59,abc\n60,9\n",
               "colour = \"grey\"\nelastic_reading = \"plain\"\n");
  EXPECT_THAT(p, Contains(AllOf(HasSubstr("r.csv:3: theta = 120 deg"), HasSubstr("mirror image of 60"))));
  EXPECT_THAT(p, Contains(AllOf(HasSubstr("r.csv:4: E = 20 MPa"), HasSubstr("mixed units"))));
  EXPECT_THAT(p, Contains(AllOf(HasSubstr("r.csv:4: UCS = -4 MPa"), HasSubstr("1 kPa <= strength"))));
  EXPECT_THAT(p, Contains(HasSubstr("r.csv:5: UCS = abc")));
  EXPECT_THAT(p, Contains(AllOf(HasSubstr("r.csv:6"), HasSubstr("2 cells"))));
  EXPECT_THAT(p, Contains(HasSubstr("r.toml:2: colour")));
  EXPECT_THAT(p, Contains(AllOf(HasSubstr("r.toml:3"), HasSubstr("plane strain"))));
  std::string places;
  for (const std::string& line : p) {
    const std::size_t file = line.find("/r.") + 1;
    places += line.substr(file, line.find(' ', file) + 1 - file);
  }
  EXPECT_EQ(places, "r.toml:2: r.toml:3: r.csv:3: r.csv:4: r.csv:4: r.csv:5: r.csv:6: ");
}

TEST_F(RockFile, FilesThatCannotBeReadAreToldWithTheRest) {
  EXPECT_THAT(problems("theta [deg],E [GPa]\n0,x\n", "recipe = \"none.toml\"\n"),
              testing::UnorderedElementsAre(
                  AllOf(HasSubstr("r.toml:2: recipe = \"none.toml\""), HasSubstr("check the name")),
                  HasSubstr("r.csv:2: E = x")));
  try {
    read_rock(write("lost.toml", "colour = 1\ndata = \"none.csv\"\n"));
    FAIL() << "no error";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(),
                AllOf(HasSubstr("lost.toml:1: colour"), HasSubstr("lost.toml:2: data = \"none.csv\"")));
  }
}

// What users of Windows write first: one error, and none that only follows from it.
TEST_F(RockFile, APathWithBackslashes) {
  try {
    read_rock(write("w.toml", "data = \"C:\\Users\\a.csv\"\n"));
    FAIL() << "no error";
  } catch (const InputError& e) {
    ASSERT_THAT(e.problems(), SizeIs(1));
    EXPECT_THAT(e.what(),
                AllOf(HasSubstr("w.toml:1: data: expected TOML"), HasSubstr("write / in place of")));
  }
}

// The table is at fault: the keys of layers are right.
TEST_F(RockFile, KeysOfLayersAreNoFaultOfATableThatCannotBeRead) {
  EXPECT_THAT(problems("", "layers = \"planes\"\n[bedding]\nspacing = \"8 mm\"\n"), SizeIs(1));
}

TEST_F(RockFile, KeysAreHeldAgainstTheirList) {
  const auto p = problems(good,
                          "bedded = \"no\"\nconfining = 5\nnmae = \"x\"\npacking = 3\nwidth = 1\n"
                          "[brasilian]\ndiameter = \"30 mm\"\n[specimen]\nheight = \"1 MPa\"\n");
  EXPECT_THAT(
      p, testing::UnorderedElementsAre(
             HasSubstr("r.toml:2: bedded = \"no\": expected true or false"),
             AllOf(HasSubstr("r.toml:3: confining = 5: expected 0 GPa <= value"), HasSubstr("has no unit")),
             AllOf(HasSubstr("r.toml:4: nmae: unknown key"), HasSubstr("did you mean \"name\"?")),
             AllOf(HasSubstr("r.toml:5: packing"), HasSubstr("a key of the recipe")),
             AllOf(HasSubstr("r.toml:6: width"), HasSubstr("a key of the recipe")),
             AllOf(HasSubstr("r.toml:7: brasilian: unknown table"), HasSubstr("did you mean \"brazilian\"?")),
             AllOf(HasSubstr("r.toml:10: specimen.height"), HasSubstr("wrong unit"))));
}

TEST_F(RockFile, MixedUnitsOfTwoColumnsAreRefused) {
  EXPECT_THAT(problems("theta [deg],E [GPa],E [MPa]\n0,23,23000\n45,20,20000\n90,59,59000\n"),
              Contains(HasSubstr("its units are mixed: GPa and MPa")));
  EXPECT_THAT(problems("theta [deg],E\n0,23\n45,20\n90,59\n"),
              Contains(HasSubstr("a unit of E in the header")));
  EXPECT_THAT(problems("theta [deg],UCS [tons]\n0,14500\n45,8000\n90,20000\n"),
              Contains(HasSubstr("write for example UCS [MPa] and convert the values")));
}

TEST_F(RockFile, ABeddedRockNeedsThreeAnglesAnIsotropicOneNone) {
  EXPECT_THAT(problems("theta [deg],E [GPa]\n0,23\n90,59\n0,24\n"),
              Contains(HasSubstr("at least three angles")));
  const Rock isotropic = rock("E [GPa],UCS [MPa]\n60,150\n62,140\n", "bedded = false\n");
  EXPECT_FALSE(isotropic.bedded);
  EXPECT_THAT(isotropic.model.bedding, IsEmpty());
}

TEST_F(RockFile, RepeatedCellsFarApartAreRefused) {
  const std::string csv = "theta [deg],UCS [MPa],UCS_sd [MPa]\n0,100,4\n45,50,4\n90,130,4\n0,121,4\n";
  EXPECT_THAT(problems(csv), Contains(AllOf(HasSubstr("r.csv:5: UCS"), HasSubstr("line 2"))));
  EXPECT_THAT(problems("theta [deg],UCS [MPa],UCS_sd [MPa]\n0,100,4\n45,50,4\n90,130,4\n0,119,4\n"),
              IsEmpty());
}

TEST_F(RockFile, EmptyFilesAndDoubtfulDelimitersAreRefused) {
  EXPECT_THAT(problems(""), Contains(HasSubstr("the file is empty")));
  EXPECT_THAT(problems("theta [deg];E [GPa],UCS [MPa]\n0;23,105\n"), Contains(HasSubstr("one delimiter")));
  EXPECT_THAT(problems("theta [deg],E [GPa]\n0,23,5\n45,20,2\n90,59,1\n"),
              Contains(HasSubstr("decimal commas need semicolons")));
  EXPECT_THAT(problems("theta [deg];E [GPa]\n0;23,5\n45;20.5\n90;59\n"), Contains(HasSubstr("not both")));
  const std::string empty = write("empty.toml", "\n");
  EXPECT_THROW(read_rock(empty), InputError);
}

TEST_F(RockFile, ModuliUnderSeveralPressuresAreTargetsOfTheirOwn) {
  const std::string csv =
      "theta [deg],confining [MPa],E [GPa]\n0,10,18\n45,10,21\n90,10,33\n0,50,20\n45,50,23\n90,50,34\n";
  const std::vector<Target> E = of_property(targets_of(rock(csv)), Property::E);
  ASSERT_THAT(E, SizeIs(6));
  EXPECT_EQ(E[0].confining, 10e6);
  EXPECT_EQ(E[1].confining, 50e6);
  EXPECT_EQ(E[1].mean, 20e9);
  const std::vector<Target> least = least_confined(E);
  ASSERT_THAT(least, SizeIs(3));
  EXPECT_EQ(least[2].mean, 33e9);
  EXPECT_THAT(rock(csv, "confining = \"50 MPa\"\n").readings, SizeIs(3));
  EXPECT_THAT(rock(csv, "confining = \"49 MPa\"\n").readings, SizeIs(3)) << "within 5 % it is one";
  EXPECT_THAT(problems(csv, "confining = \"30 MPa\"\n"),
              Contains(HasSubstr("the table has them at 10, 50 MPa")));
}

TEST_F(RockFile, APressureThatIsChosenIsThatOfModuliAlone) {
  const Rock r = rock(
      "theta [deg],confining [MPa],E [GPa],UCS [MPa]\n0,0,18,90\n0,10,20,120\n45,10,21,80\n90,10,33,140\n",
      "confining = \"10 MPa\"\n");
  EXPECT_THAT(of_property(targets_of(r), Property::E), SizeIs(3));
  EXPECT_EQ(of_property(targets_of(r), Property::E).front().mean, 20e9);
  EXPECT_THAT(of_property(targets_of(r), Property::ucs), SizeIs(1));
  EXPECT_THAT(of_property(targets_of(r), Property::confined), SizeIs(3));
}

TEST_F(RockFile, UcsUnderConfinementAndSigma1AreOneAndTheSame) {
  const Rock r = rock(
      "theta [deg],confining [MPa],UCS [MPa],sigma_1 [MPa],sigma_1_sd [MPa],n\n0,5,100,,,2\n0,5,,110,5,3\n"
      "0,,80,,,1\n45,10,,90,,1\n90,0,,95,,1\n");
  const std::vector<Target> confined = of_property(targets_of(r), Property::confined);
  ASSERT_THAT(confined, SizeIs(2));
  EXPECT_EQ(confined[0].n, 5);
  EXPECT_NEAR(confined[0].mean, 106e6, 1.0);
  EXPECT_EQ(confined[1].confining, 10e6);
  EXPECT_EQ(cell_name(confined[1]), "sigma_1(45, 10 MPa)");
  EXPECT_THAT(of_property(targets_of(r), Property::ucs), SizeIs(2));  // at 0 and, without pressure, at 90
}

TEST_F(RockFile, CrackInitiationGoesWithTheUcsOfItsAngle) {
  const std::string head = "theta [deg],confining [MPa],UCS [MPa],sigma_ci [MPa],sigma_ci_sd [MPa],n\n";
  const std::string rest = "45,,80,40,5,3\n90,,120,,,3\n";
  EXPECT_THAT(problems(head + "0,,100,45,4,3\n" + rest), IsEmpty());
  EXPECT_THAT(
      problems(head + "0,,,45,4,3\n" + rest),
      testing::ElementsAre(AllOf(HasSubstr("r.csv:2: sigma_ci"), HasSubstr("UCS at the same angle"))));
  EXPECT_THAT(
      problems(head + "0,,100,110,4,3\n" + rest),
      testing::ElementsAre(AllOf(HasSubstr("r.csv:2: sigma_ci"), HasSubstr("below the mean of UCS"))));
  const Rock r = rock(head + "0,10,150,70,4,3\n0,,100,45,4,3\n" + rest);
  const std::vector<Target> initiation = of_property(targets_of(r), Property::crack_initiation);
  ASSERT_THAT(initiation, SizeIs(2));  // under confinement it is no target
  EXPECT_EQ(cell_name(initiation[0]), "sigma_ci(0)");
  EXPECT_THAT(r.notes, Contains(HasSubstr("sigma_ci under confining pressure is kept, not fitted")));
}

const std::string envelope_head =
    "theta [deg],UCS [MPa],c [MPa],phi [deg],confining_min [MPa],confining_max [MPa],n\n";

TEST_F(RockFile, StrengthsUnderConfinementThatNoRockHasAreRefused) {
  const std::string head = "theta [deg],confining [MPa],UCS [MPa],sigma_1 [MPa],E [GPa]\n";
  const std::string rest = "45,,80,,\n90,,120,,\n";
  EXPECT_THAT(problems(head + "0,30,,25,\n" + rest),
              testing::ElementsAre(AllOf(HasSubstr("r.csv:2: sigma_1"), HasSubstr("deviatoric"))));
  EXPECT_THAT(problems(head + "0,30,,50,\n" + rest), IsEmpty());
  EXPECT_THAT(problems(head + "0,10,100,150,\n" + rest),
              testing::ElementsAre(AllOf(HasSubstr("r.csv:2: sigma_1"), HasSubstr("not both"))));
  EXPECT_THAT(problems(head + "0,10,100,,20\n" + rest, "confining = \"7 MPa\"\n"),
              testing::ElementsAre(AllOf(HasSubstr("confining"), HasSubstr("E and nu at that pressure"))));
  EXPECT_THAT(problems(envelope_head + "0,40,0,0,0,20,3\n45,30,,,,,3\n90,45,,,,,3\n"),
              Contains(AllOf(HasSubstr("r.csv:2: c, phi"), HasSubstr("above 1.1 times"))));
}

TEST_F(RockFile, TensionUnderConfiningPressureIsSaidNotToBeFitted) {
  const Rock r = rock("theta [deg],confining [MPa],UCS [MPa],BTS [MPa]\n0,5,100,9\n45,5,60,\n90,5,120,\n");
  EXPECT_THAT(r.notes, Contains(AllOf(HasSubstr("BTS"), HasSubstr("not fitted"))));
  EXPECT_THAT(of_property(targets_of(r), Property::brazilian), IsEmpty());
  EXPECT_THAT(rock("theta [deg],confining [MPa],UCS [MPa]\n0,5,100\n45,5,60\n90,5,120\n").notes,
              Each(testing::Not(HasSubstr("not fitted"))));
}

// N = tan^2 60 = 3, 2 c sqrt(N) = 34.641 MPa; three tests at 0, 10, 20 MPa have a mean of 10 and a standard
// deviation of sqrt(200/3) = 8.165 MPa.
TEST_F(RockFile, AnEnvelopeIsTwoStrengthsInsideItsPressures) {
  const Rock r = rock(envelope_head + "0,40,10,30,0,20,3\n45,30,,,,,3\n90,45,,,,,3\n");
  const std::vector<Target> two = of_property(targets_of(r), Property::confined);
  ASSERT_THAT(two, SizeIs(2));
  EXPECT_NEAR(two[0].confining, 1.835e6, 1e3);
  EXPECT_NEAR(two[1].confining, 18.165e6, 1e3);
  EXPECT_NEAR(two[0].mean, 40.146e6, 2e3);
  EXPECT_NEAR(two[1].mean, 89.136e6, 2e3);
  EXPECT_EQ(two[0].n, 1);
  EXPECT_THAT(two[0].specimens, IsEmpty());  // nobody tested it
  EXPECT_THAT(r.notes, Contains(HasSubstr("c and phi of 1 row(s)")));
}

TEST_F(RockFile, TheNamesOfLaboratoriesForAnEnvelopeAreKnown) {
  const Rock r = rock(
      "theta [deg],UCS [MPa],cohesion [MPa],friction angle [deg],confining_min [MPa],confining_max [MPa],n\n"
      "0,51,15.22,37.89,5,20,3\n45,43,11.68,34.95,5,20,3\n90,64,16.86,36.76,5,20,3\n");
  EXPECT_THAT(of_property(targets_of(r), Property::confined), SizeIs(6));
}

// What the reading rests on: a line through noisy strengths at four pressures, read at two, 4,000 times.
TEST_F(RockFile, ErrorsOfTheTwoStrengthsOfAnEnvelopeDoNotDependOnEachOther) {
  const Rock r = rock(envelope_head + "0,40,10,30,5,35,4\n45,30,,,,,3\n90,45,,,,,3\n");
  const std::vector<Target> two = of_property(targets_of(r), Property::confined);
  constexpr int n_draws = 4000;
  double aa = 0.0, bb = 0.0, ab = 0.0;
  for (std::uint32_t k = 0; k < n_draws; ++k) {
    std::vector<theory::EnvelopeReading> tests;
    for (const double sigma_3 : {5e6, 15e6, 25e6, 35e6})
      tests.push_back({sigma_3, 35e6 + 3.0 * sigma_3 +
                                    1e6 * normal(3, Stream::test, k, static_cast<std::uint32_t>(sigma_3))});
    const theory::MohrCoulombFit line = theory::fit_mohr_coulomb(tests);
    ASSERT_TRUE(line.ok);
    const auto error = [&](double sigma_3) {
      const theory::Coulomb rock_read{line.cohesion.value, line.friction.value};
      return theory::coulomb_sigma_1(rock_read, sigma_3) - 35e6 - 3.0 * sigma_3;
    };
    const double a = error(two[0].confining), b = error(two[1].confining);
    aa += a * a / n_draws, bb += b * b / n_draws, ab += a * b / n_draws;
  }
  EXPECT_NEAR(ab / std::sqrt(aa * bb), 0.0, 0.05);
  EXPECT_NEAR(std::sqrt(aa), 1e6 / std::sqrt(2.0), 3e4);  // each as of two of the four tests
  EXPECT_NEAR(std::sqrt(bb), 1e6 / std::sqrt(2.0), 3e4);
  EXPECT_EQ(two[0].n, 2);
}

TEST_F(RockFile, AnEnvelopeWithoutItsPressuresIsRefused) {
  EXPECT_THAT(problems("theta [deg],UCS [MPa],c [MPa],phi [deg]\n0,40,10,30\n45,30,,\n90,45,,\n"),
              testing::ElementsAre(
                  AllOf(HasSubstr("r.csv:1: c, phi"), HasSubstr("confining_min and confining_max"))));
  EXPECT_THAT(
      problems(envelope_head + "0,40,10,30,20,20,3\n45,30,8,,,,3\n90,45,,,,,3\n"),
      AllOf(SizeIs(2), Contains(HasSubstr("r.csv:2: c, phi")), Contains(HasSubstr("r.csv:3: c, phi"))));
}

TEST_F(RockFile, PartsOfSpecimensAreRefused) {
  EXPECT_THAT(problems("theta [deg],E [GPa],n\n0,23,2.5\n45,20,3\n90,59,3\n"),
              Contains(AllOf(HasSubstr("r.csv:2: n = 2.5"), HasSubstr("whole number"))));
}

TEST_F(RockFile, PlaneStrainThatLeavesNoPositiveModulusIsRefused) {
  const std::string csv = "theta [deg],E [GPa],nu\n0,20,0.2\n45,25,0.3\n90,30,1.2\n";
  EXPECT_THAT(problems(csv), IsEmpty());
  EXPECT_THAT(problems(csv, "elastic_reading = \"plane strain\"\n"),
              Contains(HasSubstr("a nu that leaves E(90) positive")));
}

TEST_F(RockFile, TheTemplateIsARockWithoutValues) {
  write("new.csv", rock_table_template());
  const std::string path = write("new.toml", rock_template("new", "new.csv"));
  try {
    read_rock(path);
    FAIL() << "an empty table was accepted";
  } catch (const InputError& e) {
    ASSERT_THAT(e.problems(), SizeIs(1));
    EXPECT_THAT(e.what(), HasSubstr("all cells are empty"));
  }
}

// 100, 104 (n = 1 each): mean 102, squares 8, relative 7.69e-4, one degree of freedom; the prior lends four
// of 10 %: (7.69e-4 + 4 x 0.01)/5 = 0.0903^2. The others borrow from five: the same.
TEST_F(RockFile, ReplicatesBecomeOneTargetAndLendTheirScatter) {
  const auto t =
      of_property(targets_of(rock("theta [deg],UCS [MPa]\n0,100\n0,104\n45,50\n90,130\n")), Property::ucs);
  ASSERT_THAT(t, SizeIs(3));
  EXPECT_DOUBLE_EQ(t[0].mean, 102e6);
  EXPECT_EQ(t[0].n, 2);
  EXPECT_NEAR(t[0].sd, 9.2105e6, 100.0);
  EXPECT_NEAR(t[0].standard_error(), 6.5128e6, 100.0);
  EXPECT_NEAR(t[0].half_width(), 2.5706 * 6.5128e6, 1e3);  // Student, five degrees of freedom
  EXPECT_NEAR(t[1].sd, 4.5149e6, 100.0);
}

// 100, 105, 110 have a mean of 105 and an SD of 5.
TEST_F(RockFile, AMeanWithItsSdAndNumberIsWorthItsReplicates) {
  const std::string others = "45,50,,\n90,130,,\n90,139,,\n", head = "theta [deg],UCS [MPa],UCS_sd [MPa],n\n";
  const auto typed = targets_of(rock(head + "0,105,5,3\n" + others)),
             rows = targets_of(rock(head + "0,100,,\n0,105,,\n0,110,,\n" + others));
  ASSERT_EQ(typed.size(), rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_DOUBLE_EQ(typed[i].mean, rows[i].mean);
    EXPECT_EQ(typed[i].n, rows[i].n);
    EXPECT_EQ(typed[i].degrees, rows[i].degrees);
    EXPECT_NEAR(typed[i].sd / rows[i].sd, 1.0, 1e-12);
    EXPECT_EQ(typed[i].sd_assumed, rows[i].sd_assumed);
  }
}

TEST_F(RockFile, AnSdOfAnUnknownNumberOfSpecimensIsThatOfTwo) {
  const std::string head = "theta [deg],UCS [MPa],UCS_sd [MPa]";
  const std::string rows[] = {"\n0,105,5", "\n45,50,", "\n90,130,"};
  const Rock untold = rock(head + rows[0] + rows[1] + rows[2] + "\n"),
             two = rock(head + ",n" + rows[0] + ",2" + rows[1] + "," + rows[2] + ",\n");
  EXPECT_THAT(untold.notes, Contains(HasSubstr("1 of 3 values have an SD but no number of specimens")));
  EXPECT_THAT(two.notes, testing::Not(Contains(HasSubstr("number of specimens"))));
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_DOUBLE_EQ(targets_of(untold)[i].half_width(), targets_of(two)[i].half_width());
}

TEST_F(RockFile, SingleSpecimensStayWithTheirTarget) {
  const auto t = targets_of(rock("theta [deg],UCS [MPa],n\n0,100,1\n0,104,1\n45,50,3\n90,130,1\n"));
  EXPECT_THAT(t[0].specimens, testing::ElementsAre(testing::DoubleEq(100e6), testing::DoubleEq(104e6)));
  EXPECT_TRUE(t[1].specimens.empty());  // a mean is no specimen
  const auto plane_stress =
      targets_of(rock("E [GPa],nu\n60,0.25\n", "elastic_reading = \"plane strain\"\nbedded = false\n"));
  for (const Target& cell : plane_stress) {  // the only one is the mean, converted too
    ASSERT_EQ(cell.specimens.size(), 1U);
    EXPECT_DOUBLE_EQ(cell.specimens[0], cell.mean);
  }
}

TEST_F(RockFile, OnePairThatHappensToAgreeMakesNoTableExact) {
  const auto t = targets_of(rock("theta [deg],UCS [MPa]\n0,110\n0,110.2\n45,50\n90,130\n"));
  for (const Target& cell : t) EXPECT_GT(cell.standard_error(), 0.03 * cell.mean) << cell.theta;
  for (const Target& cell : t) EXPECT_TRUE(cell.sd_assumed) << cell.theta;
  const auto equal = targets_of(rock("theta [deg],UCS [MPa]\n0,110\n0,110\n45,50\n90,130\n"));
  for (std::size_t i = 0; i < t.size(); ++i) EXPECT_NEAR(t[i].sd / equal[i].sd, 1.0, 0.002);
}

TEST_F(RockFile, ManyReplicatesSpeakForThemselves) {
  std::string csv = "theta [deg],UCS [MPa]\n45,50\n90,130\n";
  for (int i = 0; i < 20; ++i) csv += i % 2 == 0 ? "0,88\n" : "0,112\n";  // 12 % about 100
  const auto t = targets_of(rock(csv));
  EXPECT_NEAR(t[0].sd, 12e6, 1.5e6);
  EXPECT_NEAR(t[2].sd / t[2].mean, 0.12, 0.015);
  EXPECT_FALSE(t[2].sd_assumed);
}

// Isotropic: E_2D = E/(1 - nu^2), nu_2D = nu/(1 - nu).
TEST_F(RockFile, PlaneStrainIsConverted) {
  const auto t =
      targets_of(rock("E [GPa],nu\n60,0.25\n", "elastic_reading = \"plane strain\"\nbedded = false\n"));
  EXPECT_NEAR(t[0].mean, 60e9 / (1.0 - 0.0625), 1.0);
  EXPECT_NEAR(t[1].mean, 0.25 / 0.75, 1e-12);
  EXPECT_THAT(problems("E [GPa]\n60\n", "elastic_reading = \"plane strain\"\nbedded = false\n"),
              Contains(HasSubstr("a column nu")));
}

// The rock that holds the strain out of the plane is under the same stress.
TEST_F(RockFile, PlaneStrainIsConvertedUnderEachStressByItself) {
  const Rock r = rock("confining [MPa],E [GPa],nu\n0,10,0.3\n20,40,0.2\n40,60,0.2\n",
                      "elastic_reading = \"plane strain\"\nbedded = false\n");
  const std::vector<Target> t = targets_of(r);
  ASSERT_THAT(t, SizeIs(6));
  EXPECT_NEAR(t[0].mean, 10e9 / (1.0 - 0.09), 1.0);
  EXPECT_NEAR(t[1].mean, 40e9 / (1.0 - 0.04), 1.0);
  EXPECT_NEAR(t[2].mean, 60e9 / (1.0 - 0.04), 1.0);
  EXPECT_NEAR(t[5].mean, 0.25, 1e-12);
}

// d nu_2D/d nu = 1/(1 - nu)^2 in an isotropic rock: what two tables that differ in nu differ by.
TEST_F(RockFile, PlaneStrainConvertsTheScatterOfNuToo) {
  const auto nu_2D = [&](const std::string& nu) {
    return targets_of(rock("E [GPa],nu,nu_sd\n60," + nu + ",0.03\n",
                           "elastic_reading = \"plane strain\"\nbedded = false\n"))[1];
  };
  const double slope = (nu_2D("0.251").mean - nu_2D("0.249").mean) / 0.002;
  EXPECT_NEAR(nu_2D("0.25").sd, 0.03 * slope, 1e-6);
  const auto bedded = [&](const std::string& nu) {  // across the bedding: nu along it is another specimen's
    return targets_of(rock("theta [deg],E [GPa],nu,nu_sd\n0,20," + nu + ",0.02\n45,25,,\n90,30,0.25,0.03\n",
                           "elastic_reading = \"plane strain\"\n"))[3];
  };
  // one degree of freedom of 0.02, five of 0.03: the prior's and the other cell's
  const double sd = std::sqrt((0.02 * 0.02 + 5.0 * 0.03 * 0.03) / 6.0);
  EXPECT_NEAR(bedded("0.10").sd, sd * (bedded("0.101").mean - bedded("0.099").mean) / 0.002, 1e-6);
}

TEST_F(RockFile, WhatEIsHasToBeOneOfItsWords) {
  EXPECT_EQ(rock(good).E_is, ModulusReading::tangent_50);
  EXPECT_EQ(rock(good, "E_is = \"secant at peak\"\n").E_is, ModulusReading::secant_at_peak);
  EXPECT_THAT(problems(good, "E_is = \"secant\"\n"),
              testing::ElementsAre(AllOf(HasSubstr("r.toml:2: E_is"), HasSubstr("\"secant 50 %\""))));
}

TEST_F(RockFile, OneMistakeIsToldOnce) {
  EXPECT_THAT(problems("theta [deg],E [GPa]\n0,23\n45,x\n90,59\n"),
              testing::ElementsAre(HasSubstr("r.csv:3: E = x")));
  EXPECT_THAT(problems(good, "[specimen]\nwidth = \"-5 mm\"\n"),
              testing::ElementsAre(AllOf(HasSubstr("r.toml:3: specimen.width = \"-5 mm\""),
                                         HasSubstr("0.1 mm <= value <= 1000 m"))));
}

TEST_F(RockFile, IndentedCommentsAreCommentsAndUtf16IsNamed) {
  EXPECT_THAT(
      problems(
          "  # an essay, with commas; and semicolons\ntheta [deg],E [GPa]\n0,23\n\t# more\n45,20\n90,59\n"),
      IsEmpty());
  const std::string csv = "theta [deg],E [GPa]\n0,23\n";
  std::string wide = "\xFF\xFE";
  for (const char c : csv) wide += c, wide += '\0';
  EXPECT_THAT(problems(wide),
              testing::ElementsAre(AllOf(HasSubstr("UTF-16"), HasSubstr("save it anew as UTF-8"))));
}

TEST(TableText, QuotedCellsMayHoldTheDelimiter) {
  const io::Table t = io::parse_table("a,b\n\"x, \"\"y\"\"\",2\n# comment\n\n", "t");
  ASSERT_THAT(t.rows, SizeIs(1));
  EXPECT_EQ(t.rows[0].cells[0], "x, \"y\"");
  EXPECT_THAT(t.problems, IsEmpty());
}

}  // namespace
}  // namespace phy::rock
