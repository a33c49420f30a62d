// Specimens for other programs, and their curves beside ours.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../program.hpp"

namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t n = 0;
  for (std::size_t at = text.find(what); at != text.npos; at = text.find(what, at + 1)) ++n;
  return n;
}

class Compare : public ProgramTest {};

TEST_F(Compare, OurOwnHistoryDiffersByNothingAndAScaledOneByItsScale) {
  const std::string recipe = small_recipe();
  ASSERT_EQ(run("run " + recipe + " --out " + out()), 0) << output;
  const std::string result = out() + "/intact", history = result + "/history.csv";
  ASSERT_EQ(run("compare " + history + " " + result), 0) << output;
  EXPECT_EQ(count(output, "+0.00 %"), 5U) << output;
  EXPECT_THAT(output, HasSubstr("0.00 % of our strength apart"));

  // the same curve as other people write it: MPa, per cent, compression negative, a tenth more stress
  std::ifstream in(history);
  std::string line, theirs = "Strain (%),Stress (MPa)\n";
  std::getline(in, line);
  while (std::getline(in, line)) {
    std::vector<std::string> cells;
    std::stringstream row(line);
    for (std::string cell; std::getline(row, cell, ',');) cells.push_back(cell);
    theirs += std::to_string(-100.0 * std::stod(cells[2])) + "," +
              std::to_string(-1.1e-6 * std::stod(cells[5])) + "\n";
  }
  const std::string table = write("theirs.csv", theirs);
  ASSERT_EQ(run("compare " + table + " " + result), 0) << output;
  EXPECT_THAT(output, HasSubstr("+10.00 %"));
  EXPECT_THAT(output, HasSubstr("the sign of strain and stress was turned"));
  EXPECT_THAT(output, HasSubstr("theirs: cracks were not counted"));
  if (has("gnuplot")) {
    ASSERT_EQ(run("compare " + table + " " + result + " --figure " + at("both.svg")), 0) << output;
    EXPECT_THAT(read(at("both.svg")), HasSubstr("theirs.csv"));
  }
  EXPECT_EQ(run("compare " + table + " " + out()), 2) << "three specimens";
  EXPECT_THAT(output, HasSubstr("one specimen"));
  EXPECT_EQ(run("compare " + write("bad.csv", "a,b\n1,2\n") + " " + result), 2);
  EXPECT_THAT(output, HasSubstr("axial_strain"));
  EXPECT_EQ(run("compare " + at("none.csv") + " " + result), 3);
}

TEST_F(Compare, AnExportIsWholeAndThatOfTheResult) {
  const std::string recipe = small_recipe();
  ASSERT_EQ(run("specimen " + recipe + " --out " + at("tables")), 0) << output;
  ASSERT_EQ(run("run " + recipe + " --out " + out()), 0) << output;
  ASSERT_EQ(run("export pfc2d " + out() + "/theta_45_deg --out " + at("one")), 0) << output;
  EXPECT_FALSE(fs::exists(at("one") + "/intact-test.p2dat")) << "one specimen was asked for";
  ASSERT_EQ(run("export pfc2d " + recipe + " --out " + at("all")), 0) << output;
  EXPECT_THAT(output, Not(HasSubstr("without a licence")));
  for (const char* name : {"theta_45_deg", "theta_60_deg", "intact"}) {
    const std::string text = read(at("all") + "/" + name + "-specimen.p2dat");
    const std::string contacts = read(at("tables") + "/contacts_" + name + ".csv");
    EXPECT_EQ(count(text, "\nball create"), 330U);
    EXPECT_EQ(count(text, "\n[bond("), count(contacts, ",bonded,")) << name;
    EXPECT_EQ(count(text, "\n[joint("), count(contacts, ",joint,")) << name;
    EXPECT_THAT(read(at("all") + "/" + name + "-test.p2dat"),
                HasSubstr(std::string("'") + name + "-pfc.csv'"));
  }
  EXPECT_EQ(read(at("one") + "/theta_45_deg-specimen.p2dat"),
            read(at("all") + "/theta_45_deg-specimen.p2dat"));
  const std::string large =
      write("large.toml", "[specimen]\nwidth = \"14 mm\"\nheight = \"28 mm\"\n[packing]\nn_grains = 1010\n");
  ASSERT_EQ(run("export pfc2d " + large + " --out " + at("large")), 0) << output;
  EXPECT_THAT(output, HasSubstr("without a licence"));
  EXPECT_EQ(run("export pfc2d " + write("flat.toml", "[matrix]\nmodel = \"flat_joint\"\n") + " --out " +
                at("flat")),
            2);
  EXPECT_FALSE(fs::exists(at("flat")));
}

}  // namespace
