// `phyllite verify --hash` tells a program whose numbers are not the recorded ones.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../program.hpp"

namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

class VerifyHash : public ProgramTest {};

// The recorded numbers lie in the program as the text that they are: of a copy, one is changed.
TEST_F(VerifyHash, ADifferenceIsToldWithWhatItMeans) {
  std::string program = read(PHY_PROGRAM);
  const std::string line = "golden/biaxial/flat_joint/float ";
  const std::size_t at = program.find(line) + line.size();
  const std::string known = program.substr(at, 16);
  program.replace(at, 16, "0123456789abcdef");
  const std::string other = write("other", program);
  fs::permissions(other, fs::perms::owner_all);
  EXPECT_EQ(run_line(other + " --threads 2 verify --hash"), 1) << output;
  EXPECT_THAT(output, AllOf(HasSubstr(known + "  DIFFERS: recorded 0123456789abcdef"),
                            HasSubstr("1 of 45 hashes"), HasSubstr("must not be mixed in one study")));
  std::size_t n_equal = 0;
  for (std::size_t i = output.find("  equal\n"); i != output.npos; i = output.find("  equal\n", i + 1))
    ++n_equal;
  EXPECT_EQ(n_equal, 44U);
}

TEST_F(VerifyHash, IsNotOneOfTheClosedForms) {
  EXPECT_EQ(run("verify --hash V6"), 2);
  EXPECT_EQ(run("verify --hash --markdown"), 2);
}

}  // namespace
