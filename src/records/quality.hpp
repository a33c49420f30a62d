// Whether a result can be believed: the measures of a test beside the limits that they should keep.
//
// Every measure is a number of the result like any other (analysis/energy.hpp, analysis/specimen_checks.hpp),
// so it is stored, tabled and read back with the rest; only the limits stand here. Two levels: a *warning*
// leaves the number standing and is shown wherever the number is; *untrusted* means that the number is not
// one of the rock, and ends the test with that outcome, out of every mean and fit. A measure may speak of
// some numbers of a test only: then the test stands, and what is untrusted is not given. The limits come from
// tests made bad on purpose: docs/reliability.md.
#pragma once
#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "records/result.hpp"

namespace phy {

/// `unknown`: the result has no measures, it is of an older version of this program. `none`: the test has
/// found neither a strength nor a solution, so that there is nothing to grade.
enum class Grade { unknown, good, warning, untrusted, none };
const char* to_string(Grade grade);

/// How far a measure may go. Measures of which little is bad (rows, transits) have `least` set.
struct QualityLimit {
  const char* number;  ///< name of the measure among the numbers of a result
  const char* what;    ///< its definition, in short
  bool least;          ///< the limits are lower bounds, else upper ones
  double warning;      ///< beyond it the result carries a warning
  double untrusted;    ///< beyond it the result is not trusted
  const char* says;    ///< what is wrong then, after the name and the value
  const char* advice;  ///< what to change
  /// The numbers that it speaks of; none: of all that the test has.
  std::vector<std::string> of = {};
  bool speaks_of(const std::string& name) const;
};
/// The one list, in the order in which troubles are told: what a cause is comes before what follows from it.
const std::vector<QualityLimit>& quality_limits();

/// A measure beyond a limit.
struct QualityMark {
  const QualityLimit* limit = nullptr;
  double value = 0.0;
  Grade grade = Grade::warning;
  double bound() const { return grade == Grade::untrusted ? limit->untrusted : limit->warning; }
  /// "kinetic_ratio above 0.01"
  std::string name() const;
  /// "0.08", with as many digits as tell it from the bound.
  std::string value_text() const;
  /// "kinetic_ratio 0.08, above 0.01: the specimen is in motion, not in equilibrium"
  std::string text() const;
  /// "warning", "untrusted"; of single numbers: "warning for E_tangent, nu", "E_tangent, nu not given"
  std::string heading() const;
  /// So bad that no number of the test is one of the rock.
  bool ends_test() const { return grade == Grade::untrusted && limit->of.empty(); }
};

/// The marks of a result, untrusted ones first; empty when all measures keep their limits. A measure that
/// could not be determined, or is not there (a result of an older version), is no mark.
std::vector<QualityMark> quality_marks(const std::vector<Number>& numbers);

/// Of the outcome where it is no answer, else of the worst mark; one of single numbers is a warning at most.
/// The one place where a grade is made.
Grade grade_of(const TestResult& result);

/// Writes the marks of single numbers into their notes; numbers that are untrusted are NaN from then on.
void note_marks(std::vector<Number>& numbers);

/// How many of many results carry which mark.
struct QualityTally {
  std::size_t n_results = 0, n_marked = 0, n_unknown = 0;  ///< all; with a mark; without measures
  std::map<std::string, std::size_t> measures;             ///< results beyond a limit, by measure
  /// `number`: the one that is used, whose marks count; none: all of them.
  void add(const std::vector<Number>& numbers, const std::string& number = "");
  void add(const QualityTally& more);
  /// "3 of 35 tests carry a warning: energy_error (1), kinetic_ratio (2)"; empty where none does.
  std::string text() const;
};

}  // namespace phy
