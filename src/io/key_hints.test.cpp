#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/toml_in.hpp"

namespace phy::io {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

TomlValue number(double v) {
  TomlValue value;
  value.kind = TomlValue::Kind::number, value.number = v;
  return value;
}
TomlValue text(const char* v) {
  TomlValue value;
  value.kind = TomlValue::Kind::text, value.text = v;
  return value;
}
std::string hint(const char* word, const char* table, const TomlValue& value = {}) {
  return unknown_key_hint(recipe_schema(), word, table, value);
}

// Every name of PFC's column in docs/conventions.md that somebody may type into a recipe.
TEST(KeyHints, KnowPfcsNames) {
  for (const char* word :
       {"emod",      "pb_emod",   "kratio",    "pb_kratio", "fric",   "pb_ten",  "pb_coh",  "pb_rmul",
        "pb_mcf",    "fj_emod",   "fj_kratio", "fj_ten",    "fj_coh", "fj_nr",   "fj_gap0", "dip",
        "sj_kn",     "sj_ks",     "sj_ten",    "sj_coh",    "sj_fa",  "sj_fric", "sj_da",   "damp",
        "dp_nratio", "dp_sratio", "dp_mode",   "rgap",      "gap",    "lin_kn",  "pb_kn",   "fj_radius",
        "timestep",  "poro",      "rdmin",     "rdmax",     "pb_fa",  "fj_fa"})
    EXPECT_THAT(hint(word, "matrix"), AllOf(Not(HasSubstr("--reference")), Not(HasSubstr("did you mean"))))
        << word;
}

TEST(KeyHints, SayTheLineThatAValueComesTo) {
  EXPECT_EQ(hint("pb_kratio", "matrix", number(1.5)),
            "PFC's \"pb_kratio\" is given by matrix.bond_ks_over_kn (1/pb_kratio): write bond_ks_over_kn = "
            "0.666667");
  EXPECT_EQ(hint("fj_kratio", "matrix", number(4)),
            "PFC's \"fj_kratio\" is given by matrix.ks_over_kn (1/fj_kratio): write ks_over_kn = 0.25");
  EXPECT_EQ(hint("emod", "matrix", number(1e9)),
            "PFC's \"emod\" is given by matrix.E_c: write E_c = \"1 GPa\"");
  EXPECT_EQ(hint("rdmin", "packing", text("2 mm")),
            "PFC's \"rdmin\" is given by packing.radius_min: write radius_min = \"2 mm\"");
  EXPECT_EQ(hint("poro", "packing", number(0.16)),
            "PFC's \"poro\" is given by packing.porosity: write porosity = 0.16");
  EXPECT_THAT(hint("sj_fric", "matrix", number(0.5)), HasSubstr("write mu = 0.5 under [[bedding]]"));
  EXPECT_EQ(hint("kratio", "matrix", number(0)), "PFC's \"kratio\" is given by matrix.ks_over_kn (1/kratio)")
      << "no value that the key can have";
}

// The dip of PFC turns clockwise: 30 degrees of it are our 150, and 0 are 0.
TEST(KeyHints, TheTableDecidesWhatADipIs) {
  EXPECT_THAT(hint("dip", "bedding", number(30)),
              HasSubstr("bedding.theta (180 - dip): write theta = \"150 deg\""));
  EXPECT_THAT(hint("dip", "bedding", number(0)), HasSubstr("write theta = \"0 deg\""));
  EXPECT_THAT(hint("dip", "matrix", text("30 deg")),
              HasSubstr("matrix.foliation (180 - dip): write foliation = \"150 deg\""));
}

TEST(KeyHints, SayWhyThereIsNoSuchKey) {
  EXPECT_THAT(hint("rgap", "matrix"), AllOf(HasSubstr("it has no key"), HasSubstr("packing.initial_stress")));
  EXPECT_THAT(hint("dp_nratio", "matrix"), AllOf(HasSubstr("it has no key"), HasSubstr("engine.damping")));
}

}  // namespace
}  // namespace phy::io
