// Numbers that were written down once (tests/recorded.txt): a test holds what it gets against them. A change
// that is meant is written down by `make record REASON="why"`, which leaves the reason in CHANGELOG.md.
#pragma once
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <string>

namespace phy {

/// The value written down under a name without spaces; "nothing" where there is none.
inline std::string recorded(const std::string& name) {
  std::ifstream file(PHY_SOURCE_DIR "/tests/recorded.txt");
  for (std::string known, value; file >> known >> value;)
    if (known == name) return value;
  return "nothing";
}

/// Holds the value against the recorded one. With PHY_RECORD=FILE in the environment it is noted there
/// instead.
inline void expect_recorded(const std::string& name, const std::string& value) {
  if (const char* file = std::getenv("PHY_RECORD"); file != nullptr)
    std::ofstream(file, std::ios::app) << name << " " << value << "\n";
  else
    EXPECT_EQ(value, recorded(name)) << name << "; if that is meant: make record REASON=\"why\"";
}

}  // namespace phy
