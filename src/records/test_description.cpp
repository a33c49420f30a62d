#include "records/test_description.hpp"

#include <algorithm>
#include <string_view>

#include "base/check.hpp"

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

}  // namespace phy
