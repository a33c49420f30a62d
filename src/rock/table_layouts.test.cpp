// Layouts of tables that laboratories, instruments and other programs write.
#include "io/table.hpp"

#include "io/ags.hpp"
#include "io/table_cells.hpp"
#include "io/table_layout.hpp"
#include "rock/file_fixture.hpp"

namespace phy::rock {
namespace {

using io::is_ags;
using io::parse_table;
using io::plain_cell;
using io::Table;

Table table_of(const std::string& text, const std::string& sheet = "") {
  return parse_table(text, "t.csv", sheet);
}
std::vector<std::string> told(const Table& table) {
  std::vector<std::string> lines;
  for (const Problem& p : table.problems) lines.push_back(to_line(p));
  return lines;
}

TEST(TableText, BlanksPartColumns) {
  const Table t = table_of(
      "sigma1    sigma2    sigma3\n101.0     0          0\n113.9     0          0\n241.3     20         20\n"
      "284       30         30\n");
  EXPECT_THAT(t.problems, IsEmpty());
  EXPECT_THAT(t.header, ElementsAre("sigma1", "sigma2", "sigma3"));
  ASSERT_THAT(t.rows, SizeIs(4));
  EXPECT_THAT(t.rows[2].cells, ElementsAre("241.3", "20", "20"));
  EXPECT_THAT(t.notes, Contains("cells are separated by blanks"));
}

TEST(TableText, NamesMayHoldSingleBlanksBetweenRunsOfThem) {
  for (const char* rows : {"101.0     0\n113.9     10\n", "101.0 0\n113.9 10\n", "101.0     0\n113.9 10\n"}) {
    const Table t = table_of(std::string("sigma 1 (MPa)   sigma 3 (MPa)\n") + rows);
    EXPECT_THAT(t.problems, IsEmpty()) << rows;
    EXPECT_THAT(t.header, ElementsAre("sigma 1 (MPa)", "sigma 3 (MPa)"));
    ASSERT_THAT(t.rows, SizeIs(2));
    EXPECT_THAT(t.rows[1].cells, ElementsAre("113.9", "10"));
  }
  EXPECT_THAT(table_of("  sigma1 sigma3\n   101,5 0\n   113,9 10\n").rows[0].cells,
              ElementsAre("101.5", "0"));
  EXPECT_THAT(table_of("sigma1 (MPa) sigma3 [MPa, cell]\n101.5 0\n113.9 10\n").header,
              ElementsAre("sigma1 (MPa)", "sigma3 [MPa, cell]"));
  const Table quoted =
      table_of("PFC 7.00\n\"Step\"  \"1 Stress [Pa]\"\n  10    1.0e6\n  20    2.0e6\n  30    2.5e6\n");
  EXPECT_THAT(quoted.header, ElementsAre("Step", "1 Stress [Pa]"));
  EXPECT_EQ(quoted.header_line, 2);
}

TEST(TableText, WhereBlanksLeaveDoubtTheMessageSaysSo) {
  EXPECT_THAT(told(table_of("sigma1 sigma3 mode\n101 0 shear\n113 0 axial splitting\n")),
              ElementsAre(HasSubstr("separated by blanks: use commas, semicolons or tabs")));
  EXPECT_THAT(
      told(table_of("s1   s2   s3\n1   2   3\n4   5   6\n7   8   9\n10      30\n")),
      ElementsAre(AllOf(HasSubstr("t.csv:5: 2 cells: expected 3 cells"), HasSubstr("separated by blanks"))));
  EXPECT_THAT(told(table_of("theta,UCS\n0 80\n30 55\n")),
              ElementsAre(AllOf(HasSubstr("1 cell: expected 2 cells"), HasSubstr("separated by blanks"))));
  EXPECT_THAT(table_of("UCS [MPa]\n105\n110\n").problems, IsEmpty())
      << "a single column has a name with a blank";
}

TEST(TableText, TheHeaderIsTheFirstRowOfNamesThatReachesAsFarAsTheRows) {
  const Table t = table_of(
      "Specimen,U-2\nDiameter,20,mm\nHeight,40,mm\n\nTime,Axial load,Axial strain 1,Axial strain 2\n"
      "s,kN,mm/mm,mm/mm\n0,0,0,0\n1,0.4,0.1,0.2\n2,0.9,0.2,0.3\n");
  EXPECT_EQ(t.header_line, 5);
  EXPECT_THAT(t.header, ElementsAre("Time", "Axial load", "Axial strain 1", "Axial strain 2"));
  ASSERT_THAT(t.rows, SizeIs(4));
  EXPECT_EQ(t.rows[0].line, 6);
  EXPECT_THAT(t.notes, Contains("lines 1 to 3, above the header, are passed over"));
  // As wide as the table, padded by a spreadsheet, with a delimiter of another kind.
  EXPECT_EQ(
      table_of("Specimen,U-2,slate\nDiameter,20,mm\nstrain,stress,cracks\n0,0,0\n1,1,0\n2,2,1\n").header_line,
      3);
  EXPECT_EQ(table_of("Results of May,,\ntheta,UCS,E\n0,80,20\n30,55,21\n").header_line, 2);
  EXPECT_EQ(table_of("Slate, dry\ntheta;UCS\n0;80,5\n30;55,2\n").header_line, 2);
  EXPECT_THAT(table_of("Slate, dry\ntheta;UCS\n0;80,5\n30;55,2\n").problems, IsEmpty());
}

TEST(TableText, NoRowWithValuesIsPassedOver) {
  const Table two = table_of("theta,UCS\n0,80\n30,55\n\ntheta,BTS\n0,8\n30,5\n45,4\n60,3\n");
  EXPECT_EQ(two.header_line, 1);
  EXPECT_THAT(two.rows, SizeIs(7));
  for (const char* text :
       {"0,80\n30,55\nnone,none\n45,42\n", "# theta UCS\n0 80\n30 55\n", "# UCS\n80\n55\n"})
    EXPECT_THAT(told(table_of(text)), ElementsAre(HasSubstr("expected a line of names above the first row")))
        << text;
  EXPECT_THAT(table_of("theta,0.001,0.01\n0,20,21\n45,18,19\n").header,
              ElementsAre("theta", "0.001", "0.01"));
  const Table sparse = table_of("theta,E,UCS,BTS\n0,23,,\n0,,105,\n0,,,8\n45,20,,\n");
  EXPECT_EQ(sparse.header_line, 1);
  EXPECT_THAT(sparse.rows, SizeIs(4));
}

TEST(TableText, TwoRowsAreOneHeader) {
  const Table t = table_of(
      "theta (deg),UCS (MPa),,,,E (GPa)\n,S1,S2,S3,Mean,\n0,80,84,77,80.3,20\n30,55,51,58,54.7,21\n");
  EXPECT_THAT(t.problems, IsEmpty());
  EXPECT_THAT(t.header, ElementsAre("theta (deg)", "UCS S1 (MPa)", "UCS S2 (MPa)", "UCS S3 (MPa)",
                                    "UCS Mean (MPa)", "E (GPa)"));
  EXPECT_EQ(t.header_line, 1);
  ASSERT_THAT(t.rows, SizeIs(2));
  EXPECT_EQ(t.rows[0].line, 3);
  EXPECT_THAT(t.notes, Contains(HasSubstr("the header has two rows, lines 1 and 2")));
  // The last names stand below a gap; a title above; a unit of its own; nothing above the first name.
  EXPECT_THAT(table_of("Table 3,,\ntheta (deg),UCS (MPa),\n,S1,S2\n0,80,84\n30,55,51\n").header,
              ElementsAre("theta (deg)", "UCS S1 (MPa)", "UCS S2 (MPa)"));
  EXPECT_THAT(table_of(",UCS,,E,\ntheta,dry (MPa),wet (MPa),dry,wet\n0,80,84,20,21\n30,55,51,20,21\n").header,
              ElementsAre("theta", "UCS dry (MPa)", "UCS wet (MPa)", "E dry", "E wet"));
}

TEST(TableText, AnUpperNameMayBeRepeatedOverItsColumns) {
  const Table t =
      table_of("theta,UCS,UCS,UCS,E\n,A,B,C,\ndeg,MPa,MPa,MPa,GPa\n0,80,84,77,20\n30,55,51,58,21\n");
  EXPECT_THAT(t.header, ElementsAre("theta", "UCS A", "UCS B", "UCS C", "E"));
  ASSERT_THAT(t.rows, SizeIs(3));
  EXPECT_THAT(t.rows[0].cells, ElementsAre("deg", "MPa", "MPa", "MPa", "GPa"));
  EXPECT_THAT(table_of("theta,UCS,UCS\ndeg,MPa,MPa\n0,80,84\n30,55,51\n").header,
              ElementsAre("theta", "UCS", "UCS"));
}

TEST(TableText, WhatIsNoSecondHeaderIsLeft) {
  // Units, specimens, lines about the test.
  const Table units = table_of("theta,UCS,,BTS\ndeg,MPa,MPa,MPa\n0,80,3,8\n30,55,2,7\n");
  EXPECT_THAT(units.header, ElementsAre("theta", "UCS", "", "BTS"));
  EXPECT_THAT(units.rows, SizeIs(3));
  EXPECT_THAT(table_of("theta,UCS,,BTS\n0,80,x,8\n30,55,y,7\n").header,
              ElementsAre("theta", "UCS", "", "BTS"));
  EXPECT_THAT(table_of("Specimen,U-2,,\nTime,Load,Strain 1,Strain 2\n0,1,2,3\n1,2,3,4\n").header,
              ElementsAre("Time", "Load", "Strain 1", "Strain 2"));
}

TEST(TableText, BlanksAndDashesOfTypesettersAreNoneOfTheValue) {
  const Table t = table_of(
      "\xC2\xA0theta\xC2\xA0(deg),UCS\xEF\xBC\x88MPa\xEF\xBC\x89,"
      "E\xEF\xBC\x9A\xEF\xBC\xA7\xEF\xBC\xB0\xEF\xBC\xA1\n"
      "0,80\xC2\xA0,\xE2\x80\x93\n30,\xE2\x80\xAF\x35\x35,\xE2\x80\x94\n45,\xE3\x80\x80\x34\x32,"
      "\xE2\x88\x92\n"
      "60,\xE2\x88\x92\x33\x38,\xE2\x80\x89-\n");
  EXPECT_THAT(t.header, ElementsAre("theta (deg)", "UCS(MPa)", "E:GPA"));
  ASSERT_THAT(t.rows, SizeIs(4));
  EXPECT_THAT(t.rows[0].cells, ElementsAre("0", "80", "-"));
  EXPECT_THAT(t.rows[1].cells, ElementsAre("30", "55", "-"));
  EXPECT_THAT(t.rows[2].cells, ElementsAre("45", "42", "-"));
  EXPECT_THAT(t.rows[3].cells, ElementsAre("60", "-38", "-"));
  EXPECT_EQ(plain_cell("10\xE2\x80\x93"
                       "30"),
            "10\xE2\x80\x93"
            "30")
      << "a range stays one";
}

TEST(TableText, CellsMayHoldLineBreaks) {
  const Table t = table_of(
      "theta,\"UCS\r\n(MPa)\",\"mode\n of failure\"\r\n0,80,\"along\r\nbedding\"\r\n30,55,split\r\n");
  EXPECT_THAT(t.problems, IsEmpty());
  EXPECT_THAT(t.header, ElementsAre("theta", "UCS (MPa)", "mode  of failure"));
  ASSERT_THAT(t.rows, SizeIs(2));
  EXPECT_EQ(t.rows[0].line, 4);
  EXPECT_EQ(t.rows[1].line, 6);
  EXPECT_THAT(t.notes, Contains("line 1: a cell goes over several lines"));
  // Inches are no quotes, and quotes that nothing closes join no lines.
  EXPECT_THAT(table_of("core,UCS\n2.5\" dry,80\n2.5\" wet,70\n").problems, SizeIs(1));
  EXPECT_THAT(told(table_of("core,UCS\na,80\n\"b,70\nc,60\n")),
              ElementsAre(HasSubstr("t.csv:3 = \"b,70: expected closed")));
}

TEST(TableText, ADelimiterAtTheEndOfALineMakesNoCell) {
  const Table t = table_of("theta,UCS\n0,80,\n30,55,\n");
  EXPECT_THAT(t.problems, IsEmpty());
  EXPECT_THAT(t.rows[1].cells, ElementsAre("30", "55"));
  const Table head = table_of("theta;UCS;\n0;80\n30;55\n");
  EXPECT_THAT(head.problems, IsEmpty());
  EXPECT_THAT(head.rows[1].cells, ElementsAre("30", "55", ""));
  EXPECT_THAT(told(table_of("theta,UCS,E\n0,80\n30,55\n")), Contains(HasSubstr("2 cells: expected 3 cells")));
}

TEST(TableText, OneProblemOfManyLinesIsToldOnce) {
  std::string text = "theta [deg],UCS [MPa]\n";
  for (int i = 0; i < 50; ++i) text += "0,80,5\n";
  EXPECT_THAT(told(table_of(text)), ElementsAre(AllOf(HasSubstr("t.csv:2: 3 cells: expected 2 cells"),
                                                      HasSubstr("decimal commas need semicolons"),
                                                      HasSubstr("and 49 more lines"))));
}

TEST(TableText, TheByteThatIsNoUtf8IsNamed) {
  EXPECT_THAT(told(table_of("theta (\xB0);UCS (MPa)\n0;80,5\n30;55,2\n")),
              ElementsAre(AllOf(HasSubstr("t.csv:1: byte 0xB0, \"°\" in Latin-1"), HasSubstr("CSV UTF-8"))));
  EXPECT_THAT(told(table_of("theta,remark\n0,caf\xE9\n30,ok\n")),
              ElementsAre(HasSubstr("t.csv:2: byte 0xE9, \"é\"")));
}

TEST(TableText, WidthAndLengthHaveLimits) {
  std::string header = "E [GPa]", row = "1";
  for (int i = 1; i < 1000; ++i) header += ",E [GPa]", row += ",1";
  const Table wide = table_of(header + "\n" + row + "\n" + row + "\n");
  EXPECT_THAT(told(wide), ElementsAre(AllOf(HasSubstr("t.csv:1: 1000 columns"), HasSubstr("at most 256"))));
  EXPECT_EQ(wide.header_line, 0) << "nobody goes on with it";
  std::string line;
  for (int i = 0; i < 2000000; ++i) line += "1,";
  EXPECT_THAT(told(table_of(line)), ElementsAre(HasSubstr("t.csv:1: 4000000 characters")));
  EXPECT_THAT(told(table_of("a,b\n1,2\n" + std::string(100000, 'a') + "\n")),
              ElementsAre(HasSubstr("t.csv:3")));
}

TEST(TableText, MessagesCutWhatIsLong) {
  std::string name;
  for (int i = 0; i < 1000; ++i) name += "°";
  const std::string line = to_line({"t.csv:1", name, name, "less", ""});
  EXPECT_LT(line.size(), 500U);
  EXPECT_THAT(line, HasSubstr("°..."));
  EXPECT_THAT(line, Not(HasSubstr("\xC2...")));
}

const std::string ags =
    "\"GROUP\",\"PROJ\"\r\n\"HEADING\",\"PROJ_ID\",\"PROJ_NAME\"\r\n\"UNIT\",\"\",\"\"\r\n\"TYPE\",\"ID\","
    "\"X\"\r\n"
    "\"DATA\",\"P1\",\"demo, \"\"north\"\"\"\r\n\r\n\"GROUP\",\"RUCS\"\r\n"
    "\"HEADING\",\"LOCA_ID\",\"RUCS_SDIA\",\"RUCS_UCS\",\"RUCS_E\",\"RUCS_MU\"\r\n"
    "\"UNIT\",\"\",\"mm\",\"MPa\",\"GPa\",\"\"\r\n\"TYPE\",\"ID\",\"1DP\",\"3SF\",\"3SF\",\"2DP\"\r\n"
    "\"DATA\",\"BH1\",\"54.0\",\"81.2\",\"21.5\",\"0.24\"\r\n\"DATA\",\"BH2\",\"54.1\",\"<5.0\",\"\","
    "\"\"\r\n";

TEST(AgsFile, AGroupIsATable) {
  const Table t = table_of(ags);
  EXPECT_THAT(t.problems, IsEmpty());
  EXPECT_EQ(t.where, "t.csv [RUCS]");
  EXPECT_EQ(t.header_line, 8);
  EXPECT_THAT(t.header,
              ElementsAre("LOCA_ID", "RUCS_SDIA [mm]", "RUCS_UCS [MPa]", "RUCS_E [GPa]", "RUCS_MU"));
  ASSERT_THAT(t.rows, SizeIs(2));
  EXPECT_EQ(t.rows[0].line, 11);
  EXPECT_THAT(t.rows[0].cells, ElementsAre("BH1", "54.0", "81.2", "21.5", "0.24"));
  EXPECT_THAT(t.rows[1].cells, ElementsAre("BH2", "54.1", "<5.0", "", ""));
  EXPECT_THAT(t.notes, Contains("an AGS file: its group RUCS is read; other groups: PROJ"));
  EXPECT_THAT(table_of(ags, "PROJ").rows[0].cells, ElementsAre("P1", "demo, \"north\""));
}

TEST(AgsFile, WhatCannotBeReadIsToldInItsWords) {
  EXPECT_THAT(told(table_of(ags, "RPLT")),
              ElementsAre(AllOf(HasSubstr("no group RPLT"), HasSubstr("the file has PROJ, RUCS"))));
  EXPECT_THAT(told(table_of("\"**PROJ\"\n\"*PROJ_ID\"\n\"P1\"\n")), ElementsAre(HasSubstr("an AGS 3 file")));
  EXPECT_THAT(
      told(table_of("\"GROUP\",\"RUCS\"\n\"HEADING\",\"A\",\"B\"\n\"UNIT\",\"\",\"\"\n\"TYPE\",\"X\",\"X\"\n"
                    "\"DATA\",\"1\"\n\"DATA\",\"1\",\"2\",\"3\"\n\"DATUM\",\"1\",\"2\"\n")),
      ElementsAre(AllOf(HasSubstr("t.csv [RUCS]:5: 1 items: expected 2"), HasSubstr("and 1 more line")),
                  HasSubstr("t.csv [RUCS]:7: DATUM")));
  EXPECT_TRUE(is_ags("GROUP,RUCS,,\nHEADING,RUCS_UCS,RUCS_E,\n")) << "as spreadsheets save it";
  EXPECT_FALSE(is_ags("GROUP,UCS\nA,80\n")) << "a table whose first column is called so";
}

TEST_F(RockFile, OtherLayoutsAreRocks) {
  EXPECT_THAT(
      rock("theta [deg]   UCS [MPa]\n0             100\n45            60\n90            120\n").readings,
      SizeIs(3));
  EXPECT_THAT(
      rock("Slate of the north\nSampled in May; by N.N.\n\ntheta [deg],UCS [MPa]\n0,100\n45,60\n90,120\n")
          .readings,
      SizeIs(3));
  const Rock spaced =
      rock("theta [deg],UCS [MPa],BTS [MPa]\n0,100\xC2\xA0,8\n45,60,\xE2\x80\x93\n90,120,6\n");
  EXPECT_THAT(spaced.readings, SizeIs(5));
}

}  // namespace
}  // namespace phy::rock
