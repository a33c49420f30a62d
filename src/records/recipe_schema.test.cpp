#include "records/recipe_schema.hpp"
#include "base/spelling.hpp"

#include <gtest/gtest.h>

#include <set>

namespace phy {
namespace {

Recipe with_one_set() {
  Recipe r;
  r.bedding.resize(1);
  return r;
}

/// Number of members of a struct of plain data.
struct Any {
  template <class T>
  operator T() const;
};
template <class T, class... A>
constexpr std::size_t n_members() {
  if constexpr (requires { T{A{}..., Any{}}; })
    return n_members<T, A..., Any>();
  else
    return sizeof...(A);
}
std::size_t n_keys(const std::string& table) {
  std::size_t n = 0;
  for (const Field& f : recipe_fields()) n += f.table == table ? 1U : 0U;
  return n;
}

TEST(Schema, EveryMemberOfTheRecipeHasItsKey) {
  EXPECT_EQ(n_keys("specimen"), n_members<SpecimenSize>());
  EXPECT_EQ(n_keys("packing"), n_members<PackingRecipe>());
  EXPECT_EQ(n_keys("matrix"), n_members<MatrixRecipe>());
  EXPECT_EQ(n_keys("bedding"), n_members<BeddingRecipe>());
  EXPECT_EQ(n_keys("test"), n_members<TestRecipe>());
  EXPECT_EQ(n_keys("engine"), n_members<EngineRecipe>());
  EXPECT_EQ(n_keys(""), 1U);
}

TEST(Schema, EveryKeyIsUniqueAndReachesItsOwnMember) {
  std::set<std::string> paths;
  for (const Field& f : recipe_fields()) {
    EXPECT_TRUE(paths.insert(f.path()).second) << f.path();
    EXPECT_FALSE(f.meaning.empty()) << f.path();
    if (!f.set) continue;
    Recipe r = with_one_set();
    const double other = f.get(r, 0) == 0.0 ? 1.0 : 0.0;
    if (f.kind == FieldKind::choice && f.choices.size() < 2) continue;
    f.set(r, 0, other);
    EXPECT_EQ(f.get(r, 0), other) << f.path();
    for (const Field& g : recipe_fields())
      if (g.get && g.path() != f.path()) {
        EXPECT_EQ(g.get(r, 0), g.get(with_one_set(), 0)) << f.path() << g.path();
      }
  }
}

TEST(Schema, EveryDefaultIsWithinItsRange) {
  const Recipe r = with_one_set();
  for (const Field& f : recipe_fields()) {
    if (!f.get) continue;
    const double v = f.get(r, 0);
    EXPECT_TRUE(f.above_min ? v > f.min : v >= f.min) << f.path();
    EXPECT_TRUE(f.below_max ? v < f.max : v <= f.max) << f.path();
    if (f.kind == FieldKind::choice) {
      EXPECT_LT(v, static_cast<double>(f.choices.size())) << f.path();
    }
  }
  EXPECT_TRUE(cross_checks(r, [](const std::string&) { return ""; }).empty());
}

std::string range_of(const std::string& path) {
  for (const Field& f : recipe_fields())
    if (f.path() == path) return range_text(f);
  return "no such key";
}

TEST(Schema, RangesAreToldInTheUnitsOfTheUser) {
  EXPECT_EQ(range_of("specimen.width"), "0.1 mm <= value <= 1000 m");
  EXPECT_EQ(range_of("bedding.theta"), "0 deg <= value < 180 deg");
  EXPECT_EQ(range_of("bedding.rule"), "one of \"crossing\" \"zone\" \"oriented\"");
  EXPECT_EQ(range_of("packing.n_grains"), "0 <= value <= 1000000");
  EXPECT_EQ(range_of("test.angles"), "a list of 0 deg <= value < 180 deg");
}

TEST(Schema, NearestFindsTypingErrors) {
  EXPECT_EQ(nearest("thicknes", {"thickness", "spacing"}), "thickness");
  EXPECT_EQ(nearest("xyzxyz", {"thickness", "spacing"}), "");
  EXPECT_EQ(nearest("", {"thickness"}), "");
  EXPECT_EQ(nearest("widht", {"width"}), "width");
  EXPECT_EQ(nearest("nwe", {"check", "new"}), "new");
  EXPECT_EQ(nearest("nope", {"rose", "cracks"}), "");
  EXPECT_EQ(nearest("nokey", {"name", "key"}), "");
}

}  // namespace
}  // namespace phy
