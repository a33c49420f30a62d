// The list of tests: every room is complete, files tell the tests apart, and hashes cover what they always
// have.
#include "lab/tests.hpp"
#include "base/recorded_fixture.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <map>
#include <set>
#include <string>

namespace phy::lab {
namespace {

Recipe recipe_of(const TestDescription& test) {
  Recipe r;
  r.test.kind = test;
  return r;
}

TEST(LaboratoryTests, EveryRoomIsComplete) {
  for (const TestDescription* test : laboratory_tests()) {
    EXPECT_EQ(TestKind(test->name), TestKind(*test)) << "no other has its name";
    EXPECT_FALSE(test->table.empty()) << test->name;
    EXPECT_FALSE(boundary_name(recipe_of(*test)).empty()) << test->name;
    EXPECT_FALSE(test->loading_text(recipe_of(*test)).empty()) << test->name;
    EXPECT_GT(test->expected.length(recipe_of(*test)), 0.0) << test->name;
    EXPECT_NE(std::string(test->extent).find("{} %"), std::string::npos) << test->name;
    EXPECT_STREQ(test->loading_column().unit, test->loads_by_strain() ? "1" : "m") << test->name;
    EXPECT_STREQ(test->stress_column().unit, "Pa") << test->name;
  }
  EXPECT_EQ(TestKind(), TestKind("uniaxial")) << "a recipe that names no test";
}

// A history on disk names its test by its columns alone.
TEST(LaboratoryTests, ColumnsTellTheTestsApart) {
  std::set<std::string> heads;
  for (const TestDescription* test : laboratory_tests()) {
    std::set<std::string> names;
    std::string head;
    for (const HistoryColumn& c : test->columns) {
      EXPECT_TRUE(names.insert(c.name).second) << test->name << ": " << c.name << " twice";
      head += heading(c);
    }
    EXPECT_TRUE(heads.insert(head).second) << test->name;
  }
}

/// One row whose 29 values are 1 ... 29, in the order of HistoryRow.
TestResult counted(TestKind kind) {
  std::array<double, 29> values{};
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<double>(i + 1);
  TestResult r;
  r.kind = r.history.kind = kind;
  r.history.rows.emplace_back();
  static_assert(sizeof(HistoryRow) >= sizeof(values));
  std::memcpy(static_cast<void*>(&r.history.rows.front()), values.data(), sizeof(values));
  return r;
}

// Written down once: which columns a hash covers, and in which order.
TEST(LaboratoryTests, HashesAreTheRecordedOnes) {
  for (const TestDescription* test : laboratory_tests())
    expect_recorded(std::string("columns/") + test->name, hash_of(counted(*test)));
}

TEST(LaboratoryTests, AColumnAddedOrMovedChangesNoHash) {
  for (const TestDescription* test : laboratory_tests()) {
    TestDescription later = *test;
    later.columns.insert(later.columns.begin(), {"bulging", "1", "not thought of yet", &HistoryRow::slip});
    std::swap(later.columns[2], later.columns.back());
    EXPECT_EQ(hash_of(counted(later)), hash_of(counted(*test))) << test->name;
  }
}

}  // namespace
}  // namespace phy::lab
