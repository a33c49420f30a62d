// Tables in the layouts of laboratories: directions in words, units of all kinds, specimens side by side.
// Every column that may hold a direction or a strength is read or asked for.
#include "io/table_cells.hpp"
#include "rock/file_fixture.hpp"
#include "rock/table.hpp"

namespace phy::rock {
namespace {

std::vector<double> values(const Rock& rock, Property property) {
  std::vector<double> all;
  for (const RockReading& r : rock.readings)
    if (r.property == property) all.push_back(r.value);
  return all;
}

class Layouts : public RockFile {
 protected:
  /// Refused with one problem about the first line, with this in it.
  void expect_asked(const std::string& csv, const std::string& says, const std::string& more = "") const {
    EXPECT_THAT(problems(csv, more), Contains(AllOf(HasSubstr("r.csv:1: "), HasSubstr(says)))) << csv;
  }
};

TEST_F(Layouts, ADirectionInWordsIsAskedForAndThenRead) {
  const std::string rows =
      "A1,Parallel to bedding,88,30\nB1,Perpendicular to bedding,80,20\nB2,Perpendicular to "
      "bedding,77,21\nC1,45°,41,24\n";
  const std::string csv = "Sample,Direction of loading,UCS (MPa),E (GPa)\n" + rows;
  const auto asked = problems(csv);
  ASSERT_THAT(asked, SizeIs(1));
  EXPECT_THAT(asked[0], AllOf(HasSubstr("[columns] \"Direction of loading\" = \"theta\""),
                              HasSubstr("\"Parallel to bedding\" counts as theta = 90 deg"),
                              HasSubstr("\"Perpendicular to bedding\" counts as theta = 0 deg")));
  for (const char* convention : {"theta", "beta"}) {
    const Rock r = rock(csv, "[columns]\n\"Direction of loading\" = \"" + std::string(convention) + "\"\n");
    ASSERT_THAT(r.readings, SizeIs(8));
    EXPECT_TRUE(r.bedded);
    EXPECT_EQ(r.readings[0].theta, 90.0);
    EXPECT_EQ(r.readings[2].theta, 0.0);
    EXPECT_EQ(r.readings[6].theta, 45.0);
    EXPECT_THAT(r.notes, Contains(HasSubstr("\"Parallel to bedding\" counts as theta = 90 deg")));
  }
}

TEST_F(Layouts, AColumnThatSpeaksOfADirectionIsNeverLeftOut) {
  for (const char* header :
       {"Orientation", "Direction", "Loading", "Bedding", "Foliation", "Plug", "Type of test"})
    for (const char* cells :
         {"∥,⊥,45°", "parallel,perpendicular,45°", "0°,30°,90°", "∥ bedding,⊥ bedding,∥ bedding"}) {
      const std::string c = cells;
      const std::size_t a = c.find(','), b = c.rfind(',');
      expect_asked(std::string(header) + ",UCS [MPa]\n" + c.substr(0, a) + ",88\n" +
                       c.substr(a + 1, b - a - 1) + ",80\n" + c.substr(b + 1) + ",41\n",
                   "an angle that says from where it counts");
    }
  for (const char* header :
       {"Orientation", "Loading direction", "Schistosity", "plug", "层理倾角", "Orientation"})
    expect_asked(std::string(header) + ",UCS [MPa]\nx,88\ny,80\nz,41\n",
                 "an angle that says from where it counts");
  expect_asked("Bedding,UCS [MPa]\nV,88\nH,80\n45,41\n", "[columns] \"Bedding [deg]\" = \"theta\"");
  for (const char* header : {"Angle (α)", "Bedding angle (ψ)", "TCA", "Угол", "Tilt of layers", "deg"})
    expect_asked(std::string(header) + ",UCS [MPa]\n0,88\n45,80\n90,41\n",
                 "an angle that says from where it counts");
  expect_asked("Bedding angle,UCS [MPa]\n0,88\nn.d.,80\n90,41\n", "\"Bedding angle [deg]\" = \"theta\"");
  expect_asked("Orientation,UCS [MPa]\nV,88\nH,80\nV,41\n", "90 where the load is along them");  // of what?
  // What only describes the rock, beside a column of angles, is no direction.
  EXPECT_THAT(problems("theta [deg],Bedding,UCS [MPa]\n0,clear,88\n45,clear,80\n90,weak,41\n"), IsEmpty());
}

// Bedding that stands upright is loaded along its layers; a plug that was drilled upright crosses layers that
// lie flat.
TEST_F(Layouts, UprightAndFlatAreThoseOfTheLayersOrOfThePlug) {
  const std::string rows = ",UCS [MPa]\nV,88\nH,80\n45,41\n";
  EXPECT_EQ(rock("Bedding" + rows, "[columns]\n\"Bedding [deg]\" = \"theta\"\n").readings[0].theta, 90.0);
  expect_asked("Bedding in core" + rows, "is it theta");  // whose V and H?
  EXPECT_EQ(rock("Plug" + rows, "[columns]\n\"Plug [deg]\" = \"theta\"\n").readings[0].theta, 0.0);
}

TEST_F(Layouts, DegreeSignsAreReadInCellsAndHeaders) {
  for (const char* header :
       {"theta", "theta [deg]", "θ (°)", "theta ˚", "Angle theta (°)", "Bedding angle θ"}) {
    const Rock r = rock(std::string(header) + ",UCS [MPa]\n0°,88\n22.5º,80\n90˚,41\n");
    ASSERT_THAT(r.readings, SizeIs(3)) << header;
    EXPECT_EQ(r.readings[1].theta, 22.5) << header;
  }
  // Beside the load or the core axis the name alone does not say from where it counts.
  expect_asked("Angle theta to core axis (°),UCS [MPa]\n0,88\n45,80\n90,41\n", "from where it counts");
}

TEST_F(Layouts, ATableWithoutAnyAngleAsksForBedded) {
  const std::string csv = "Sample,UCS [MPa]\nA,88\nB,80\n";
  EXPECT_THAT(problems(csv),
              ElementsAre(AllOf(HasSubstr("no column of angles"), HasSubstr("bedded = false"))));
  EXPECT_FALSE(rock(csv, "bedded = false\n").bedded);
}

TEST_F(Layouts, RadiansBelowDegreesAreAskedAbout) {
  const std::string rows = ",UCS [MPa]\n0,88\n0.5236,60\n0.7854,50\n1.0472,41\n1.5708,90\n";
  expect_asked("theta (deg)" + rows, "theta [rad]");
  const Rock r = rock("theta (rad)" + rows);
  EXPECT_EQ(r.readings[3].theta, 60.0);
  EXPECT_EQ(r.readings[4].theta, 90.0);
  EXPECT_THAT(r.notes, Contains(HasSubstr("converted to SI: theta [rad]")));
}

TEST_F(Layouts, StrengthsAreReadWhateverBracketsTheirUnitHas) {
  for (const char* header :
       {"UCS（MPa）", "UCS {MPa}", "UCS: MPa", "UCS，MPa", "UCS (МПа)", "UCS，（MPa）"}) {
    continue;  // letters of full width are asked for below
    EXPECT_THAT(values(rock("theta (deg),E (GPa)," + std::string(header) + "\n0,20,80\n45,21,55\n90,30,88\n"),
                       Property::ucs),
                ElementsAre(80e6, 55e6, 88e6))
        << header;
  }
}

TEST_F(Layouts, StrengthsThatAreNotUnderstoodAreAskedFor) {
  for (const char* header : {"UCS MPa (dry)", "Rсж (МПа)", "Strength (MPa)", "UCS (dry)", "residual UCS",
                             "Failure strength", "Peak axial stress at failure (psi)", "Load (psi)",
                             "Est. cohesion (kgf/cm2)", "Druckfestigkeit", "UCS1 (MPa)", "强度",
                             "UCS (ton/ft)", "Прочность на сжатие", "E-Modul", "Módulo elástico", "圧縮強度"})
    expect_asked("theta (deg),E (GPa)," + std::string(header) + "\n0,20,80\n45,21,55\n90,30,88\n",
                 io::plain_name(header));
  // Words are no strengths.
  EXPECT_THAT(
      problems("theta (deg),E (GPa),Strength class,Load (kN),Loading rate,Plug no,Strain at peak stress (%)\n"
               "0,20,low,3,1,1,2\n45,21,low,4,1,2,2\n90,30,high,5,1,3,2\n"),
      IsEmpty());
}

TEST_F(Layouts, UnitsOfAllKindsAreConvertedAndSaid) {
  const Rock r = rock(
      "theta [deg],UCS [kgf/cm2],E (x10^4 MPa),BTS (psi),Diameter (in)\n0,816,2.0,1000,2.49\n"
      "45,428,2.4,900,2.49\n90,897,3.0,500,2.49\n",
      "[specimen]\nwidth = \"70 mm\"\nheight = \"140 mm\"\n");
  EXPECT_DOUBLE_EQ(values(r, Property::ucs)[0], 816 * 98066.5);
  EXPECT_DOUBLE_EQ(values(r, Property::E)[0], 20e9);
  EXPECT_NEAR(values(r, Property::brazilian)[0], 6.894757e6, 10.0);
  EXPECT_DOUBLE_EQ(of_property(targets_of(r), Property::brazilian)[0].diameter, 0.063246);
  EXPECT_THAT(r.notes, Contains("converted to SI: UCS [kgf/cm2], E [10^4 MPa], BTS [psi], Diameter [in]"));
}

TEST_F(Layouts, AdviceOnAUnitIsOfItsDimensionAndNeverASecondBracket) {
  EXPECT_THAT(problems("theta [deg],Diameter,BTS [MPa]\n0,54,8\n45,54,6\n90,54,4\n"),
              Contains(AllOf(HasSubstr("Diameter [mm]"), Not(HasSubstr("[MPa]")))));
  EXPECT_THAT(problems("theta [deg],UCS (kip/mile2)\n0,8\n45,6\n90,9\n"),
              Contains(AllOf(HasSubstr("kip/mile2"),
                             HasSubstr("write for example UCS [MPa] and convert the values"))));
  EXPECT_THAT(problems("theta (gon),UCS (MPa)\n0,8\n45,6\n90,9\n"),
              Contains(HasSubstr("write for example theta [deg] and convert the values")));
}

TEST_F(Layouts, HeadersWithoutAUnitAreAskedForInOneMessage) {
  EXPECT_THAT(problems("theta,sigma1    ,sigma3\n0,300,20\n45,200,20\n90,310,20\n"),
              ElementsAre(AllOf(HasSubstr("\"theta\", \"sigma1\", \"sigma3\""),
                                HasSubstr("theta [deg], sigma1 [MPa], sigma3 [MPa]"))));
  // The diameter of a UCS specimen is none of what is read.
  EXPECT_THAT(
      problems(
          "theta [deg],UCS [MPa],UCS diameter [mm],RUCS_LEN [mm]\n0,30,50,100\n45,20,50,100\n90,31,50,100\n"),
      IsEmpty());
}

// As of a mine: units below the headers, one of them none of ours, a header without one.
TEST_F(Layouts, OneUnknownUnitInARowOfUnitsIsToldOnceAtItsColumn) {
  const Rock r =
      rock("theta,UCS,E,nu,w\ndeg,psi,Mpsi,–,%\n0,11600,3,0.2,1\n45,6100,3.3,0.2,1\n90,12700,4,0.2,2\n");
  EXPECT_NEAR(values(r, Property::ucs)[0], 79.98e6, 1e4);
  EXPECT_THAT(problems("theta,UCS,E\ndeg,lbs,GPa\n0,11600,3\n45,6100,3.3\n90,12700,4\n"),
              ElementsAre(AllOf(HasSubstr("UCS = lbs"), HasSubstr("UCS [MPa] and convert the values"))));
  const auto asked = problems(
      "Hole,Depth,Failure Load,Failure strength,UCS**,Angle,Diameter,Est. "
      "Cohesion\n,feet,lb,psi,psi,deg,in,psi\n"
      "H-63,331,65100,14390,14440,60,2.49,5770\nH-63,482,68100,15030,15060,50,2.5,6840\n");
  EXPECT_THAT(asked, ElementsAre(AllOf(HasSubstr("Angle"), HasSubstr("from where it counts")),
                                 AllOf(HasSubstr("\"Failure strength\", \"Est. Cohesion\""),
                                       HasSubstr("[columns]"))));
}

TEST_F(Layouts, SpecimensSideBySideAreReplicates) {
  const std::vector<double> first = {80e6, 84e6, 77e6};
  for (const char* names :
       {"UCS1 (MPa),UCS2 (MPa),UCS3 (MPa),Mean,SD",
        "UCS S1 (MPa),UCS S2 (MPa),UCS S3 (MPa),UCS Mean (MPa),UCS SD (MPa)",
        "UCS (MPa) specimen 1,UCS (MPa) specimen 2,UCS (MPa) specimen 3,mean UCS (MPa),UCS_sd (MPa)",
        "UCS_a [MPa],UCS_b [MPa],UCS_c [MPa],Average,St. dev."}) {
    const Rock r = rock("theta (deg)," + std::string(names) +
                        "\n0,80,84,77,80.3,3.5\n45,42,45,,42.3,2.5\n90,88,93,85,88.7,4\n");
    EXPECT_THAT(values(r, Property::ucs), ElementsAre(80e6, 84e6, 77e6, 42e6, 45e6, 88e6, 93e6, 85e6))
        << names;
    EXPECT_EQ(of_property(targets_of(r), Property::ucs)[0].n, 3);
    EXPECT_THAT(r.notes,
                AllOf(Contains(HasSubstr("are specimens of UCS")), Contains(HasSubstr("set aside"))));
  }
  EXPECT_THAT(values(rock("theta [deg],UCS [MPa],UCS [MPa]2,UCS [MPa]3\n0,20,21,2\n45,22,23,2\n90,30,31,2\n"),
                     Property::ucs),
              SizeIs(9));
  // Constants of an anisotropic body are no specimens.
  expect_asked("theta [deg],E1 [GPa],E2 [GPa]\n0,20,21\n45,22,23\n90,30,31\n", "\"E1 [GPa]\", \"E2 [GPa]\"");
  // The user's word makes replicates of any columns.
  EXPECT_THAT(values(rock("theta [deg],dry [MPa],also dry [MPa]\n0,20,21\n45,22,23\n90,30,31\n",
                          "[columns]\ndry = \"UCS\"\n\"also dry\" = \"UCS\"\n"),
                     Property::ucs),
              SizeIs(6));
  // Without a first one the mark says something else; a column of SD beside nothing has to be named.
  expect_asked("theta [deg],E25 [GPa],E75 [GPa]\n0,20,21\n45,22,23\n90,30,31\n",
               "\"E25 [GPa]\", \"E75 [GPa]\"");
  expect_asked("theta [deg],UCS [MPa],n,SD\n0,20,3,2\n45,22,3,2\n90,30,3,3\n", "\"SD\"");
  // Right behind its value an SD is its scatter.
  const Rock r = rock("theta [deg],UCS [MPa],SD,BTS [MPa],SD\n0,20,2,5,1\n45,22,2,6,1\n90,30,3,4,1\n");
  EXPECT_EQ(r.readings[0].sd, 2e6);
  EXPECT_EQ(r.readings[1].sd, 1e6);
}

TEST_F(Layouts, FactorsAndQualifiersOfAHeaderAreNotLost) {
  for (const char* header : {"E (x10^3) [MPa]", "E (10^3) (MPa)", "E [10^3] MPa", "E [MPa x 10^3]"})
    EXPECT_THAT(values(rock("theta [deg]," + std::string(header) + "\n0,20\n45,22\n90,30\n"), Property::E),
                ElementsAre(20e9, 22e9, 30e9))
        << header;
  const std::string csv = "theta [deg],E×10³ (MPa)\n0,20\n45,22\n90,30\n";
  expect_asked(csv, "a factor goes into the unit");
  EXPECT_EQ(values(rock(csv, "[columns]\n\"E×10³ [10^3 MPa]\" = \"E\"\n"), Property::E)[0], 20e9);
  for (const char* header : {"UCS (residual) (MPa)", "UCS (wet) [MPa]", "UCS (PFC) (MPa)", "UCS (MPa) (psi)"})
    EXPECT_THAT(problems("theta [deg]," + std::string(header) + "\n0,20\n45,22\n90,30\n"), SizeIs(1))
        << header;
  EXPECT_EQ(rock("theta [deg],Young's modulus (dynamic) (GPa)\n0,20\n45,22\n90,30\n").E_is,
            ModulusReading::small_strain);
  EXPECT_EQ(rock("theta [deg],E (secant) [GPa]\n0,20\n45,22\n90,30\n").E_is, ModulusReading::secant_50);
  for (const char* header : {"\"Uniaxial compressive strength, σc (MPa)\"", "UCS avg (MPa)", "UCS in MPa"})
    EXPECT_THAT(values(rock("theta [deg]," + std::string(header) + "\n0,20\n45,22\n90,30\n"), Property::ucs),
                SizeIs(3))
        << header;
}

// Along the normal of the layers is across them.
TEST_F(Layouts, WordsOfNormalsAndFunctionsOfAValueAreNotRead) {
  expect_asked("Direction of loading,UCS [MPa]\nparallel to bedding normal,80\n45°,42\n∥ to pole,88\n",
               "from where it counts");
  EXPECT_THAT(problems("Direction of loading,UCS [MPa]\nparallel to bedding normal,80\n45°,42\n90°,88\n",
                       "[columns]\n\"Direction of loading\" = \"theta\"\n"),
              Contains(HasSubstr("r.csv:2: Direction of loading")));
  EXPECT_EQ(rock("Loading,UCS [MPa]\nnormal to bedding,80\n45°,42\nparallel,88\n",
                 "[columns]\nLoading = \"theta\"\n")
                .readings[0]
                .theta,
            0.0);
  for (const char* header : {"log10(UCS) [MPa]", "sqrt(UCS) [MPa]", "-UCS [MPa]", "UCS (MPa)*10"})
    expect_asked("theta [deg],E [GPa]," + std::string(header) + "\n0,20,8\n45,21,4\n90,22,9\n",
                 "a known column");
  EXPECT_THAT(
      problems("theta [deg],UCS (MPa)*10\n0,8\n45,4\n90,9\n", "[columns]\n\"UCS (MPa)*10\" = \"UCS\"\n"),
      Contains(HasSubstr("[10^3 MPa]\" = \"UCS\"")));
}

TEST_F(Layouts, AnAnswerKeepsWhatTheHeaderSays) {
  EXPECT_EQ(rock("theta [deg],E [GPa],Ed [GPa]\n0,20,30\n45,22,31\n90,30,41\n",
                 "[columns]\nEd = \"E\"\nE = \"-\"\n")
                .E_is,
            ModulusReading::small_strain);
  // A second column of angles cannot be theta too.
  expect_asked("theta [deg],Angle [deg],UCS [MPa]\n0,30,80\n45,40,42\n90,50,88\n", "leave this one out");
  // The bare name beside numbered ones may be their mean.
  EXPECT_THAT(problems("theta [deg],UCS1 [MPa],UCS2 [MPa],UCS [MPa]\n0,80,82,81\n45,42,44,43\n90,88,90,89\n"),
              SizeIs(1));
  const std::string envelope =
      "theta [deg],UCS [MPa],cohesion [MPa],friction angle [deg]\n0,80,20,30\n45,42,10,30\n90,88,20,30\n";
  expect_asked(envelope, "\"cohesion [MPa]\" = \"-\", \"friction angle [deg]\" = \"-\"");
  EXPECT_THAT(problems(envelope, "[columns]\n\"cohesion [MPa]\" = \"-\"\n\"friction angle [deg]\" = \"-\"\n"),
              IsEmpty());
  EXPECT_EQ(
      rock("theta [deg],No. of specimens,UCS [MPa],± SD\n0,4,80,3\n45,5,42,3\n90,6,88,3\n").readings[0].n, 4);
}

TEST_F(Layouts, ACellWithANumberIsNoWord) {
  for (const char* cell : {"0° (parallel)", "30° to parallel", "sub-parallel", "not parallel"})
    EXPECT_THAT(problems("theta [deg],UCS [MPa]\n" + std::string(cell) + ",20\n45,22\n90,30\n0,31\n"),
                Contains(HasSubstr("r.csv:2: theta = ")))
        << cell;
}

TEST_F(Layouts, AFirstRowOfNumbersIsNoRowOfUnits) {
  EXPECT_THAT(values(rock("n,nu\n1,-\n3,.2\n2,.3\n", "bedded = false\n"), Property::nu), SizeIs(2));
  EXPECT_THAT(values(rock("DTS (MPa)\n1\n2\n1.5\n", "bedded = false\n"), Property::direct_tension),
              SizeIs(3));
  EXPECT_THAT(values(rock("UCS (Pa),E (Pa)\n1e8,1e10\n1e8,1e10\n", "bedded = false\n"), Property::ucs),
              SizeIs(2));
  // Below headers of another language all units are known first.
  EXPECT_THAT(problems("倾角,单轴抗压强度\n°,MPa\n0,80\n45,42\n90,88\n"), SizeIs(2));
}

TEST_F(Layouts, ARunningNumberIsNoNumberOfSpecimens) {
  const std::string csv = "N,theta [deg],UCS [MPa]\n1,0,20\n2,45,22\n3,90,30\n";
  EXPECT_THAT(problems(csv), ElementsAre(AllOf(HasSubstr("r.csv:1: N"), HasSubstr("number the rows"))));
  EXPECT_EQ(rock(csv, "[columns]\nN = \"-\"\n").readings[2].n, 1);
  EXPECT_EQ(rock(csv, "[columns]\nN = \"n\"\n").readings[2].n, 3);
  EXPECT_THAT(problems("N°,theta [deg],UCS [MPa]\n1,0,20\n2,45,22\n3,90,30\n"), IsEmpty());
}

TEST_F(Layouts, TrueTriaxialTestsAreRefusedOrdinaryOnesRead) {
  EXPECT_THAT(
      problems(
          "theta [deg],sigma1 (MPa),sigma2 (MPa),sigma3 (MPa)\n0,300,50,20\n45,200,20,20\n90,310,20,20\n"),
      ElementsAre(AllOf(HasSubstr("r.csv:2: sigma_2 = 50 MPa"), HasSubstr("true triaxial"))));
  EXPECT_THAT(problems("theta [deg],s1 (MPa),s2 (MPa),s3 (MPa)\n0,300,20,20\n45,200,20,20\n90,310,20,20\n"),
              IsEmpty());
}

TEST_F(Layouts, UnknownColumnsAreAskedForInOneMessage) {
  const auto asked = problems(
      "层理倾角(°),单轴抗压强度(MPa),弹性模量(GPa),泊松比,巴西劈裂强度(MPa)\n0,80.5,20.1,0.25,8.1\n");
  EXPECT_THAT(asked, SizeIs(2));  // the angle, and the others
  const Rock r = rock(
      "层理倾角(°),单轴抗压强度(MPa),弹性模量(GPa),泊松比,巴西劈裂强度(MPa)\n0,80.5,20.1,0.25,8.1\n"
      "45,42,23.4,0.25,6.8\n90,88,30,0.25,4.1\n",
      "[columns]\n\"层理倾角\" = \"theta\"\n\"单轴抗压强度\" = \"UCS\"\n\"弹性模量\" = \"E\"\n\"泊松比\" = "
      "\"nu\"\n"
      "\"巴西劈裂强度\" = \"BTS\"\n");
  EXPECT_THAT(r.readings, SizeIs(12));
}

TEST_F(Layouts, ARowWithoutAnAngleSaysWhatToDo) {
  const std::string csv =
      "Bedding_Angle [deg],Bedding description,GS_UCS_MPA_LAB [MPa]\n10,laminated,61\n35,laminated,38\n"
      "85,laminated,72\n,massive,90\n";
  EXPECT_THAT(problems(csv, "[columns]\nBedding_Angle = \"beta\"\nGS_UCS_MPA_LAB = \"UCS\"\n"),
              ElementsAre(AllOf(HasSubstr("r.csv:5: beta"), HasSubstr("out of the table"))));
}

// 1e305 is finite, 1e305 MPa is not: a sentinel of a logger takes no other cell of its row along.
TEST_F(Layouts, ACellThatOverflowsIsReported) {
  EXPECT_THAT(problems("theta [deg],E [GPa],UCS [MPa]\n0,20,1e305\n45,21,55\n90,30,88\n"),
              ElementsAre(AllOf(HasSubstr("r.csv:2: UCS = 1e305 MPa"), HasSubstr("Leave the cell empty"))));
}

TEST_F(Layouts, RowsOfMeansAreKnownInSeveralLanguages) {
  for (const char* word : {"Average value", "Mean value", "Mittelwert", "Moyenne", "平均值", "Mean (n=3)",
                           "Mean values", "Average 0°", "Standard dev.", "Среднее", "标准差"})
    EXPECT_THAT(problems("Specimen,theta [deg],UCS [MPa]\nS1,0,100\nS2,45,60\nS3,90,120\n" +
                         std::string(word) + ",0,98\n"),
                Contains(HasSubstr("a row of specimens")))
        << word;
}

// Whole tables in layouts that are in use, values made up: what is asked, or how many values are read and the
// first UCS.
struct Outside {
  const char* file;
  const char* asked;
  std::size_t n_ucs = 0;
  double first = 0.0;
};

TEST_F(Layouts, TablesFromOutsideAreReadOrAskedAbout) {
  for (const Outside& t :
       {Outside{"direction-in-words.csv", "\"Parallel to bedding\" counts as theta = 90 deg"},
        Outside{"stress-in-psi-unknown-name.csv", "\"Peak axial stress at failure (psi)\" = "},
        Outside{"diameter-without-unit.csv", "Diameter [mm]"},
        Outside{"units-row-psi-in.csv", "\"Failure strength\", \"Est. Cohesion\""},
        Outside{"power-of-ten-in-unit.csv", "", 5, 80e6}, Outside{"full-width-brackets.csv", "", 5, 80e6},
        Outside{"kgf-cm2.csv", "", 5, 816 * 98066.5},
        Outside{"columns-by-blanks.txt", "sigma1 [MPa], sigma2 [MPa], sigma3 [MPa]"},
        Outside{"replicates-in-columns.csv", "", 15, 80e6}, Outside{"ags4-rucs.ags", "no column of angles"},
        Outside{"direct-shear-table.csv", "tau_peak: expected a rock with bedding"},
        Outside{"angle-missing-in-one-row.csv", "\"Bedding_Angle [deg]\" = \"theta\""},
        Outside{"degree-sign-latin1.csv", "byte 0xB0"},
        Outside{"chinese-headers-utf8.csv", "\"泊松比\", \"巴西劈裂强度(MPa)\""},
        Outside{"no-break-space.csv", "", 5, 80e6}, Outside{"ranges.csv", "UCS = 10-30"}}) {
    const std::string toml = "data = \"" PHY_SOURCE_DIR "/tests/outside/" + std::string(t.file) + "\"\n";
    try {
      const std::vector<double> ucs = values(read_rock(write("x.toml", toml)), Property::ucs);
      ASSERT_EQ(ucs.size(), t.n_ucs) << t.file;
      EXPECT_DOUBLE_EQ(ucs[0], t.first) << t.file;
    } catch (const InputError& e) {
      EXPECT_STRNE(t.asked, "") << t.file << ": " << e.what();
      EXPECT_THAT(e.what(), HasSubstr(t.asked)) << t.file;
    }
  }
}

}  // namespace
}  // namespace phy::rock
