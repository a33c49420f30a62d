#include "base/shell.hpp"

#include <gtest/gtest.h>

#include "base/quote.hpp"

namespace phy {
namespace {

TEST(Shell, WindowsTakesItsLineApartAsItWasMeant) {
  EXPECT_EQ(cmd_word("results\\a-1.toml"), "results\\a-1.toml");
  EXPECT_EQ(cmd_word("C:\\my rocks\\"), "\"C:\\my rocks\\\\\"");
  EXPECT_EQ(cmd_word("it's"), "\"it's\"");
  EXPECT_EQ(cmd_word("1,2"), "\"1,2\"");  // two words to PowerShell
  EXPECT_EQ(cmd_word("a\"b"), "\"a\\\"b\"");
  EXPECT_EQ(cmd_word(""), "\"\"");
}

TEST(Shell, IsThatOfTheSystem) {
  EXPECT_EQ(shell_word("my rock.toml"), sh_word("my rock.toml"));
  EXPECT_EQ(command_of({"run", "it's.toml"}), "phyllite run 'it'\\''s.toml'");
}

}  // namespace
}  // namespace phy
