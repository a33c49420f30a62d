#include "records/lab_tests.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "base/text_table.hpp"

namespace phy {

bool holds(const std::vector<Target>& targets, const LabTest& test) {
  const auto has = [&](double from, double to) {
    return std::any_of(targets.begin(), targets.end(), [&](const Target& t) {
      return t.property == test.property && t.theta >= from && t.theta <= to;
    });
  };
  const bool at_0 = has(0.0, near_0), at_90 = has(near_90, 90.0);
  switch (test.where) {
    case Inclination::between: return has(test.from, test.to);
    case Inclination::either_end: return at_0 || at_90;
    case Inclination::both_ends: return at_0 && at_90;
    case Inclination::any: break;
  }
  return has(0.0, 90.0);
}

std::vector<LabTests> held_by(const std::vector<Target>& targets, const std::vector<LabTests>& tests) {
  std::vector<LabTests> held = tests;
  for (LabTests& some : held)
    std::erase_if(some.any_of, [&](const LabTest& test) { return !holds(targets, test); });
  std::erase_if(held, [](const LabTests& some) { return some.any_of.empty(); });
  return held;
}

std::string_view to_string(Basis basis) {
  constexpr std::array<std::string_view, 6> words = {"none", "tests",           "eq1",
                                                     "eq2",  "ratio_of_recipe", "values_left_out"};
  return words[static_cast<std::size_t>(basis)];
}

std::string_view to_string(Remedy remedy) {
  constexpr std::array<std::string_view, 5> words = {"none", "test", "more_specimens", "meet_table",
                                                     "map_persistence"};
  return words[static_cast<std::size_t>(remedy)];
}

namespace {

std::string inclination_of(const LabTest& test) {
  switch (test.where) {
    case Inclination::between:
      return test.from == test.to ? fmt::format(" at {:g} degrees", test.from)
                                  : fmt::format(" between {:g} and {:g} degrees", test.from, test.to);
    case Inclination::either_end: return " near 0 or 90 degrees";
    case Inclination::both_ends: return " at 0 and 90 degrees";
    case Inclination::any: break;
  }
  return "";
}

}  // namespace

std::string name_of(const LabTest& test) {
  switch (test.stress) {
    case StressAsked::higher: return "strength under more confinement";
    // Friction shows in how strength grows: the inclination stays.
    case StressAsked::another: return "strength under another confinement, or none, at the same angle";
    case StressAsked::any: break;
  }
  return measured(test.property).test_name + inclination_of(test);
}

std::string names_of(const std::vector<LabTests>& tests) {
  struct Named {
    std::string name;
    std::vector<std::string> places;
  };
  std::vector<Named> names;
  std::map<Property, std::size_t> placed;  // by tests that their places alone tell apart: named once
  for (const LabTests& some : tests) {
    const LabTest& first = some.any_of.front();
    if (some.any_of.size() == 1 && first.stress == StressAsked::any && first.where != Inclination::any) {
      const auto [at, fresh] = placed.try_emplace(first.property, names.size());
      if (fresh) names.push_back({measured(first.property).test_name, {}});
      names[at->second].places.push_back(inclination_of(first));
      continue;
    }
    std::vector<std::string> alternatives;
    for (const LabTest& test : some.any_of) alternatives.push_back(name_of(test));
    names.push_back({joined_text(alternatives, ", or ", ", or "), {}});
  }
  std::vector<std::string> texts;
  for (const Named& n : names) texts.push_back(n.name + joined_text(n.places, ",", " and"));
  return joined_text(texts, ", ", ", and ");
}

std::string text_of(const Support& support) {
  switch (support.basis) {
    case Basis::eq1: return names_of(support.tests) + ", by Eq. 1";
    case Basis::eq2: return names_of(support.tests) + ", by Eq. 1 and 2";
    case Basis::ratio_of_recipe: return support.parameter + ", in the ratio of the recipe";
    case Basis::values_left_out: return "values left out";
    case Basis::tests:
    case Basis::none: break;
  }
  return names_of(support.tests);
}

std::string text_of(const NextStep& next) {
  switch (next.remedy) {
    case Remedy::more_specimens: return "more specimens of " + names_of(next.tests);
    case Remedy::meet_table: return "none while the model misses the table";
    case Remedy::map_persistence: return "persistence of the planes as mapped on the rock (in a recipe)";
    default: return names_of(next.tests);
  }
}

}  // namespace phy
