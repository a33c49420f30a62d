#include "gui/imports.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/check.hpp"
#include "io/file.hpp"

namespace phy::gui {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

TEST(Imports, AWorkbookBecomesText) {
  const std::string bytes = io::read_file(PHY_SOURCE_DIR "/tests/fuzz/seeds/workbook/openpyxl.xlsx");
  const std::string text = table_from(bytes, "cores.xlsx")["table"];
  EXPECT_GT(std::count(text.begin(), text.end(), '\n'), 2) << text;
  EXPECT_THAT(text, HasSubstr(","));
}

TEST(Imports, CellsThatHoldTheSeparatorAreQuoted) {
  EXPECT_EQ(table_from("theta [deg];UCS [MPa];remark\n0;9,5;dry, whole\n", "x.csv")["table"],
            "theta [deg],UCS [MPa],remark\n0,9.5,\"dry, whole\"\n");
}

TEST(Imports, WhatIsNoTableIsRefused) {
  for (const char* none : {"", "no workbook", "PK\x03\x04 broken", "\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1"})
    EXPECT_THROW(table_from(none, "x.xlsx"), InputError) << none;
}

TEST(Imports, AMeasuredRockHasBothFiles) {
  const Json rock = rock_like("boryeong-shale");
  EXPECT_THAT(rock["table"].get<std::string>(), StartsWith("theta [deg],UCS [MPa]"));
  EXPECT_THAT(rock["toml"].get<std::string>(), HasSubstr("data = \"table.csv\""));
  EXPECT_THROW(rock_like("moon"), InputError);
}

}  // namespace
}  // namespace phy::gui
