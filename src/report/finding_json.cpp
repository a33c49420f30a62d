#include "report/finding_json.hpp"

#include <nlohmann/json.hpp>

#include <cmath>
#include <utility>

#include "report/words.hpp"

namespace phy::report {
namespace {

constexpr const char* inclinations[] = {"any", "between", "either_end", "both_ends"};
constexpr const char* confinements[] = {"any", "higher", "another"};

Json test_json(const LabTest& test) {
  Json j = {{"property", to_string(test.property)},
            {"where", inclinations[static_cast<std::size_t>(test.where)]}};
  // Elsewhere both are unset, and zeros would read as an angle.
  if (test.where == Inclination::between) j["from [deg]"] = test.from, j["to [deg]"] = test.to;
  if (test.stress != StressAsked::any) j["confinement"] = confinements[static_cast<std::size_t>(test.stress)];
  return j;
}

/// All of a list, any one of each of its lists.
Json tests_json(const std::vector<LabTests>& tests) {
  Json list = Json::array();
  for (const LabTests& some : tests) {
    Json any_of = Json::array();
    for (const LabTest& test : some.any_of) any_of.push_back(test_json(test));
    list.push_back(std::move(any_of));
  }
  return list;
}

Json cell_json(const Cell& c) {
  Json j = {{"property", to_string(c.property)},
            // null: of the property as a whole.
            {"theta [deg]", std::isfinite(c.theta) ? Json(c.theta) : Json(nullptr)}};
  if (c.confining > 0.0) j["confining [Pa]"] = c.confining;
  if (c.diameter > 0.0) j["diameter [m]"] = c.diameter;
  return j;
}

Json numbers_json(const Finding& f) {
  Json numbers = Json::object();
  for (const NamedNumber& q : f.numbers) {
    // A name may occur once per cell; then its values form a list in the order of the cells.
    Json& number = numbers[q.name];
    if (number.is_null())
      number = q.value;
    else if (number.is_array())
      number.push_back(q.value);
    else
      number = Json::array({number, q.value});
  }
  return numbers;
}

}  // namespace

Json finding_json(const Finding& f) {
  Json cells = Json::array();
  for (const Cell& c : f.cells) cells.push_back(cell_json(c));
  Json j = {{"kind", to_string(f.kind)}, {"cells", std::move(cells)}, {"numbers", numbers_json(f)}};
  if (!f.names.empty()) j["names"] = f.names;
  if (f.advice != Advice::none) j["advice"] = to_string(f.advice);
  // For people; a program that parses it breaks with the next version.
  j["text"] = sentence(f);
  return j;
}

Json findings_json(const std::vector<Finding>& findings) {
  Json list = Json::array();
  for (const Finding& f : findings) list.push_back(finding_json(f));
  return list;
}

Json support_json(const Support& s) {
  if (s.basis == Basis::none) return nullptr;
  return {{"basis", to_string(s.basis)}, {"tests", tests_json(s.tests)}, {"text", text_of(s)}};
}

Json next_json(const NextStep& n) {
  if (n.remedy == Remedy::none) return nullptr;
  return {{"remedy", to_string(n.remedy)}, {"tests", tests_json(n.tests)}, {"text", text_of(n)}};
}

}  // namespace phy::report
