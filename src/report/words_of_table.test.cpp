// Some sentences of the findings about a table, pinned on purpose: the only place where their words are
// tested.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <limits>
#include <sstream>
#include <string>

#include "report/words.hpp"

namespace phy::report {
namespace {

using Kind = FindingKind;

/// A finding that has all that any kind may ask for: two cells, every number once for each.
Finding with_everything(Kind kind) {
  Finding f{kind, {{Property::E, 0.0, 0.0}, {Property::E, 90.0, 5e6}}, {}, {"E", "UCS", "E", "UCS"}};
  for (
      const char* name :
      {"value",    "least",      "most",       "from",        "to",           "laboratory",    "envelope",
       "factor",   "line",       "copy",       "share",       "mean",         "others",        "t",
       "chance",   "off",        "errors",     "from_load",   "exchanged",    "as_read",       "complement",
       "E",        "K_n_delta",  "K_s_delta",  "se_E",        "se_K_n_delta", "se_K_s_delta",  "R2",
       "spacing",  "least_E",    "theta",      "c_w",         "phi_w",        "shoulders",     "rms",
       "of",       "wanted",     "chi_square", "limit",       "change",       "grains",        "radius",
       "fewest",   "with_nu",    "low",        "high",        "least_n",      "most_n",        "angles",
       "doubts",   "batch",      "points",     "tests",       "at_estimate",  "coarse",        "round",
       "packings", "difference", "solutions",  "least_tests", "most_tests",   "least_seconds", "most_seconds",
       "threads",  "models"})
    f.numbers.insert(f.numbers.end(), {{name, 1.0}, {name, 1.0}});
  f.numbers.push_back({"ratio", 1.0});  // of a pair of cells
  return f;
}

/// The largest number of words in one sentence of a text; numbers and signs are none.
int longest_sentence(std::string text) {
  for (std::size_t at = 0; (at = text.find("Eq. ", at)) != text.npos;) text.erase(at + 2, 1);
  int words = 0, most = 0;
  std::istringstream parts(text);
  for (std::string part; parts >> part;) {
    words +=
        std::any_of(part.begin(), part.end(), [](unsigned char c) { return std::isalpha(c) != 0; }) ? 1 : 0;
    most = std::max(most, words);
    if (part.ends_with('.') || part.ends_with('?') || part.ends_with(';')) words = 0;
  }
  return most;
}

TEST(WordsOfTable, EveryKindHasItsSentencesOf25WordsAtMost) {
  for (int i = static_cast<int>(Kind::unusual_value); i <= static_cast<int>(Kind::coarse_half_disc); ++i)
    for (const Advice advice :
         {Advice::none, Advice::check_envelope, Advice::rows_of_their_own, Advice::check_nu}) {
      Finding f = with_everything(static_cast<Kind>(i));
      f.advice = advice;
      EXPECT_FALSE(sentence(f).empty());
      EXPECT_LE(longest_sentence(sentence(f)), 25) << sentence(f);
    }
}

TEST(WordsOfTable, EveryStageOfACalibrationHasItsWords) {
  for (const Wording& w : words_of_course()) {
    const std::string text = sentence(with_everything(w.kind));
    EXPECT_FALSE(text.empty());
    EXPECT_LE(longest_sentence(text), 25) << text;
  }
}

TEST(WordsOfTable, AUnitIsDoubtedWithTheValuesAndWhatIsUsual) {
  const Finding f{Kind::unusual_value,
                  {{Property::E, 0.0}, {Property::E, 45.0}},
                  {{"least", 0.1e9}, {"most", 200e9}, {"value", 0.023e9}, {"value", 0.015e9}},
                  {},
                  Advice::check_unit};
  EXPECT_EQ(
      sentence(f),
      "E is 0.023 GPa at 0 degrees and 0.015 GPa at 45 degrees; hardly any rock lies outside 0.1 to 200 GPa. "
      "Check the unit in the header.");
}

TEST(WordsOfTable, ARockWithoutBeddingHasNoAngle) {
  Finding f{Kind::outlying_specimen,
            {{Property::ucs, std::numeric_limits<double>::quiet_NaN()}},
            {{"value", 63.4e6}, {"mean", 43.6e6}, {"others", 3}, {"t", 6.6}, {"chance", 1e-4}, {"line", 23}},
            {},
            Advice::check_lines};
  EXPECT_EQ(sentence(f),
            "Outlier? Line 23: UCS is 63.4 MPa, where 3 others have a mean of 43.6 MPa. Chance does so in "
            "0.01 % of "
            "tables (t = 6.6). Check for a typing error, or another rock.");
  f.cells[0].theta = 45.0;
  EXPECT_EQ(sentence(f).substr(0, 42), "Outlier? Line 23: UCS at 45 degrees is 63.");
}

TEST(WordsOfTable, RowsThatStandTwiceAreNamedByTheirLines) {
  EXPECT_EQ(
      sentence({Kind::rows_repeated,
                {{Property::ucs, 30.0}, {Property::ucs, 45.0}},
                {{"line", 3}, {"copy", 9}, {"line", 4}, {"copy", 10}},
                {},
                Advice::delete_copies}),
      "Lines 3 and 9, 4 and 10 hold the same values (UCS at 30 and 45 degrees). Delete the copy, unless "
      "another specimen had these values.");
}

TEST(WordsOfTable, AnglesAreAskedForByTheirName) {
  Finding f{Kind::angles_exchanged,
            {},
            {{"from_load", 0}, {"exchanged", 1}, {"as_read", 0.15}, {"complement", 0.01}},
            {"E"},
            Advice::rename_angles};
  EXPECT_EQ(
      sentence(f),
      "These angles look like beta. With theta = 90 - angle, planes miss E by 1 instead of 15 %. Rename the "
      "column to beta, or keep it and ignore this.");
  f.kind = Kind::columns_exchanged, f.advice = Advice::rows_of_their_own, f.names.emplace_back("UCS");
  f.numbers.insert(f.numbers.end(), {{"exchanged", 0}, {"as_read", 0.05}, {"complement", 0.3}});
  EXPECT_EQ(
      sentence(f),
      "It seems that E counts from the load, but UCS from the horizontal. With 90 - angle planes miss E by 1 "
      "instead of 15 %. As written they miss UCS by 5 instead of 30 %. Give E rows with 90 - angle, or keep "
      "the "
      "table and ignore this.");
}

TEST(WordsOfTable, ClosedFormsHaveTheirNumbers) {
  EXPECT_EQ(sentence({Kind::eq1_shoulder,
                      {},
                      {{"E", 50e9},
                       {"K_n_delta", 100e9},
                       {"K_s_delta", 20e9},
                       {"se_E", 1e9},
                       {"se_K_n_delta", 8e9},
                       {"se_K_s_delta", 0.5e9},
                       {"R2", 0.987},
                       {"spacing", 4e-3},
                       {"least_E", 31.4e9},
                       {"theta", 38.2}}}),
            "Eq. 1 through E: E = 50 +- 1 GPa, K_n delta = 100 +- 8 GPa, K_s delta = 20 +- 0.5 GPa, R2 = "
            "0.987. With "
            "planes every 4 mm, K_n = 25000 and K_s = 5000 GPa/m. Shoulder type: E is least at 38 degrees, "
            "31.4 GPa.");
}

TEST(WordsOfTable, TheCellThatBelongsToNoBodyIsNamedWithWhatTheOthersWant) {
  EXPECT_EQ(
      sentence({Kind::one_cell_of_no_body,
                {{Property::nu, 0.0}},
                {{"laboratory", 0.06}, {"wanted", 0.15}, {"errors", 9}, {"chi_square", 80}, {"limit", 23}},
                {},
                Advice::check_nu}),
      "No layered elastic body has this E and nu within the errors: chi-square is 80, and above 23 in 1 % of "
      "tables. By the other cells the odd one out is nu at 0 degrees, 0.060 in place of 0.150 (9.0 standard "
      "errors). Check how nu was measured (it counts in the plane of load and dip), or leave it out.");
}

TEST(WordsOfTable, ModuliThatAreNotTheTablesOwnAreNamedSo) {
  const std::string text = sentence({Kind::no_layered_body,
                                     {{Property::E, 0.0}},
                                     {{"laboratory", 43e9},
                                      {"wanted", 36e9},
                                      {"errors", 6},
                                      {"chi_square", 211},
                                      {"limit", 23},
                                      {"at_small_strain", 1}},
                                     {},
                                     Advice::check_nu});
  EXPECT_EQ(text.substr(0, text.find(':')),
            "Taken back to small strain, E and nu of the table belong to no layered elastic body");
}

}  // namespace
}  // namespace phy::report
