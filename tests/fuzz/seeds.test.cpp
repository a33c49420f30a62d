// Does every reader hold to its contract (readers.hpp) on its seeds: real files cut small, and every input
// that once broke one?
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "readers.hpp"

namespace phy::fuzz {
namespace {

namespace fs = std::filesystem;

class Seeds : public testing::TestWithParam<Reader> {};

TEST_P(Seeds, AreReadOrRefused) {
  std::size_t n = 0;
  for (const auto& entry :
       fs::directory_iterator(fs::path(PHY_SOURCE_DIR) / "tests/fuzz/seeds" / GetParam().name)) {
    std::ifstream in(entry.path(), std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(in), {}};
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

}  // namespace
}  // namespace phy::fuzz
