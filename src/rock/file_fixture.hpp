// For tests of rock files: one with its table in a folder of its own.
#pragma once
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "base/in_folder_fixture.hpp"
#include "rock/file.hpp"

namespace phy::rock {

using testing::AllOf;
using testing::Contains;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

class RockFile : public InFolder {
 protected:
  static inline const std::string good =
      "theta [deg],E [GPa],UCS [MPa],UCS_sd [MPa],n\n0,23,105,5,3\n45,20,53,,3\n90,59,138,7,3\n";

  Rock rock(const std::string& csv, const std::string& more = "") const {
    write("r.csv", csv);
    return read_rock(write("r.toml", "data = \"r.csv\"\n" + more));
  }
  /// All problems of a rock that must be refused, one per line.
  std::vector<std::string> problems(const std::string& csv, const std::string& more = "") const {
    std::vector<std::string> lines;
    try {
      rock(csv, more);
    } catch (const InputError& e) {
      for (const Problem& p : e.problems()) lines.push_back(to_line(p));
    }
    return lines;
  }
};

}  // namespace phy::rock
