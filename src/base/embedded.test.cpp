// Is the text in the program the file?
#include "base/embedded.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "base/check.hpp"

namespace phy {
namespace {

TEST(Embedded, IsTheFile) {
  for (const std::string path :
       {"web/report.html", "web/gui.html", "tests/recorded.txt", "data/maps/flat-joint.csv",
        "data/maps/parallel-bond-bridges-crossing.csv"}) {
    std::ifstream file(std::string(PHY_SOURCE_DIR "/") + path, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    ASSERT_FALSE(text.empty()) << path;
    EXPECT_TRUE(embedded(path) == text) << path;
  }
}

TEST(Embedded, ListsWhatIsBelowAFolder) {
  const auto below = embedded_below("data/maps/");
  EXPECT_TRUE(std::ranges::find(below, "data/maps/flat-joint.csv") != below.end());
  EXPECT_TRUE(std::ranges::is_sorted(below));
  EXPECT_TRUE(embedded_below("data/nothing/").empty());
}

TEST(Embedded, IsNoFileThatWasNotTakenIn) {
  EXPECT_THROW(embedded("README.md"), InternalError);
  EXPECT_THROW(embedded("web/report"), InternalError);
}

}  // namespace
}  // namespace phy
