#include "records/finding.hpp"

#include <algorithm>
#include <cstddef>

#include "base/check.hpp"

namespace phy {
namespace {

// From the lists of the enumeration itself: no kind can lack its word, nor stand in another place.
constexpr std::string_view kinds[] = {
#define PHY_WORD(word) #word,
#include "records/finding_of_calibration.def"
#include "records/finding_of_course.def"
#include "records/finding_of_design.def"
#include "records/finding_of_maps.def"
#include "records/finding_of_table.def"
};
constexpr std::string_view advices[] = {
#include "records/advice.def"
#undef PHY_WORD
};

const NamedNumber* quantity(const Finding& finding, std::string_view name) {
  const auto it = std::find_if(finding.numbers.begin(), finding.numbers.end(),
                               [&](const NamedNumber& q) { return q.name == name; });
  return it != finding.numbers.end() ? &*it : nullptr;
}

}  // namespace

Cell cell_of(const Target& t) { return {t.property, t.theta, t.confining, t.diameter}; }

std::string_view to_string(FindingKind kind) { return kinds[static_cast<std::size_t>(kind)]; }
std::optional<FindingKind> finding_kind_of(std::string_view word) {
  const auto it = std::ranges::find(kinds, word);
  return it != std::end(kinds) ? std::optional(static_cast<FindingKind>(it - std::begin(kinds)))
                               : std::nullopt;
}

std::string_view to_string(Advice advice) { return advices[static_cast<std::size_t>(advice)]; }

bool Finding::has(std::string_view name) const { return quantity(*this, name) != nullptr; }

double Finding::number(std::string_view name) const {
  const NamedNumber* q = quantity(*this, name);
  PHY_CHECK(q != nullptr, "the finding has no number " + std::string(name));
  return q->value;
}

const Finding* first_of(const std::vector<Finding>& findings, FindingKind kind) {
  const auto it =
      std::find_if(findings.begin(), findings.end(), [&](const Finding& f) { return f.kind == kind; });
  return it != findings.end() ? &*it : nullptr;
}

}  // namespace phy
