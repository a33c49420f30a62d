// Workbooks: those that other programs wrote (tests/fuzz/seeds/workbook), and parts put together here.
#include "io/workbook.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zip.h>

#include <map>

#include "base/in_folder_fixture.hpp"
#include "io/file.hpp"
#include "io/table.hpp"

namespace phy::io {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

/// The files of an archive, by name.
using Parts = std::map<std::string, std::string>;

class Workbook : public InFolder {
 protected:
  /// The bytes of an archive of these files.
  std::string archive(const Parts& parts) const {
    const std::string path = at("made.xlsx");
    zip_t* zip = zip_open(path.c_str(), ZIP_CREATE | ZIP_TRUNCATE, nullptr);
    for (const auto& [name, text] : parts)
      zip_file_add(zip, name.c_str(), zip_source_buffer(zip, text.data(), text.size(), 0), ZIP_FL_OVERWRITE);
    EXPECT_EQ(zip_close(zip), 0);
    return read_file(path);
  }
  /// One sheet "S" with this content of its root element, beside further files.
  Table sheet(const std::string& content, Parts parts = {}) const {
    parts["xl/workbook.xml"] =
        R"(<workbook><sheets><sheet name="S" sheetId="1" r:id="rId1"/></sheets></workbook>)";
    parts["xl/_rels/workbook.xml.rels"] =
        R"(<Relationships><Relationship Id="rId1" Target="worksheets/sheet1.xml"/></Relationships>)";
    parts["xl/worksheets/sheet1.xml"] = "<worksheet>" + content + "</worksheet>";
    return parse_workbook(archive(parts), "", "t.xlsx");
  }
};

/// Inline texts and numbers of one row: "UCS|105|".
std::string row(int number, const std::string& cells, const std::string& more = "") {
  std::string xml = "<row r=\"" + std::to_string(number) + "\"" + more + ">", cell;
  for (const char c : cells + "|")
    if (c != '|')
      cell += c;
    else if (const bool text = cell.find_first_not_of("0123456789.") != cell.npos || cell.empty(); true)
      xml += (text ? "<c t=\"inlineStr\"><is><t>" + cell + "</t></is></c>" : "<c><v>" + cell + "</v></c>"),
          cell.clear();
  return xml + "</row>";
}
std::vector<std::string> lines(const std::vector<Problem>& problems) {
  std::vector<std::string> all;
  for (const Problem& p : problems) all.push_back(to_line(p));
  return all;
}

Table seed(const std::string& name, const std::string& sheet = "") {
  return parse_workbook(read_file(PHY_SOURCE_DIR "/tests/fuzz/seeds/workbook/" + name), sheet, name);
}

TEST(WorkbookOfOtherPrograms, OfOpenpyxlWithATitleAndMergedAngles) {
  const Table t = seed("openpyxl.xlsx");
  EXPECT_THAT(t.problems, IsEmpty());
  EXPECT_EQ(t.where, "openpyxl.xlsx [Results]");
  EXPECT_EQ(t.header_line, 3);
  EXPECT_THAT(t.header, ElementsAre("Sample", "β (°)", "E50 (GPa)", "ν", "σc (MPa)", "σt, MPa",
                                    "Density (g/cm³)", "Remark"));
  ASSERT_THAT(t.rows, SizeIs(7));  // with the remark below an empty row
  EXPECT_EQ(t.rows[1].line, 5);
  EXPECT_THAT(t.rows[1].merged, ElementsAre(1U));
  EXPECT_THAT(t.rows[0].merged, IsEmpty());
  EXPECT_THAT(t.rows[1].cells, ElementsAre("A2", "0", "55.1", "0.22", "117", "", "2.7", ""));
  EXPECT_EQ(t.rows[3].cells[1], "30");
  EXPECT_THAT(t.notes, Contains("the first of its sheets is read: Results; other sheets: Raw"));
  EXPECT_THAT(t.notes, Contains("what stands above row 3 is passed over"));
  EXPECT_EQ(t.rows[6].line, 11);
}

TEST(WorkbookOfOtherPrograms, OfXlsxwriterWithFormulaDayAndCommaInText) {
  const Table t = seed("xlsxwriter.xlsx");
  EXPECT_THAT(t.problems, IsEmpty());
  ASSERT_THAT(t.rows, SizeIs(4));
  EXPECT_THAT(t.header,
              ElementsAre("dip", "Young's modulus", "UCS", "SD UCS", "number of tests", "", "remarks"));
  EXPECT_THAT(t.rows[1].cells, ElementsAre("0", "23", "105.5", "5", "3", "", ""));
  EXPECT_THAT(t.rows[2].cells, ElementsAre("45", "20.1", "53", "4.25", "3", "", "2026-05-01"));
  EXPECT_THAT(t.notes, Contains("1 hidden row(s) are read too: 4"));
  EXPECT_THAT(t.notes, Contains("1 number(s) are text with a decimal comma: read as numbers"));
}

TEST(WorkbookOfOtherPrograms, ASheetIsNamedOrToldWithTheOthers) {
  EXPECT_THAT(lines(seed("openpyxl.xlsx", "Raw").problems), Contains(HasSubstr("the sheet is empty")));
  EXPECT_THAT(lines(seed("openpyxl.xlsx", "UCS").problems),
              Contains(AllOf(HasSubstr("no sheet \"UCS\""), HasSubstr("it has: Results, Raw"))));
}

TEST_F(Workbook, NumbersAreThoseThatWereTyped) {
  const Table t = sheet("<sheetData>" + row(1, "a|b") +
                        R"(<row><c><v>45.200000000000003</v></c><c t="b"><v>1</v></c></row></sheetData>)");
  ASSERT_THAT(t.rows, SizeIs(1));
  EXPECT_EQ(t.rows[0].line, 2);
  EXPECT_THAT(t.rows[0].cells, ElementsAre("45.2", "TRUE"));
}

TEST_F(Workbook, AFormulaWithoutItsValueIsNoEmptyCell) {
  const Table t =
      sheet("<sheetData>" + row(1, "a|b|c") +
            "<row><c><f>2*3</f><v>6</v></c><c><f>2*3</f></c><c><f>2*3</f><v></v></c></row></sheetData>");
  ASSERT_THAT(t.rows, SizeIs(1));
  EXPECT_THAT(t.rows[0].cells, ElementsAre("6", "a formula", "a formula"));
}

TEST_F(Workbook, TextsThatMayBeThousandsAreLeft) {
  const Table t = sheet("<sheetData>" + row(1, "a|b") + row(2, "45,000|1,5") + "</sheetData>");
  EXPECT_THAT(t.rows[0].cells, ElementsAre("45,000", "1.5"));
}

TEST_F(Workbook, HoursAreNoNumbersAndHiddenSheetsAndColumnsAreSeen) {
  Parts parts;
  parts["xl/styles.xml"] =
      R"(<styleSheet><cellXfs><xf numFmtId="0"/><xf numFmtId="20"/></cellXfs></styleSheet>)";
  const Table t = sheet("<cols><col min=\"2\" max=\"2\" hidden=\"1\"/></cols><sheetData>" + row(1, "a|b") +
                            R"(<row><c s="1"><v>0.0625</v></c><c><v>1</v></c></row></sheetData>)",
                        parts);
  EXPECT_EQ(t.rows[0].cells[0], "1899-12-30");
  EXPECT_THAT(t.notes, Contains("hidden columns are read too"));
}

TEST_F(Workbook, SharedTextsInRunsAndNamesWithPrefixes) {
  Parts parts;
  parts["xl/sharedStrings.xml"] = "<sst><si><r><t>U</t></r><r><t>CS</t></r></si><si><t>E</t></si></sst>";
  parts["xl/worksheets/sheet1.xml"] =
      R"(<x:worksheet><x:sheetData>
           <x:row r="2"><x:c r="B2" t="s"><x:v>0</x:v></x:c><x:c r="D2" t="s"><x:v>1</x:v></x:c></x:row>
           <x:row r="3"><x:c r="B3"><x:v>7</x:v></x:c><x:c r="C3" t="s"><x:v>9</x:v></x:c></x:row>
         </x:sheetData></x:worksheet>)";
  parts["xl/workbook.xml"] = R"(<workbook><sheets><sheet name="S" r:id="rId7"/></sheets></workbook>)";
  parts["xl/_rels/workbook.xml.rels"] =
      R"(<Relationships><Relationship Id="rId7" Target="/xl/worksheets/sheet1.xml"/></Relationships>)";
  const Table t = parse_workbook(archive(parts), "S", "t.xlsx");
  EXPECT_THAT(t.problems, IsEmpty());
  EXPECT_THAT(t.header, ElementsAre("UCS", "", "E"));
  ASSERT_THAT(t.rows, SizeIs(1));
  EXPECT_THAT(t.rows[0].cells, ElementsAre("7", "", ""));
}

