// Whatever the bytes: does a text stay a text? (tests/failure/attack.test.cpp asks the languages themselves.)
#include "base/quote.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

namespace phy {
namespace {

std::string every_byte() {
  std::string all;
  for (int i = 1; i < 256; ++i) all += static_cast<char>(i);
  return all;
}

TEST(Quote, NamesMayHaveEveryLetterOfTheWorld) {
  for (const char* name :
       {"", "shale", "Tonschiefer Müller, \"grün\"", "θ = 30°", "片岩", "🪨", "it's {x}_y"})
    EXPECT_TRUE(is_plain(name)) << name;
  for (const char* name : {"a\nb", "a\rb", "a\tb", "\x1b[2J", "\x7f",
                           "\xC2\x9B"
                           "2J"})
    EXPECT_FALSE(is_plain(name)) << terminal_text(name);
}

// Latin-1, a surrogate, the long form of '/', beyond Unicode, a character that is cut off.
TEST(Quote, WhatIsNoUtf8IsNoName) {
  for (const char* name :
       {"M\xFCller", "\xED\xA0\x80", "\xC0\xAF", "\xE0\x80\xAF", "\xF4\x90\x80\x80", "\xE2\x82"})
    EXPECT_FALSE(is_plain(name)) << terminal_text(name);
  EXPECT_EQ(utf8_length("\xE2\x82\xAC!"), 3U);
  EXPECT_EQ(utf8_length(""), 0U);
}

TEST(Quote, TheTerminalGetsNothingThatItObeys) {
  EXPECT_EQ(terminal_text("ü: \x1b]0;t\a\n\xC2\x9B"
                          "1m \xFC\r"),
            "ü: \\x1b]0;t\\x07\n\\xc2\\x9b1m \\xfc\\x0d");
  for (const char c : terminal_text(every_byte()))
    EXPECT_TRUE(c == '\n' || (c >= 32 && c < 127)) << static_cast<int>(c);
}

TEST(Quote, ACommentStaysOnItsLine) {
  EXPECT_EQ(comment_text("shale\nimport os"), "shale\\x0aimport os");
  EXPECT_TRUE(is_plain(comment_text(every_byte())));
}

TEST(Quote, TomlIsQuoted) { EXPECT_EQ(toml_string("a\"\\\nü"), "\"a\\\"\\\\\\u000aü\""); }

TEST(Quote, ACellIsOneCell) {
  for (const char* plain : {"", "peaked", "theta = 30 deg", "ü"}) EXPECT_EQ(csv_cell(plain), plain);
  EXPECT_EQ(csv_cell("a,b"), "\"a,b\"");
  EXPECT_EQ(csv_cell("a \"b\"; c"), "\"a \"\"b\"\"; c\"");
  EXPECT_EQ(csv_cell("# a"), "\"# a\"");
  EXPECT_EQ(csv_cell("a\nb"), "a\\x0ab");
}

TEST(Quote, AShellTakesAWordAsItIs) {
  EXPECT_EQ(sh_word("results/a-1.toml"), "results/a-1.toml");
  EXPECT_EQ(sh_word(""), "''");
  EXPECT_EQ(sh_word("s $(touch X)"), "'s $(touch X)'");
  EXPECT_EQ(sh_word("it's"), "'it'\\''s'");
  ::setenv("PHY_WORD", every_byte().c_str(), 1);
  EXPECT_EQ(std::system(("test " + sh_word(every_byte()) + " = \"$PHY_WORD\"").c_str()), 0);
}

TEST(Quote, WindowsTakesItsLineApartAsItWasMeant) {
  EXPECT_EQ(cmd_word("results\\a-1.toml"), "results\\a-1.toml");
  EXPECT_EQ(cmd_word("C:\\my rocks\\"), "\"C:\\my rocks\\\\\"");
  EXPECT_EQ(cmd_word("it's"), "\"it's\"");
  EXPECT_EQ(cmd_word("1,2"), "\"1,2\"");  // two words to PowerShell
  EXPECT_EQ(cmd_word("a\"b"), "\"a\\\"b\"");
  EXPECT_EQ(cmd_word(""), "\"\"");
}

TEST(Quote, TheShellIsThatOfTheSystem) {
  EXPECT_EQ(shell_word("my rock.toml"), sh_word("my rock.toml"));
  EXPECT_EQ(command_of({"run", "it's.toml"}), "phyllite run 'it'\\''s.toml'");
}

TEST(Quote, GnuplotShowsWhatItIsGiven) {
  EXPECT_EQ(gnuplot_string("it's `rm` \"x\""), "'it'.\"'\".'s `rm` \"x\"'");
  EXPECT_EQ(gnuplot_string("a\n"), "'a\\x0a'");
  EXPECT_EQ(gnuplot_plain("{a}_b^c@d&e~f\\g"), "\\{a\\}\\_b\\^c\\@d\\&e\\~f\\\\g");
}

TEST(Quote, JsonCannotEndItsScript) {
  EXPECT_EQ(json_in_script("{\"a\": \"</script><!-- x\"}"), "{\"a\": \"\\u003c/script>\\u003c!-- x\"}");
}

}  // namespace
}  // namespace phy
