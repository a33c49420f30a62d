#include "records/finding.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "base/check.hpp"

namespace phy {
namespace {

constexpr std::array kinds = {
    std::pair{FindingKind::value_missed, std::string_view("value_missed")},
};

constexpr std::array advices = {
    std::pair{Advice::none, std::string_view("none")},
};

template <class List, class Value>
std::string_view word_in(const List& list, Value value) {
  const auto it = std::find_if(list.begin(), list.end(), [&](const auto& p) { return p.first == value; });
  PHY_CHECK(it != list.end(), "every kind has its word in files");
  return it->second;
}

}  // namespace

Cell cell_of(const Target& t) { return {t.property, t.theta, t.confining, t.diameter}; }

std::string_view to_string(FindingKind kind) { return word_in(kinds, kind); }
std::string_view to_string(Advice advice) { return word_in(advices, advice); }

double Finding::number(std::string_view name) const {
  const auto it =
      std::find_if(numbers.begin(), numbers.end(), [&](const Quantity& q) { return q.name == name; });
  PHY_CHECK(it != numbers.end(), "the finding has no number " + std::string(name));
  return it->value;
}

}  // namespace phy