TEST_F(Workbook, WhatStandsBesideTheTableIsTold) {
  const Table t = sheet("<sheetData>" + row(1, "a|b") + row(2, "1|2|mean of three") + "</sheetData>");
  EXPECT_THAT(t.notes, Contains("1 cell(s) beside the table are passed over"));
  ASSERT_THAT(t.rows, SizeIs(1));
  EXPECT_THAT(t.rows[0].cells, ElementsAre("1", "2"));
}

TEST_F(Workbook, WhatIsNoneIsRefused) {
  EXPECT_THAT(lines(sheet("").problems), Contains(HasSubstr("the sheet is empty")));
  EXPECT_THAT(lines(sheet("<sheetData>" + row(1, "a") + row(2, "1") + "</sheetData>").problems),
              Contains(HasSubstr("no row has two cells")));
  EXPECT_THAT(lines(sheet("<sheetData>" + row(1, "a|b") + "</sheetData>").problems),
              Contains(HasSubstr("at least one row below the header")));
  EXPECT_THAT(lines(parse_workbook(archive({{"content.xml", "<a/>"}}), "", "t.ods").problems),
              Contains(HasSubstr("OpenDocument")));
  EXPECT_THAT(lines(parse_workbook(archive({{"word/document.xml", "<a/>"}}), "", "t.docx").problems),
              Contains(HasSubstr("no workbook")));
  const std::string whole = archive({{"xl/workbook.xml", "<workbook/>"}});
  EXPECT_THAT(parse_workbook(whole.substr(0, whole.size() / 2), "", "half.xlsx").problems, SizeIs(1));
  EXPECT_THAT(lines(parse_table("\xD0\xCF\x11\xE0 and so on", "old.xls").problems),
              Contains(HasSubstr("before 2007")));
  EXPECT_THAT(lines(parse_table("a,b\n1,2\n", "t.csv", "Raw").problems),
              Contains(HasSubstr("leave sheet out")));
}

