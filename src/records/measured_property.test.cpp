// The list of properties: every object stands at its index, and what it says of tests and margins holds.
#include "records/measured_property.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "records/test_description.hpp"

namespace phy {
namespace {

TEST(MeasuredProperties, StandAtTheirIndexUnderNamesOfTheirOwn) {
  std::set<std::string> names;
  for (int i = 0; i < n_properties; ++i) {
    const auto p = static_cast<Property>(i);
    EXPECT_EQ(measured(p).property, p) << measured(p).name;
    EXPECT_TRUE(names.insert(measured(p).name).second) << measured(p).name;
    EXPECT_EQ(find_property(measured(p).name), &measured(p));
  }
  EXPECT_EQ(find_property("no property"), nullptr);
}

// A number that its test does not have would be missing from every verification.
TEST(MeasuredProperties, AreNumbersOfTheirTests) {
  for (const MeasuredProperty& p : measured_properties()) {
    if (p.test == nullptr) continue;
    const TestKind kind{p.test};
    EXPECT_TRUE(std::any_of(kind->table.begin(), kind->table.end(), [&](const TableColumn& c) {
      return std::string_view(c.number) == p.number;
    })) << p.name;
    EXPECT_EQ(p.of_discs, kind->cut != nullptr) << p.name;
    EXPECT_EQ(p.under_stress, kind->kept_stress.value != nullptr) << p.name;
  }
}

TEST(MeasuredProperties, AreNumbersInTheUnitOfTheirDimension) {
  for (const MeasuredProperty& p : measured_properties()) {
    EXPECT_LT(p.tolerance, p.coarsest) << p.name;
    EXPECT_LT(p.possible.low, p.possible.high) << p.name;
    if (p.dimension == Dimension::none) continue;
    const Quantity one = parse_quantity("1 " + std::string(p.shown.name), p.dimension);
    ASSERT_TRUE(one.ok) << p.name;
    EXPECT_NEAR(one.value * p.shown.factor, 1.0, 1e-12) << p.name;
  }
}

// Of two properties by one number the curve of the test is drawn beside the one that is the number itself.
TEST(MeasuredProperties, AreFoundByTheNumberThatAnswersThem) {
  EXPECT_EQ(property_of("brazilian", "bts"), Property::brazilian);
  EXPECT_EQ(property_of("uniaxial", "sigma_ci_strain"), Property::crack_initiation);
  EXPECT_FALSE(property_of("biaxial", "q_max"));
  EXPECT_EQ(TestKind("semi_circular_bend")->property(), Property::fracture_toughness);
}

}  // namespace
}  // namespace phy
