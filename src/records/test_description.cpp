#include "records/test_description.hpp"

#include <algorithm>
#include <string_view>

#include "base/check.hpp"
#include "base/hash.hpp"

namespace phy {

TestKind::TestKind() : test_(laboratory_tests().front()) {}

TestKind::TestKind(std::string_view name) : test_(nullptr) {
  for (const TestDescription* test : laboratory_tests())
    if (name == test->name) test_ = test;
  PHY_CHECK(test_ != nullptr, "a laboratory test is named by its word in the list");
}

const HistoryColumn& TestDescription::column_of(double HistoryRow::*value) const {
  const auto it =
      std::find_if(columns.begin(), columns.end(), [&](const HistoryColumn& c) { return c.value == value; });
  PHY_CHECK(it != columns.end(), "the history of every test has its strain and its stress");
  return *it;
}

std::optional<Property> TestDescription::property() const {
  return property_of(name, curve.quantity().number);
}

bool TestDescription::loads_by_strain() const { return std::string_view(loading_column().unit) == "1"; }

namespace {

std::vector<double HistoryRow::*> hashed_values(const TestDescription& test) {
  std::vector<double HistoryRow::*> values;
  for (const std::string& name : test.hashed)
    for (const HistoryColumn& column : test.columns)
      if (name == column.name) values.push_back(column.value);
  PHY_CHECK(values.size() == test.hashed.size(), "every name in a hash names one column");
  return values;
}

}  // namespace

std::string hash_of(const TestResult& result) {
  Hash h;
  const auto values = hashed_values(*result.history.kind);
  for (const HistoryRow& row : result.history.rows)
    for (double HistoryRow::*value : values) h.add(row.*value);
  for (const CrackEvent& c : result.cracks) {
    h.add(c.step), h.add(c.a), h.add(c.b);
    h.add(static_cast<int>(c.mode)), h.add(static_cast<int>(c.place));
    for (const double v :
         {c.time, c.strain, c.position.x, c.position.y, c.normal.x, c.normal.y, c.size, c.energy})
      h.add(v);
  }
  // After a blow-up positions are no numbers, and which ones depends on the neighbours in the lanes.
  if (!result.snapshots.empty() && result.outcome.status != Status::unstable)
    for (const GrainState& g : result.snapshots.back().grains) h.add(g.ux), h.add(g.uy), h.add(g.rotation);
  return h.text();
}

}  // namespace phy
