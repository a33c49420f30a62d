// What a survey of a table, a search or a verdict finds, as data: kind, cells, numbers, advice; no text.
//
// report/words.hpp is the one place that words a finding; files hold its kind and its numbers beside the
// words. Whoever wants to know what was found - the summary, the page, Python, a test - asks for the kind.
#pragma once
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "records/rock.hpp"

namespace phy {

/// A cell of the table: what `same_cell` compares of two targets.
struct Cell {
  Property property = Property::E;
  double theta = 0.0;      ///< [deg]; NaN: of rock without bedding
  double confining = 0.0;  ///< [Pa]
  double diameter = 0.0;   ///< [m] of a disc; 0: the model's
  friend bool operator==(const Cell& a, const Cell& b) {
    const bool same_angle = a.theta == b.theta || (std::isnan(a.theta) && std::isnan(b.theta));
    return same_angle && a.property == b.property && a.confining == b.confining && a.diameter == b.diameter;
  }
};
Cell cell_of(const Target& target);

/// A number of a finding in SI. Its name is the key in files and says what it is: "model", "laboratory".
struct NamedNumber {
  std::string_view name;  ///< of a literal: it outlives every finding
  double value;
  friend bool operator==(const NamedNumber&, const NamedNumber&) = default;
};

/// What was found. The lists say what belongs to each; its word is also the one in files.
enum class FindingKind : std::uint8_t {
#define PHY_WORD(word) word,
#include "records/finding_of_calibration.def"
#include "records/finding_of_course.def"
#include "records/finding_of_design.def"
#include "records/finding_of_maps.def"
#include "records/finding_of_table.def"
#undef PHY_WORD
};
std::string_view to_string(FindingKind kind);
/// Nothing for a word of another version.
std::optional<FindingKind> finding_kind_of(std::string_view word);

/// What may help. Given only where following it can help.
enum class Advice : std::uint8_t {
#define PHY_WORD(word) word,
#include "records/advice.def"
#undef PHY_WORD
};
std::string_view to_string(Advice advice);

struct Finding {
  FindingKind kind;
  std::vector<Cell> cells = {};
  std::vector<NamedNumber> numbers = {};
  std::vector<std::string> names = {};  ///< of what is no number: a model of rock, a parameter, a column
  Advice advice = Advice::none;

  /// The number of this name; a finding without it is a broken program.
  double number(std::string_view name) const;
  bool has(std::string_view name) const;
  friend bool operator==(const Finding&, const Finding&) = default;
};

/// The first of a kind; nullptr: there is none.
const Finding* first_of(const std::vector<Finding>& findings, FindingKind kind);

}  // namespace phy
