// Recipe files: every message that a user can get, and round trips.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/check.hpp"
#include "base/rng.hpp"
#include "io/toml_in.hpp"
#include "records/recipe_schema.hpp"

namespace phy {
namespace {

using testing::HasSubstr;

std::string problems_of(const std::string& text) {
  try {
    parse_recipe(text, "r.toml");
  } catch (const InputError& e) {
    return e.what();
  }
  return "no problem";
}

const std::string bedding = "[[bedding]]\n";

TEST(Recipe, EmptyFileIsThePaperSpecimenWithoutBedding) {
  const Recipe r = parse_recipe("", "r.toml");
  EXPECT_EQ(write_recipe(r), write_recipe(Recipe{}));
}

TEST(Recipe, WrittenRecipeReadsBackToTheSameBits) {
  Recipe r;
  r.bedding.resize(2);
  r.bedding[1].theta = 60.000000000000007;
  r.matrix.E_c = 38.123456789012345e9;
  r.specimen.width = 0.1 + 0.2;
  r.packing.radius_min = 1.0 / 3.0 * 1e-3;
  r.packing.radius_max = 0.5e-3;
  r.packing.n_grains = 0;
  r.packing.porosity = 0.15600000000000003;
  r.test.angles = {0.1, 89.99999999999999};
  const Recipe back = parse_recipe(write_recipe(r), "r.toml");
  EXPECT_EQ(write_recipe(back), write_recipe(r));
  EXPECT_EQ(back.bedding[1].theta, r.bedding[1].theta);
  EXPECT_EQ(back.matrix.E_c, r.matrix.E_c);
  EXPECT_EQ(back.specimen.width, r.specimen.width);
  EXPECT_EQ(back.packing.radius_min, r.packing.radius_min);
  EXPECT_EQ(back.test.angles, r.test.angles);
}

TEST(Recipe, UnitsAreConverted) {
  const Recipe r = parse_recipe("[specimen]\nwidth = \"3.8 cm\"\n[matrix]\nE_c = \"38000 MPa\"\n", "r.toml");
  EXPECT_EQ(r.specimen.width, 0.038);
  EXPECT_EQ(r.matrix.E_c, 38e9);
}

TEST(Recipe, AllProblemsAreToldAtOnceWithTheirLines) {
  const std::string text =
      "[matrix]\nE_c = 38\nsigma_c = \"65 mm\"\nmu = -1\nratio = 3\n[[bedding]]\ntheta = \"200 deg\"\n";
  const std::string p = problems_of(text);
  EXPECT_THAT(p, HasSubstr("r.toml:2: matrix.E_c = 38"));
  EXPECT_THAT(p, HasSubstr("has no unit"));
  EXPECT_THAT(p, HasSubstr("r.toml:3: matrix.sigma_c"));
  EXPECT_THAT(p, HasSubstr("wrong unit"));
  EXPECT_THAT(p, HasSubstr("r.toml:4: matrix.mu = -1"));
  EXPECT_THAT(p, HasSubstr("r.toml:5: matrix.ratio"));
  EXPECT_THAT(p, HasSubstr("r.toml:7: bedding[0].theta"));
  EXPECT_THAT(p, HasSubstr("0 deg <= value < 180 deg"));
}

struct Bad {
  const char* name;
  std::string text;
  const char* says;
};
void PrintTo(const Bad& bad, std::ostream* out) { *out << bad.name; }

class BadRecipe : public testing::TestWithParam<Bad> {};
TEST_P(BadRecipe, SaysWhatIsWrong) { EXPECT_THAT(problems_of(GetParam().text), HasSubstr(GetParam().says)); }

INSTANTIATE_TEST_SUITE_P(
    Messages, BadRecipe,
    testing::Values(Bad{"misspelt", "[specimen]\nwidht = \"38 mm\"\n", "did you mean \"width\"?"},
                    Bad{"unknown_table", "[specimn]\nwidth = \"38 mm\"\n", "did you mean \"specimen\"?"},
                    Bad{"no_number", "[specimen]\nwidth = \"wide\"\n", "does not start with a number"},
                    Bad{"no_table", "specimen = 3\n", "write [specimen] on a line of its own"},
                    Bad{"bedding_no_list", "[bedding]\ntheta = \"0 deg\"\n", "write [[bedding]]"},
                    Bad{"negative_thickness", bedding + "zone_thickness = \"-1 mm\"\n", "0 mm < value"},
                    Bad{"thick_zone", bedding + "zone_thickness = \"6 mm\"\n", "below the spacing of 5 mm"},
                    Bad{"narrow_spacing", bedding + "spacing = \"0.7 mm\"\n",
                        "largest grain diameter, 0.83 mm"},
                    Bad{"dilation", bedding + "psi = \"35 deg\"\n", "tan(psi) <= mu"},
                    Bad{"radii", "[packing]\nradius_min = \"0.5 mm\"\n", "exchange the two"},
                    Bad{"both_sizes", "[packing]\nn_grains = 7481\nporosity = 0.1\n",
                        "exactly one of n_grains and porosity"},
                    Bad{"no_stress", "[packing]\ninitial_stress = \"isotropic\"\n", "above 0 with isotropic"},
                    Bad{"big_grains", "[specimen]\nwidth = \"3 mm\"\n", "a tenth of the specimen"},
                    Bad{"wrong_count", "[packing]\nn_grains = 500\n", "fills the specimen"},
                    Bad{"angles_only", "[test]\nangles = [\"0 deg\"]\n", "add [[bedding]]"},
                    Bad{"angle_no_list", bedding + "[test]\nangles = \"0 deg\"\n", "write a list"},
                    Bad{"planned_test", "[test]\nkind = \"brazilian\"\n", "planned, but not in this version"},
                    Bad{"unknown_choice", bedding + "rule = \"zones\"\n", "did you mean \"zone\"?"},
                    Bad{"fraction", "[test]\nhistory_interval = 12.5\n", "write a whole number"},
                    Bad{"no_boolean", "[test]\nintact = 1\n", "true or false"},
                    Bad{"no_text", "name = 3\n", "text in quotes"},
                    Bad{"infinite", "[matrix]\nmu = inf\n", "0 <= value <= 10"},
                    Bad{"half_header", "[matrix", "r.toml:1"},
                    Bad{"odd_byte", "[matr\xC3\xAFx]\n", "plain ASCII"},
                    Bad{"twice", "name = \"a\"\nname = \"b\"\n", "r.toml:2"}),
    [](const auto& which) { return std::string(which.param.name); });

TEST(Recipe, ReadingAMissingFileIsAnIoError) { EXPECT_THROW(read_recipe("/nonexistent/r.toml"), IoError); }

// A half-typed or damaged file never crashes the reader: it is read, or refused with a message.
TEST(Recipe, DamagedTextIsReadOrRefused) {
  Recipe r;
  r.bedding.resize(1);
  const std::string good = commented_recipe(r);
  int refused = 0;
  for (std::uint32_t i = 0; i < 3000; ++i) {
    std::string text = good;
    for (std::uint32_t k = 0; k < 1 + i % 4; ++k) {
      const auto at =
          static_cast<std::size_t>(uniform(5, Stream::test, i, 2 * k) * static_cast<double>(text.size()));
      const char c =
          "[]\"'=.{}#\n x9-"[static_cast<std::size_t>(uniform(5, Stream::test, i, 2 * k + 1) * 14.0)];
      if (i % 3 == 0)
        text.erase(at, 1 + i % 7);
      else
        text[at] = c;
    }
    refused += problems_of(text) == "no problem" ? 0 : 1;
  }
  EXPECT_GT(refused, 100);
}

TEST(Units, RefuseTrailingText) {
  EXPECT_FALSE(parse_quantity("38 mm x", Dimension::length).ok);
  EXPECT_FALSE(parse_quantity("", Dimension::length).ok);
  EXPECT_EQ(parse_quantity(" 38mm ", Dimension::length).value, 0.038);
}

TEST(Schema, EveryDefaultIsWithinItsRange) {
  Recipe r;
  r.bedding.resize(1);
  for (const Field& f : recipe_fields()) {
    if (f.kind == FieldKind::text || f.kind == FieldKind::quantities) continue;
    const double v = f.get(r, 0);
    EXPECT_GE(v, f.min) << f.path();
    EXPECT_LE(v, f.max) << f.path();
    EXPECT_FALSE(f.meaning.empty()) << f.path();
  }
}

TEST(Schema, NearestFindsTypingErrors) {
  EXPECT_EQ(nearest("thicknes", {"thickness", "spacing"}), "thickness");
  EXPECT_EQ(nearest("xyzxyz", {"thickness", "spacing"}), "");
}

}  // namespace
}  // namespace phy
