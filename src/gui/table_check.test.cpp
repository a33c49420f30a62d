#include "gui/table_check.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace phy::gui {
namespace {

using testing::HasSubstr;

const std::string toml = "data = \"shale.csv\"\n";
const std::string good =
    "theta (deg)\tE (GPa)\tnu\tUCS (MPa)\n0\t23.2\t0.2\t105\n30\t16.6\t0.3\t67\n45\t15\t0.3\t52\n"
    "60\t21\t0.3\t50\n90\t59\t0.2\t138\n";

std::string with(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

TEST(TableCheck, AProblemNamesItsCell) {
  const Json answer = check_answer("shale", toml, with(good, "\t67", "\tabout 67"));
  ASSERT_EQ(answer["problems"].size(), 1U) << answer;
  const Json& p = answer["problems"][0];
  EXPECT_EQ(p["where"], "table");
  EXPECT_EQ(p["line"], 3);
  EXPECT_EQ(p["column"], 3);
  EXPECT_THAT(p["text"].get<std::string>(), HasSubstr("UCS = about 67"));
  EXPECT_EQ(p["text"].get<std::string>().find("shale.csv"), std::string::npos);  // the page shows where
  EXPECT_TRUE(answer["targets"].empty());
}

TEST(TableCheck, ANumberThatStandsTwiceInItsRowHasNoCell) {
  const Json answer = check_answer("shale", toml, with(good, "16.6\t0.3\t67", "-7\t0.3\t-7"));
  ASSERT_EQ(answer["problems"].size(), 2U) << answer;
  for (const Json& p : answer["problems"]) {
    EXPECT_EQ(p["line"], 3);
    EXPECT_TRUE(p["column"].is_null());
  }
}

TEST(TableCheck, ProblemsOfTheRockFileHaveItsLines) {
  const Json answer = check_answer("shale", toml + "E_is = \"guess\"\n", good);
  ASSERT_EQ(answer["problems"].size(), 1U);
  EXPECT_EQ(answer["problems"][0]["where"], "rock");
  EXPECT_EQ(answer["problems"][0]["line"], 2);
  const Json other = check_answer("shale", toml + "recipe = \"absent.toml\"\n", good);
  ASSERT_FALSE(other["problems"].empty());
  EXPECT_THAT(other["problems"][0]["text"].get<std::string>(), HasSubstr("absent.toml"));
}

TEST(TableCheck, AGoodTableIsCheckedAsByRockCheck) {
  const Json answer = check_answer("shale", toml, good);
  EXPECT_TRUE(answer["problems"].empty()) << answer["problems"];
  EXPECT_EQ(answer["targets"].size(), 15U);
  EXPECT_EQ(answer["targets"][0]["property"], "E");
  EXPECT_DOUBLE_EQ(answer["targets"][0]["mean"], 23.2e9);
  EXPECT_LT(answer["targets"][0]["low"], answer["targets"][0]["mean"]);
  const Json& panels = answer["figure"]["panels"];
  EXPECT_EQ(panels[0]["y"]["quantity"], "E");
  EXPECT_GT(panels[0]["series"][0]["x"].size(), 10U) << "theory";
  EXPECT_GT(answer["parameters"].size(), 4U);
  EXPECT_FALSE(answer["forecast"].empty());
  EXPECT_EQ(answer["course"].size(), 4U);  // efforts
  EXPECT_GT(answer["course"][3]["numbers"]["most_tests"], answer["course"][1]["numbers"]["most_tests"]);
  EXPECT_GT(answer["grains"]["number"], 0);
  EXPECT_LE(answer["summary"].size(), 10U);
  EXPECT_EQ(answer["summary"][0]["kind"], "table_angles");
}

TEST(TableCheck, DoubtsStandApartFromNotesTheAnglesFirst) {
  const std::string reversed =
      "theta (deg)\tE (GPa)\tUCS (MPa)\n0\t31\t165\n30\t27\t98\n45\t25\t112\n60\t23\t128\n90\t20\t0.15\n";
  const Json answer = check_answer("shale", toml, with(reversed, "0.15", "150"));
  ASSERT_EQ(answer["doubts"].size(), 1U) << answer["doubts"];
  EXPECT_EQ(answer["doubts"][0]["kind"], "angles_exchanged");
  EXPECT_EQ(answer["doubts"][0]["names"], Json({"E", "UCS"}));
  EXPECT_EQ(answer["doubts"][0]["cells"].size(), 10U);
  const Json small = check_answer("shale", toml, reversed);
  std::size_t about_90 = 0;
  for (const Json& doubt : small["doubts"]) {
    const Json cell = {{"property", "UCS"}, {"theta [deg]", 90.0}};
    about_90 += doubt["kind"] == "unusual_value" && doubt["cells"] == Json::array({cell}) ? 1 : 0;
    EXPECT_FALSE(doubt["text"].get<std::string>().empty());
  }
  EXPECT_EQ(about_90, 1U) << small["doubts"];
  EXPECT_TRUE(check_answer("shale", toml, good)["doubts"].empty());
}

TEST(TableCheck, ARockWithoutBeddingIsSaidToBeOne) {
  EXPECT_EQ(check_answer("shale", toml, good)["bedded"], true);
  EXPECT_EQ(check_answer("shale", toml + "bedded = false\n", "E [GPa],UCS [MPa]\n20,60\n21,65\n")["bedded"],
            false);
}

TEST(TableCheck, RubbishIsAnsweredToo) {
  for (const std::string& table :
       {std::string(), std::string("\0\0\xff", 3), std::string(5000, ','), std::string("PK\x03\x04")})
    EXPECT_FALSE(check_answer("shale", toml, table)["problems"].empty());
  for (const char* rock : {"", "data", "data = 3", "= = =", "[", "data = \"x\x01y\""})
    EXPECT_FALSE(check_answer("shale", rock, good)["problems"].empty()) << rock;
}

}  // namespace
}  // namespace phy::gui
