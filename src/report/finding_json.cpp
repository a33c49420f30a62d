#include "report/finding_json.hpp"

namespace phy::report {
namespace {

constexpr const char* inclinations[] = {"any", "between", "either_end", "both_ends"};
constexpr const char* confinements[] = {"any", "higher", "another"};

Json test_json(const LabTest& test) {
  Json j = {{"property", to_string(test.property)},
            {"where", inclinations[static_cast<std::size_t>(test.where)]}};
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

}  // namespace

Json support_json(const Support& s) {
  if (s.basis == Basis::none) return nullptr;
  return {{"basis", to_string(s.basis)}, {"tests", tests_json(s.tests)}, {"text", text_of(s)}};
}

Json next_json(const NextStep& n) {
  if (n.remedy == Remedy::none) return nullptr;
  return {{"remedy", to_string(n.remedy)}, {"tests", tests_json(n.tests)}, {"text", text_of(n)}};
}

}  // namespace phy::report
