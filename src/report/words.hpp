// The words of findings: the one place where a kind, its cells and its numbers become a sentence.
//
// Sentences have at most 25 words and are such as a colleague would say aloud (CONTRIBUTING, "Style").
// Nothing reads them but people: whoever wants to know what was found asks for the kind.
#pragma once
#include <string>
#include <vector>

#include "records/calibration.hpp"
#include "records/finding.hpp"

namespace phy::report {

/// What was found.
std::string sentence(const Finding& finding);

/// One sentence for several findings that say the same of other cells: "UCS at 0 and 30 degrees: ...".
std::vector<std::string> sentences(const std::vector<Finding>& findings);

/// What to do, as an imperative without a full stop: "test more specimens of UCS at 30 degrees".
std::string text(Advice advice, const Finding& of);

/// The verdict: its status, how many values are met, missed and not decided, and how many of these chance
/// alone would give.
std::string verdict_words(const Calibration& calibration);
/// What the model is good for; what not; why, and what next. A line each.
std::vector<std::string> verdict_lines(const Calibration& calibration);
/// The next step alone, without a full stop, like text(): of a parameter that is open, the test that would
/// determine it.
std::string next_words(const Calibration& calibration);

// ---- one formatter per unit

/// Three digits, no exponent: "118", "48.0", "1.84", "0.529"; "-" for no number.
std::string number_text(double value);
/// A value in the unit in which people read the property: "48.0 MPa", "0.529".
std::string value_text(Property property, double si);
/// The model less the laboratory: relative, but of nu the number itself.
double miss(Property property, double model, double laboratory);
inline double miss(const Comparison& c) { return miss(c.target.property, c.mean, c.target.mean); }
/// "4.1 %", "53 %"; of nu "0.042"; "-" for none.
std::string miss_text(Property property, double miss);
/// "7.2 % too low", by "model" and "laboratory" of the finding.
std::string miss_text(const Finding& finding);
/// "30 %", "3.4 %".
std::string percent_text(double share);
/// A number of a recipe: "25.9 GPa", "1.5 MPa/m", "0.328".
std::string parameter_text(double value, const std::string& unit);
/// "14.3 to 15.0", or one number where both look alike.
std::string range_text(double low, double high, const char* format);
/// "40 s", "12 min", "1.5 h"; "2 to 9 min", "40 s to 3 min".
std::string duration_text(double seconds);
std::string duration_text(double low, double high);
/// "3 tests", "1 test".
std::string counted_text(double n, const std::string& noun);
/// " at 0 and 30 degrees"; a rock without bedding has no angles (NaN).
std::string at_text(const std::vector<double>& angles);
/// "UCS", "BTS (54 mm)", "sigma_1 (10 MPa)".
std::string test_text(const Cell& cell);
/// "UCS at 0 and 30 degrees, BTS at 90 degrees".
std::string cells_text(const std::vector<Cell>& cells);
/// "a, b and c".
std::string list_text(const std::vector<std::string>& items);
/// "48.0 MPa in the model and 51.4 MPa in the table", by "model" and "laboratory" of the finding.
std::string both_text(const Finding& finding);
/// Options as the command line spells them, whoever calibrates: "--effort", "--effort normal".
std::string option_text(const std::string& word);
std::string option_text(const std::string& word, const std::string& value);
/// How a user asks for a rival model, by the last two names.
std::string options_of_rival(const Finding& finding);
/// What allows all points of a usual search, or of a search that had them, more.
std::string options_of_search(const Finding& finding);

// ---- the lists of sentences

struct Wording {
  FindingKind kind;
  std::string (*text)(const Finding&);
  /// Said of each cell alike: the text follows "UCS at 0 degrees: ".
  bool of_cells = false;
};
const std::vector<Wording>& words_of_table();
const std::vector<Wording>& words_of_maps();
std::string advice_of_table(Advice advice, const Finding& of);
const std::vector<Wording>& words_of_calibration();
const std::vector<Wording>& words_of_notes();
const std::vector<Wording>& words_of_course();
const std::vector<Wording>& words_of_design();

}  // namespace phy::report
