#include "base/text_table.hpp"

#include <gtest/gtest.h>

namespace phy {
namespace {

const Column label{"test", "", {"one", "second"}, true};
const Columns first = {{"E", "GPa", {"1.5", "20"}}, {"nu", "", {"0.25", "-"}}};
const Columns second = {{"UCS", "MPa", {"100", "7"}}};
constexpr const char* first_table =
    "test      E    nu\n"
    "        GPa\n"
    "------  ---  ----\n"
    "one     1.5  0.25\n"
    "second   20     -\n";
constexpr const char* second_table =
    "test    UCS\n"
    "        MPa\n"
    "------  ---\n"
    "one     100\n"
    "second    7\n";

TEST(TextTable, StandsInOnePieceWhereItFits) {
  const std::string whole =
      "test      E    nu  UCS\n"
      "        GPa        MPa\n"
      "------  ---  ----  ---\n"
      "one     1.5  0.25  100\n"
      "second   20     -    7\n";
  for (const int width : {0, 22, 200}) EXPECT_EQ(text_table(label, {first, second}, width), whole) << width;
}

TEST(TextTable, PartsBetweenTheGroups) {
  for (const int width : {17, 21})
    EXPECT_EQ(text_table(label, {first, second}, width), std::string(first_table) + "\n" + second_table);
  EXPECT_EQ(text_table(label, {second, first}, 21), std::string(second_table) + "\n" + first_table);
}

TEST(TextTable, PartsInsideAGroupThatIsTooWideByItself) {
  const std::string E = "test      E\n        GPa\n------  ---\none     1.5\nsecond   20\n";
  const std::string nu = "test      nu\n------  ----\none     0.25\nsecond     -\n";
  EXPECT_EQ(text_table(label, {first, second}, 16), E + "\n" + nu + "\n" + second_table);
  EXPECT_EQ(text_table(label, {first, second}, 3), E + "\n" + nu + "\n" + second_table);  // nothing is lost
}

TEST(TextTable, SentencesMayBeBrokenLater) {
  const Columns said = {{"why", "", {"because of this", "-"}, true}};
  EXPECT_EQ(wrapped(text_table(label, {said}, 0), 16, 8),
            "test    why\n------  ---\none     because\n        of this\nsecond  -\n");
}

TEST(Wrapped, BreaksAtSpacesAndIndentsWhatFollows) {
  EXPECT_EQ(wrapped("one two three four\n", 9, 2), "one two\n  three\n  four\n");
  EXPECT_EQ(wrapped("one two\n", 7), "one two\n");
  EXPECT_EQ(wrapped("one two\n", 6), "one\ntwo\n");
  EXPECT_EQ(wrapped("  one   two\nthree\n", 6, 1), "  one\n two\nthree\n");
  EXPECT_EQ(wrapped("one two three\n", 0), "one two three\n");
}

TEST(Wrapped, LeavesALongWordWhole) {
  EXPECT_EQ(wrapped("a/very/long/name is given\n", 8), "a/very/long/name\nis given\n");
  EXPECT_EQ(wrapped("in a/very/long/name\n\n", 8, 2), "in\n  a/very/long/name\n\n");
  EXPECT_EQ(wrapped("          \n", 4), "          \n");
}

}  // namespace
}  // namespace phy