TEST_F(Workbook, AStrayCellFarToTheRightIsTold) {
  const Table t =
      sheet("<sheetData><row r=\"1\"><c r=\"A1\"><v>1</v></c><c r=\"XFD1\"><v>1</v></c></row></sheetData>");
  EXPECT_THAT(lines(t.problems), Contains(HasSubstr("headers from column A to XFD")));
}

/// Two sheets with these contents of their root elements.
Parts two_sheets(const std::string& first, const std::string& second) {
  Parts parts;
  parts["xl/workbook.xml"] = R"(<workbook><sheets><sheet name="Notes" r:id="r1"/>
                                <sheet name="Results" r:id="r2"/></sheets></workbook>)";
  parts["xl/_rels/workbook.xml.rels"] = R"(<Relationships><Relationship Id="r1" Target="a.xml"/>
                                           <Relationship Id="r2" Target="b.xml"/></Relationships>)";
  parts["xl/a.xml"] = "<worksheet><sheetData>" + first + "</sheetData></worksheet>";
  parts["xl/b.xml"] = "<worksheet><sheetData>" + second + "</sheetData></worksheet>";
  return parts;
}

TEST_F(Workbook, AFirstSheetWithoutATableNamesTheOneThatHasOne) {
  const std::string table = row(1, "theta|UCS") + row(2, "0|80") + row(3, "30|55");
  for (const std::string& notes :
       {row(1, "Slate of the north"), std::string(), row(1, "Project|slate") + row(2, "Sampled|in May")}) {
    const Table t = parse_workbook(archive(two_sheets(notes, table)), "", "t.xlsx");
    EXPECT_THAT(lines(t.problems),
                ElementsAre(testing::AllOf(HasSubstr("t.xlsx: the sheet Notes has no table"),
                                           HasSubstr("Other sheets: Results."),
                                           HasSubstr("Write sheet = \"Results\""))));
    EXPECT_EQ(t.header_line, 0);
  }
  const std::string whole = archive(two_sheets(table, row(1, "later")));
  EXPECT_THAT(parse_workbook(whole, "", "t.xlsx").problems, IsEmpty());
  EXPECT_THAT(parse_workbook(whole, "", "t.xlsx").notes,
              Contains("the first of its sheets is read: Notes; other sheets: Results"));
  EXPECT_THAT(lines(parse_workbook(archive(two_sheets(row(1, "a"), row(1, "b"))), "", "t.xlsx").problems),
              ElementsAre(HasSubstr("no row has two cells")))
      << "advice that does not help is none";
}

