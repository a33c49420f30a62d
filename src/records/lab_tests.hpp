// Tests of a laboratory that speak of a parameter, as data: which property, at which inclinations of the
// bedding, under which confinement. What an estimate rests on and what would determine it are lists of them.
#pragma once
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "records/rock.hpp"

namespace phy {

/// Inclinations at which a test speaks. Ends: within `near_0` of 0 degrees, `near_90` and more.
enum class Inclination { any, between, either_end, both_ends };
constexpr double near_0 = 15.0, near_90 = 80.0;  // [deg]

/// Confinement of a strength beside those that a table has.
enum class StressAsked { any, higher, another };

struct LabTest {
  Property property = Property::E;
  Inclination where = Inclination::any;
  double from = 0.0, to = 90.0;  ///< [deg] of `between`
  StressAsked stress = StressAsked::any;
  friend bool operator==(const LabTest&, const LabTest&) = default;
};

/// Tests of which any one will do.
struct LabTests {
  std::vector<LabTest> any_of;
  LabTests(const LabTest& one) : any_of{one} {}  // most are one
  explicit LabTests(std::vector<LabTest> some) : any_of(std::move(some)) {}
  friend bool operator==(const LabTests&, const LabTests&) = default;
};

constexpr LabTest between(Property property, double from, double to) {
  return {property, Inclination::between, from, to};
}
constexpr LabTest at_angle(Property property, double theta) { return between(property, theta, theta); }
constexpr LabTest at_either_end(Property property) { return {property, Inclination::either_end}; }
constexpr LabTest at_both_ends(Property property) { return {property, Inclination::both_ends}; }

/// Does a table hold the test? Whatever the confinement.
bool holds(const std::vector<Target>& targets, const LabTest& test);
/// Of each the alternatives that a table holds; without those of which it holds none.
std::vector<LabTests> held_by(const std::vector<Target>& targets, const std::vector<LabTests>& tests);

/// What an estimate rests on: tests of the table; these through Eq. 1, or Eq. 1 and 2, of the paper's
/// sequence; the ratio to another parameter that the recipe has; values of the table that a model was not
/// shown.
enum class Basis { none, tests, eq1, eq2, ratio_of_recipe, values_left_out };
std::string_view to_string(Basis basis);

struct Support {
  Basis basis = Basis::none;
  std::vector<LabTests> tests = {};
  std::string parameter = {};  ///< of `ratio_of_recipe`: the symbol of the other one
};

/// What would determine a parameter: tests that the table has not, more specimens of those that it has, a
/// table that the model can meet, a map of the planes on the rock; none: no test of a table does.
enum class Remedy { none, test, more_specimens, meet_table, map_persistence };
std::string_view to_string(Remedy remedy);

struct NextStep {
  Remedy remedy = Remedy::none;
  std::vector<LabTests> tests = {};  ///< of Remedy::test and Remedy::more_specimens: all of them
};

/// "UCS between 30 and 60 degrees", "direct tension at 0 degrees, or Brazilian tension at 90 degrees";
/// several with "and". Names of tests, as `cell_name` is one of a cell.
std::string name_of(const LabTest& test);
std::string names_of(const std::vector<LabTests>& tests);
std::string text_of(const Support& support);
std::string text_of(const NextStep& next);

}  // namespace phy
