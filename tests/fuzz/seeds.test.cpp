// Does every reader hold to its contract (readers.hpp) on its seeds: real files cut small, and every input
// that once broke one ("bad-...", which may be refused)?
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "readers.hpp"

namespace phy::fuzz {
namespace {

namespace fs = std::filesystem;

std::string read_file(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

fs::path folder_of(const std::string& reader) {
  return fs::path(PHY_SOURCE_DIR) / "tests/fuzz/seeds" / reader;
}

class Seeds : public testing::TestWithParam<Reader> {};

TEST_P(Seeds, AreReadOrRefused) {
  std::size_t n = 0;
  for (const auto& entry : fs::directory_iterator(folder_of(GetParam().name))) {
    const std::string bytes = read_file(entry.path());
    const bool bad = entry.path().filename().string().starts_with("bad-");
    bool ok = false;
    EXPECT_NO_THROW(ok = GetParam().read(bytes)) << entry.path();
    EXPECT_TRUE(ok || bad) << entry.path();
    // What is cut short at any of a few places, and what has a byte changed.
    for (std::size_t i = 1; i <= 8; ++i) {
      const std::size_t at = bytes.size() * i / 9;
      EXPECT_NO_THROW(GetParam().read(std::string_view(bytes).substr(0, at))) << entry.path() << " to " << at;
      std::string changed = bytes;
      if (at < bytes.size()) changed[at] = static_cast<char>(~changed[at]);
      EXPECT_NO_THROW(GetParam().read(changed)) << entry.path() << " changed at " << at;
    }
    ++n;
  }
  EXPECT_GE(n, 1U);
}

INSTANTIATE_TEST_SUITE_P(Of, Seeds, testing::ValuesIn(readers()),
                         [](const auto& reader) { return std::string(reader.param.name); });

// Too long for a seed: the page of a calibration, which is written by recursion.
TEST(Brackets, InBracketsDoNotReachTheEndOfTheStack) {
  std::string bytes = read_file(folder_of("report") / "calibration");
  bytes.insert(bytes.find('{') + 1, "\"deep\":" + std::string(100000, '[') + std::string(100000, ']') + ",");
  EXPECT_FALSE(read_report(bytes));
}

}  // namespace
}  // namespace phy::fuzz