TEST_F(Workbook, LinesAboveAndHeadersInTwoRowsAreAsInText) {
  const Table t = sheet("<sheetData>" + row(1, "Specimen|U-2") + row(2, "Diameter|20|mm") +
                        row(4, "theta (deg)|UCS (MPa)||||E (GPa)") + row(5, "|S1|S2|S3|Mean|") +
                        row(6, "0|80|84|77|80.3|20") + row(7, "30|55|51|58|54.7|21") +
                        "</sheetData><mergeCells><mergeCell ref=\"B4:E4\"/><mergeCell ref=\"A4:A5\"/>"
                        "<mergeCell ref=\"F4:F5\"/></mergeCells>");
  EXPECT_THAT(t.problems, IsEmpty());
  EXPECT_EQ(t.header_line, 4);
  EXPECT_THAT(t.header, ElementsAre("theta (deg)", "UCS S1 (MPa)", "UCS S2 (MPa)", "UCS S3 (MPa)",
                                    "UCS Mean (MPa)", "E (GPa)"));
  ASSERT_THAT(t.rows, SizeIs(2));
  EXPECT_THAT(t.rows[0].cells, ElementsAre("0", "80", "84", "77", "80.3", "20"));
  EXPECT_THAT(t.notes, Contains(HasSubstr("the header has two rows, 4 and 5")));
}

TEST_F(Workbook, BlanksOfTypesettersAreNoneOfTheCell) {
  const Table t = sheet("<sheetData>" + row(1, "theta|UCS\xEF\xBC\x88MPa\xEF\xBC\x89") +
                        row(2, "0|80\xC2\xA0") + row(3, "30|\xE2\x80\x94") + "</sheetData>");
  EXPECT_THAT(t.header, ElementsAre("theta", "UCS(MPa)"));
  EXPECT_EQ(t.rows[0].cells[1], "80");
  EXPECT_EQ(t.rows[1].cells[1], "-");
}

TEST_F(Workbook, AFileThatUnpacksToGigabytesIsNotUnpacked) {
  Parts parts;
  const std::string blanks(65U << 20U, ' ');
  const Table t = sheet("<sheetData>" + row(1, "a|b") + row(2, "1|2") + blanks + "</sheetData>");
  EXPECT_THAT(lines(t.problems), Contains(HasSubstr("larger than 64 MB")));
}

}  // namespace
}  // namespace phy::io
