// Recipe files: every message that a user can get, and round trips.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "base/check.hpp"
#include "base/in_folder_fixture.hpp"
#include "base/rng.hpp"
#include "io/toml_in.hpp"
#include "records/recipe_schema.hpp"
#include "records/test_description.hpp"

namespace phy::io {
namespace {

using testing::AllOf;
using testing::AnyOf;
using testing::HasSubstr;
using testing::Not;

std::string problems_of(const std::string& text) {
  return message_of<InputError>([&] { parse_recipe(text, "r.toml"); });
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
  for (int i = 0; i < 250; ++i) r.test.angles.push_back(0.7001 * i + 0.01);
  const Recipe back = parse_recipe(write_recipe(r), "r.toml");
  EXPECT_EQ(back.test.angles, r.test.angles);
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
    testing::Values(
        Bad{"misspelt", "[specimen]\nwidht = \"38 mm\"\n", "did you mean \"width\"?"},
        Bad{"unknown_table", "[specimn]\nwidth = \"38 mm\"\n", "did you mean \"specimen\"?"},
        Bad{"no_number", "[specimen]\nwidth = \"wide\"\n", "does not start with a number"},
        Bad{"no_table", "specimen = 3\n", "write [specimen] on a line of its own"},
        Bad{"bedding_no_list", "[bedding]\ntheta = \"0 deg\"\n", "write [[bedding]]"},
        Bad{"negative_thickness", bedding + "zone_thickness = \"-1 mm\"\n", "0 mm < value"},
        Bad{"thick_zone", bedding + "zone_thickness = \"6 mm\"\n", "below the spacing of 5 mm"},
        Bad{"narrow_spacing", bedding + "spacing = \"0.7 mm\"\n", "largest grain diameter, 0.83 mm"},
        Bad{"scatter_below_a_grain", bedding + "spacing_sd = 0.3\n",
            "bedding[0].spacing_sd = 0.3: expected planes at least the largest grain diameter, 0.83 mm, "
            "apart"},
        Bad{"scatter_below_the_zone",
            bedding + "spacing = \"9 mm\"\nzone_thickness = \"5 mm\"\nspacing_sd = 0.2\n",
            "planes more than zone_thickness = 5 mm apart"},
        Bad{"wide_scatter", bedding + "spacing_sd = 0.4\n", "0 <= value <= 0.3"},
        Bad{"wide_tilts", bedding + "theta_sd = \"20 deg\"\n", "0 deg <= value <= 10 deg"},
        Bad{"many_planes",
            "[specimen]\nwidth = \"380 mm\"\nheight = \"760 mm\"\n[packing]\nporosity = 0.16\nn_grains = 0\n"
            "radius_min = \"1 mm\"\nradius_max = \"1.66 mm\"\n" +
                bedding + "spacing = \"4 mm\"\ntheta_sd = \"1 deg\"\n",
            "bedding[0].theta_sd = some 216 planes: expected at most 200 planes"},
        Bad{"no_persistence", bedding + "persistence = 0\n", "above 0 without layers"},
        Bad{"negative_patch", bedding + "patch_length = \"-1 mm\"\n", "0 mm <= value"},
        Bad{"no_range", bedding + "rule = \"oriented\"\norientation_range = \"0 deg\"\n",
            "0 deg < value <= 90 deg"},
        Bad{"oriented_spacing", bedding + "rule = \"oriented\"\nspacing = \"4 mm\"\n",
            "bedding[0].spacing = 4 mm: expected nothing with rule = \"oriented\", which has no planes"},
        Bad{"oriented_offset", bedding + "rule = \"oriented\"\noffset = \"1 mm\"\n",
            "leave it out, or use the rule zone or crossing"},
        Bad{"oriented_scatter", bedding + "rule = \"oriented\"\nspacing_sd = 0.1\n", "has no planes"},
        Bad{"oriented_tilts", bedding + "rule = \"oriented\"\ntheta_sd = \"2 deg\"\n", "has no planes"},
        Bad{"oriented_persistence", bedding + "rule = \"oriented\"\npersistence = 0.5\n", "has no planes"},
        Bad{"oriented_patches", bedding + "rule = \"oriented\"\npatch_length = \"2 mm\"\n",
            "bedding[0].patch_length = 2 mm: expected nothing with rule = \"oriented\""},
        Bad{"oriented_bridges", bedding + "rule = \"oriented\"\nbridges = false\n",
            "bedding[0].bridges = false: expected nothing with rule = \"oriented\""},
        Bad{"no_bridge", bedding + "bridges = 0\n", "true or false"},
        Bad{"negative_scatter", bedding + "sigma_n_sd = \"-1 MPa\"\n", "0 GPa <= value"},
        Bad{"dilation", bedding + "psi = \"35 deg\"\n", "tan(psi) <= mu"},
        Bad{"radii", "[packing]\nradius_min = \"0.5 mm\"\n", "exchange the two"},
        Bad{"both_sizes", "[packing]\nn_grains = 7481\nporosity = 0.1\n",
            "exactly one of n_grains and porosity"},
        Bad{"no_stress", "[packing]\ninitial_stress = \"isotropic\"\n", "above 0 with isotropic"},
        Bad{"big_grains", "[specimen]\nwidth = \"3 mm\"\n",
            "specimen.width = 3 mm: expected at least ten mean grain diameters, 6.65 mm"},
        Bad{"wrong_count", "[packing]\nn_grains = 500\n",
            "packing.n_grains = 500: 500 discs of 0.665 mm fill 6.1 % of 38 mm x 76 mm. About 7500 fill it; "
            "or "
            "make them larger: radius_min = \"0.967 mm\", radius_max = \"1.61 mm\""},
        Bad{"too_many", "[packing]\nn_grains = 20000\n",
            "20000 discs of 0.665 mm fill 250 % of 38 mm x 76 mm. About 7500 fill it; or make them smaller"},
        Bad{"count_of_a_narrow_one", "[specimen]\nwidth = \"10 mm\"\n[packing]\nn_grains = 30\n",
            "About 2000 fill it"},
        Bad{"angles_only", "[test]\nangles = [\"0 deg\"]\n", "add [[bedding]]"},
        Bad{"angle_no_list", bedding + "[test]\nangles = \"0 deg\"\n", "write a list"},
        Bad{"unknown_choice", bedding + "rule = \"zones\"\n", "did you mean \"zone\"?"},
        Bad{"fraction", "[test]\nhistory_interval = 12.5\n", "write a whole number"},
        Bad{"no_boolean", "[test]\nintact = 1\n", "true or false"},
        Bad{"no_text", "name = 3\n", "text in quotes"},
        Bad{"infinite", "[matrix]\nmu = inf\n", "0 <= value <= 10"},
        Bad{"half_header", "[matrix", "r.toml:1"},
        Bad{"unquoted", "[specimen]\nwidth = 38 mm\n", "put a quantity in quotes"},
        Bad{"open_quotes_after_a_backslash", "[specimen]\nwidth = \"38\\tmm\n", "close the quotes"},
        Bad{"unquoted_text", "name = paper\n", "put text in quotes"},
        Bad{"open_quotes", "name = \"paper\n", "close the quotes"},
        Bad{"no_value", "name =\n", "write a value behind the ="},
        Bad{"open_list", bedding + "[test]\nangles = [\"0 deg\"\nintact = true\n",
            "close the list begun above"},
        Bad{"control", "name = \"a\x01\"\n", "odd character (byte 1)"},
        Bad{"long_line", "name = \"" + std::string(5000, 'x') + "\"\n", "break the line"},
        Bad{"long_file", std::string(2U << 20U, '\n'), "at most 1 MB"},
        Bad{"other_unit", "[matrix]\nE_c = \"38 mm\"\n", "wrong unit \"mm\""},
        Bad{"number_in_quotes", "[matrix]\nmu = \"0.8\"\n", "write a bare number"},
        Bad{"other_table", "[specimen]\nspacing = \"5 mm\"\n", "it belongs to [[bedding]]"},
        Bad{"pfc_name", "[matrix]\nkratio = 3\n",
            "matrix.ks_over_kn (1/kratio): write ks_over_kn = 0.333333"},
        Bad{"nothing_near", "[matrix]\nqqqqqqqq = 3\n", "phyllite recipe --reference"},
        Bad{"angle_200", bedding + "[test]\nangles = [\"200 deg\"]\n", "0 deg <= value < 180 deg"},
        Bad{"angle_twice", bedding + "[test]\nangles = [\"0 deg\", \"0.0 deg\"]\n", "every angle once"},
        Bad{"neither_size", "[packing]\nn_grains = 0\n", "give one of them"},
        Bad{"few_grains", "[packing]\nn_grains = 7\n", "0, or at least 16"},
        Bad{"many_grains", "[packing]\nn_grains = 1000001\n", "0 <= value <= 1000000"},
        Bad{"porous", "[specimen]\nwidth = \"9 m\"\nheight = \"9 m\"\n[packing]\nporosity = 0.16\n",
            "at most 1000000 grains"},
        Bad{"idle_stress", "[packing]\nisotropic_stress = \"1 MPa\"\n", "0 with stress_free"},
        Bad{"idle_phi", "[matrix]\nphi = \"30 deg\"\n", "shear_strength = \"cohesion_friction\""},
        Bad{"long_ramp", "[test]\nramp_strain = 0.01\n", "below max_strain = 0.01"},
        Bad{"a_study", "recipe = \"press.toml\"\nsolver = \"direct\"\n",
            "r.toml is a study, not a recipe. To run it: phyllite study r.toml"},
        Bad{"a_study_or_a_rock", "recipe = \"press.toml\"\n",
            "r.toml:1: recipe = \"press.toml\": a recipe names no other"},
        Bad{"bare_gap", "[matrix]\nbond_gap = 0.0125\n",
            "0 mm <= value <= 100 m; has no unit; in PFC it would be \"0.0125 m\""},
        Bad{"gap_beyond_a_neighbour", "[matrix]\nbond_gap = \"2 mm\"\n",
            "at most the largest grain diameter, 0.83 mm"},
        Bad{"gap_by_pfcs_name", "[matrix]\ngap = 3.5e-5\n",
            "PFC's \"gap\" is given by matrix.bond_gap: write bond_gap = \"35 um\""},
        Bad{"thousand_times_too_stiff", "[matrix]\nE_c = \"38000 GPa\"\n",
            "expected 1 kPa <= value <= 10000 GPa; did you mean \"38000 MPa\"?"},
        Bad{"thousand_times_too_fast", "[test]\nplaten_speed = \"50 m/s\"\n", "did you mean \"50 mm/s\"?"},
        Bad{"fraction_in_quotes", "[matrix]\nbond_ks_over_kn = \"1/1.5\"\n",
            "write it as a number: 0.666667"},
        Bad{"fraction_without_quotes", "[matrix]\nbond_ks_over_kn = 1/1.5  # 1/kratio\n",
            "write it as a number: 0.666667"},
        Bad{"dip_of_planes", bedding + "dip = 30\n",
            "bedding[0].dip: unknown key; PFC's \"dip\" is given by bedding.theta (180 - dip): write theta = "
            "\"150 deg\""},
        Bad{"long_pre_strain", "[test]\npre_strain = 0.05\n", "below max_strain = 0.01"},
        Bad{"negative_confinement", "[test]\nkind = \"biaxial\"\nconfining_stress = \"-1 MPa\"\n",
            "0 GPa <= value <= 10 GPa"},
        Bad{"big_disc", "[test]\nkind = \"brazilian\"\ndisc_diameter = \"40 mm\"\n",
            "at most the smaller side, 38 mm"},
        Bad{"tiny_disc", "[test]\nkind = \"brazilian\"\ndisc_diameter = \"3 mm\"\n",
            "at least ten mean grain diameters, 6.65 mm"},
        Bad{"negative_jaw", "[test]\nkind = \"brazilian\"\nloading_angle = \"-1 deg\"\n",
            "0 deg <= value <= 30 deg"},
        Bad{"wide_jaw", "[test]\nkind = \"brazilian\"\nloading_angle = \"31 deg\"\n",
            "0 deg <= value <= 30 deg"},
        Bad{"thick_grip", "[test]\nkind = \"direct_tension\"\ngrip_thickness = \"30 mm\"\n",
            "at most a fifth of the height"},
        Bad{"platens_of_a_disc", "[test]\nkind = \"brazilian\"\nplaten_friction = 0.2\n",
            "give test.jaw_friction"},
        Bad{"wide_gap", "[test]\nkind = \"direct_shear\"\nshear_gap = \"40 mm\"\n",
            "at most half the height"},
        Bad{"negative_normal", "[test]\nkind = \"direct_shear\"\nnormal_stress = \"-1 MPa\"\n",
            "0 GPa <= value <= 10 GPa"},
        Bad{"short_notch", "[test]\nkind = \"semi_circular_bend\"\nnotch_ratio = 0.3\n",
            "0.4 <= value <= 0.6"},
        Bad{"wide_span", "[test]\nkind = \"semi_circular_bend\"\nspan_ratio = 0.9\n", "0.5 <= value <= 0.8"},
        Bad{"thin_notch", "[test]\nkind = \"semi_circular_bend\"\nnotch_width = \"0.5 mm\"\n",
            "at least the largest grain diameter, 0.83 mm"},
        Bad{"wide_notch", "[test]\nkind = \"semi_circular_bend\"\nnotch_width = \"3 mm\"\n",
            "at most a twentieth of the diameter, 1.9 mm"},
        Bad{"big_half_disc", "[test]\nkind = \"semi_circular_bend\"\ndisc_diameter = \"40 mm\"\n",
            "at most the width and twice the height, 38 mm"},
        Bad{"big_hole", "[specimen]\nhole_diameter = \"32 mm\"\n",
            "within the specimen, five mean grain diameters, 3.325 mm, from its edge"},
        Bad{"tiny_hole", "[specimen]\nhole_diameter = \"1 mm\"\n",
            "0, or at least two largest grain diameters, 1.66 mm"},
        Bad{"hole_and_flaw", "[specimen]\nhole_diameter = \"5 mm\"\nflaw_length = \"5 mm\"\n",
            "a specimen has a hole or a flaw"},
        Bad{"hole_of_a_disc",
            "[specimen]\nhole_diameter = \"20 mm\"\n[test]\nkind = \"brazilian\"\ndisc_diameter = \"25 "
            "mm\"\n",
            "use a smaller hole"},
        Bad{"hole_of_half_a_disc",
            "[specimen]\nhole_diameter = \"5 mm\"\n[test]\nkind = \"semi_circular_bend\"\n",
            "half a disc has its notch"},
        Bad{"opening_without_depth", "[test]\nkind = \"opening\"\n", "give the stress at the depth"},
        Bad{"wide_opening",
            "[test]\nkind = \"opening\"\nvertical_stress = \"9 MPa\"\nopening_diameter = \"20 mm\"\n",
            "at most half of the smaller side"},
        Bad{"narrow_opening",
            "[test]\nkind = \"opening\"\nvertical_stress = \"9 MPa\"\nopening_diameter = \"1 mm\"\n",
            "at least two largest grain diameters, 1.66 mm"},
        Bad{"rough_walls_of_an_opening",
            "[test]\nkind = \"opening\"\nvertical_stress = \"9 MPa\"\nplaten_friction = 0.2\n",
            "walls with friction would hold the rock"},
        Bad{"opening_led_by_its_sides",
            "[test]\nkind = \"opening\"\nvertical_stress = \"9 MPa\"\nhorizontal_stress = \"12 MPa\"\n",
            "at most vertical_stress = 9 MPa; bottom and top load the rock until it fails: turn the block"},
        Bad{"hole_beside_an_opening",
            "[specimen]\nhole_diameter = \"5 mm\"\n[test]\nkind = \"opening\"\nvertical_stress = \"9 MPa\"\n",
            "give test.opening_diameter"},
        Bad{"long_flaw", "[specimen]\nflaw_length = \"35 mm\"\n", "use a shorter flaw"},
        Bad{"idle_flaw_angle", "[specimen]\nflaw_angle = \"30 deg\"\n", "give specimen.flaw_length"},
        Bad{"idle_flaw_width", "[specimen]\nflaw_width = \"1 mm\"\n", "give specimen.flaw_length"},
        Bad{"turned_flaw", "[specimen]\nflaw_length = \"5 mm\"\nflaw_angle = \"180 deg\"\n",
            "0 deg <= value < 180 deg"},
        Bad{"thin_flaw", "[specimen]\nflaw_length = \"9 mm\"\nflaw_width = \"0.1 mm\"\n",
            "at least the largest grain diameter, 0.83 mm"},
        Bad{"squat_flaw", "[specimen]\nflaw_length = \"4 mm\"\nflaw_width = \"5 mm\"\n",
            "at most flaw_length = 4 mm"},
        Bad{"idle_normal_stiffness", "[test]\nkind = \"direct_shear\"\nnormal_stiffness = \"1 GPa/m\"\n",
            "give test.normal_stress"},
        Bad{"pre_strain_in_tension", "[test]\nkind = \"direct_tension\"\npre_strain = 1e-4\n",
            "only the uniaxial press can start loaded"},
        Bad{"approach_without_speed", "[test]\napproach_strain = 1e-3\n", "0 without an approach_speed"},
        Bad{"slow_approach", "[test]\napproach_strain = 1e-3\napproach_speed = \"1 mm/s\"\n",
            "at least platen_speed = 0.05 m/s"},
        Bad{"long_approach", "[test]\napproach_strain = 0.05\napproach_speed = \"1 m/s\"\n",
            "below max_strain = 0.01"},
        Bad{"approach_behind_the_start",
            "[test]\npre_strain = 1e-3\napproach_strain = 1e-3\napproach_speed = \"1 m/s\"\n",
            "above pre_strain + ramp_strain = 0.00102"},
        Bad{"approach_within_the_ramp", "[test]\napproach_strain = 2e-5\napproach_speed = \"1 m/s\"\n",
            "above pre_strain + ramp_strain = 2e-05"},
        Bad{"approach_of_a_shear_box",
            "[test]\nkind = \"direct_shear\"\napproach_strain = 1e-3\napproach_speed = \"1 m/s\"\n",
            "0 for this kind of test"},
        Bad{"intact_foliated", "[matrix]\ntension_ratio = 2\n[test]\nintact = true\n",
            "false with a matrix that has directions"},
        Bad{"elements_of_a_bond", "[matrix]\nelements = 2\n", "nothing where model = \"parallel_bond\""},
        Bad{"bond_modulus_of_flat_joints", "[matrix]\nmodel = \"flat_joint\"\nE_b = \"20 GPa\"\n",
            "nothing where model = \"flat_joint\""},
        Bad{"gaps_without_width", "[matrix]\nmodel = \"flat_joint\"\ngapped_fraction = 0.1\n",
            "above 0 together with initial_gap"},
        Bad{"idle_foliation", "[matrix]\nfoliation = \"30 deg\"\n", "0 deg where all ratios are 1"},
        Bad{"unknown_test", "[test]\nkind = \"brasilian\"\n", "brazilian"},
        Bad{"odd_byte", "[matr\xC3\xAFx]\n", "plain ASCII"},
        Bad{"twice", "name = \"a\"\nname = \"b\"\n", "r.toml:2"}),
    [](const auto& which) { return std::string(which.param.name); });

// Every key moved a little from its default comes back to the same bits, through text with units.
TEST(Recipe, EveryKeyRoundTrips) {
  for (std::uint32_t i = 0; i < 200; ++i) {
    Recipe r;
    r.bedding.resize(2);
    r.test.kind = TestKind(i % 2 == 0 ? "uniaxial" : "semi_circular_bend");  // which has keys of its own
    r.test.angles = {180.0 * uniform(i, Stream::test, 1), 180.0 * uniform(i, Stream::test, 2)};
    r.name = std::string("quote\" 'other' slash\\ \xC3\xA9 ") + static_cast<char>('a' + i % 26);
    std::uint32_t draw = 3;
    for (const Field& f : recipe_fields())
      for (std::size_t set = 0; set < (f.table == "bedding" ? 2U : 1U); ++set)
        if (f.kind == FieldKind::quantity || f.kind == FieldKind::number)
          f.set(r, set, f.get(r, set) * (1.0 - 0.02 * uniform(i, Stream::test, ++draw)));
        else if (f.kind == FieldKind::boolean)
          f.set(r, set, uniform(i, Stream::test, ++draw) < 0.5 ? 1.0 : 0.0);
    r.test.intact = false;  // its ratios have given the matrix directions
    for (BeddingRecipe& set : r.bedding) set.layer_thickness = 1e-4;  // or its layers would be of no use
    const Recipe back = parse_recipe(write_recipe(r), "r.toml");
    EXPECT_EQ(back.name, r.name);
    EXPECT_EQ(back.test.angles, r.test.angles);
    ASSERT_EQ(back.bedding.size(), 2U);
    for (const Field& f : recipe_fields())
      for (std::size_t set = 0; set < (f.table == "bedding" ? 2U : 1U); ++set)
        if (f.get && (f.test.empty() || f.test == r.test.kind->name)) {
          EXPECT_EQ(f.get(back, set), f.get(r, set)) << f.path();
        }
  }
}

// Bedding that is as it always was is written as it always was.
TEST(Recipe, LaterKeysOfBeddingAreWrittenOnlyWhereTheySaySomething) {
  Recipe r;
  r.bedding.resize(1);
  for (const char* key : {"theta_sd", "spacing_sd", "bridges", "orientation_range", "persistence",
                          "patch_length", "sigma_n_sd"}) {
    EXPECT_THAT(write_recipe(r), Not(HasSubstr(key)));
    EXPECT_THAT(commented_recipe(r), HasSubstr(std::string("\n") + key + " = "));
  }
  r.bedding[0].persistence = 0.4;
  EXPECT_THAT(write_recipe(r), HasSubstr("persistence = 0.4\n"));
  r.bedding[0] = {};
  r.bedding[0].rule = BeddingRule::oriented;
  EXPECT_THAT(write_recipe(r), Not(HasSubstr("spacing")));
  EXPECT_THAT(write_recipe(r), Not(HasSubstr("offset")));
  EXPECT_THAT(write_recipe(r), HasSubstr("orientation_range = \"15 deg\"\n"));
  EXPECT_EQ(parse_recipe(write_recipe(r), "r.toml").bedding[0].rule, BeddingRule::oriented);
}

// Recipes of sound rock are written as before there were holes.
TEST(Recipe, OpeningsAreWrittenWhereTheyAre) {
  Recipe r;
  EXPECT_THAT(write_recipe(r), Not(AnyOf(HasSubstr("hole"), HasSubstr("flaw"))));
  r.specimen.hole_diameter = 0.0123;
  EXPECT_THAT(write_recipe(r), AllOf(HasSubstr("hole_diameter = \"12.3 mm\"\n"), Not(HasSubstr("flaw"))));
  EXPECT_EQ(parse_recipe(write_recipe(r), "r.toml").specimen.hole_diameter, 0.0123);
  r.specimen.hole_diameter = 0.0;
  // Along the height there is room for what is too long across.
  r.specimen.flaw_length = 0.05, r.specimen.flaw_angle = 80.0, r.specimen.flaw_width = 0.001;
  const SpecimenSize back = parse_recipe(write_recipe(r), "r.toml").specimen;
  EXPECT_EQ(back.flaw_length, 0.05);
  EXPECT_EQ(back.flaw_angle, 80.0);
  EXPECT_EQ(back.flaw_width, 0.001);
}

TEST(Recipe, CommentsChangeNothing) {
  Recipe r;
  r.bedding.resize(1);
  EXPECT_EQ(write_recipe(parse_recipe(commented_recipe(r), "r.toml")), write_recipe(r));
}

TEST(Recipe, ExamplesAreReadAndSayWhatTheirNamesSay) {
  const std::string folder = std::string(PHY_SOURCE_DIR) + "/examples/paper/";
  const Recipe press = read_recipe(folder + "press.toml");
  const Recipe crossing = read_recipe(folder + "press-crossing.toml");
  const Recipe area = read_recipe(folder + "press-area.toml");
  Recipe paper;
  paper.name = press.name;
  paper.bedding.resize(1);
  paper.test.angles = {0, 15, 30, 45, 60, 75, 90};
  paper.test.intact = true;
  EXPECT_EQ(write_recipe(press), write_recipe(paper)) << "the defaults are the paper's specimen";
  paper.name = crossing.name;
  paper.bedding[0].rule = BeddingRule::crossing;
  EXPECT_EQ(write_recipe(crossing), write_recipe(paper));
  EXPECT_EQ(area.packing.n_grains, 0);
  EXPECT_EQ(area.packing.porosity, 0.156);
  EXPECT_EQ(area.packing.isotropic_stress, 0.5e6);
  EXPECT_EQ(area.packing.distribution, RadiusDistribution::by_area);
}

TEST(Recipe, SyntaxErrorsDoNotHideOtherProblems) {
  const std::string p = problems_of(
      "name = \"paper\nname = \"x\"\nname = \"y\"\n[specimen]\nwidth = 38 mm\nheight = \"76 "
      "MPa\"\n[test]\nintact = yes\n");
  for (const char* where :
       {"r.toml:1: ", "r.toml:3: ", "r.toml:5: ", "r.toml:6: specimen.height", "r.toml:8: "})
    EXPECT_THAT(p, HasSubstr(where));
  EXPECT_EQ(std::count(p.begin(), p.end(), '\n'), 4) << p;
}

// A wrong key does not hide that two others contradict each other; it does silence what would be about
// itself.
TEST(Recipe, MistakesBetweenKeysAreToldBesideMistakesInKeys) {
  const std::string p = problems_of(
      "[matrix]\nmu = -1\n[[bedding]]\nspacing = \"2 mm\"\nzone_thickness = \"3 mm\"\n[test]\n"
      "pre_strain = 0.05\nmax_strain = \"1 %\"\n");
  EXPECT_THAT(p, HasSubstr("r.toml:2: matrix.mu"));
  EXPECT_THAT(p, HasSubstr("r.toml:5: bedding[0].zone_thickness = 3 mm: expected below the spacing of 2 mm"));
  EXPECT_THAT(p, HasSubstr("r.toml:8: test.max_strain"));
  EXPECT_EQ(std::count(p.begin(), p.end(), '\n'), 2) << "pre_strain waits for max_strain: " << p;
}
// What a misspelt key or a broken line was meant to give is not known, so only given keys are compared.
TEST(Recipe, NothingIsHeldAgainstADefaultThatMayNotBeMeant) {
  const std::string p = problems_of("[packing]\nradius_mni = \"0.1 mm\"\nradius_max = \"0.2 mm\"\n");
  EXPECT_THAT(p, HasSubstr("did you mean \"radius_min\"?"));
  EXPECT_EQ(p.find("exchange the two"), p.npos) << p;
  const std::string q = problems_of(
      "nmae = \"x\"\n[[bedding]]\nspacing = \"2 mm\"\nrule = \"zone\"\n"
      "zone_thickness = \"3 mm\"\n");
  EXPECT_THAT(q, HasSubstr("did you mean \"name\"?"));
  EXPECT_THAT(q, HasSubstr("below the spacing of 2 mm"));
  EXPECT_EQ(problems_of("[test]\nangles = [\"0 deg\"]\n[bedding]\n").find("add [[bedding]]"),
            std::string::npos);
}

TEST(Recipe, ProblemsComeInTheOrderOfTheFile) {
  const std::string p =
      problems_of("[test]\nstop_at = 7\n[matrix]\nmu = -1\n[engine]\nzzz = 1\ndamping = 2\n");
  EXPECT_LT(p.find("r.toml:2"), p.find("r.toml:4"));
  EXPECT_LT(p.find("r.toml:4"), p.find("r.toml:6"));
  EXPECT_LT(p.find("r.toml:6"), p.find("r.toml:7"));
}

TEST(Recipe, OtherAlphabetsAreWelcomeInTextsAndComments) {
  const Recipe r = parse_recipe("# \xE5\xB2\xA9\nname = \"\xE9\xA1\xB5\xE5\xB2\xA9\" # \xC3\xA9\n", "r.toml");
  EXPECT_EQ(r.name, "\xE9\xA1\xB5\xE5\xB2\xA9");
  EXPECT_EQ(parse_recipe("name = \"\"\"a \"\xC3\xA9\" b\"\"\"\n", "r.toml").name, "a \"\xC3\xA9\" b");
}

TEST(Recipe, HintsKnowOtherTables) {
  const auto hint = [](const char* word, const char* table) {
    return unknown_key_hint(recipe_schema(), word, table);
  };
  EXPECT_EQ(hint("spacing", "test"), "it belongs to [[bedding]]");
  EXPECT_EQ(hint("name", "test"), "it belongs to the top of the file");
  EXPECT_THAT(hint("beddin", ""), HasSubstr("did you mean \"bedding\"?"));
  EXPECT_THAT(hint("", "matrix"), HasSubstr("--reference"));
}

// Recipes of other tests, and with them fingerprints of stores, are what they were before a test came.
TEST(Recipe, KeysOfOneTestAreWrittenForItAlone) {
  Recipe r;
  r.test.notch_ratio = 0.45;
  EXPECT_EQ(write_recipe(r), write_recipe(Recipe{}));
  EXPECT_EQ(write_recipe(r).find("notch"), std::string::npos);
  r.test.kind = TestKind("semi_circular_bend");
  EXPECT_NE(write_recipe(r).find("notch_ratio = 0.45"), std::string::npos);
  EXPECT_EQ(parse_recipe(write_recipe(r), "r.toml").test.notch_ratio, 0.45);
}

// gap = rdmin, 0.8 of the mean radius, as scripts for PFC have it.
TEST(Recipe, AGapOfBondsIsALength) {
  const Recipe r = parse_recipe(
      "[specimen]\nwidth = \"0.1 m\"\nheight = \"0.2 m\"\n[packing]\nradius_min = \"2 mm\"\n"
      "radius_max = \"3 mm\"\nporosity = 0.16\n[matrix]\nbond_gap = \"2 mm\"\n",
      "r.toml");
  EXPECT_EQ(r.matrix.bond_gap, 0.002);
  EXPECT_THAT(write_recipe(r), HasSubstr("bond_gap = \"2 mm\""));
}

// Laws have no length of their own but the grain's.
TEST(Recipe, AFieldSpecimenIsRead) {
  const Recipe r = parse_recipe(
      "[specimen]\nwidth = \"10 m\"\nheight = \"20 m\"\n[packing]\nradius_min = \"0.025 m\"\n"
      "radius_max = \"0.06625 m\"\nporosity = 0.2\n[[bedding]]\nspacing = \"15 m\"\noffset = \"-12 m\"\n",
      "r.toml");
  EXPECT_EQ(r.specimen.height, 20.0);
  EXPECT_EQ(r.bedding[0].spacing, 15.0);
  EXPECT_THAT(problems_of("[specimen]\nwidth = \"2000 m\"\n"), HasSubstr("0.1 mm <= value <= 1000 m"));
}

// Units as papers, PFC and people from other fields write them, by their definitions.
TEST(Recipe, ReadsTheUnitsOfPapers) {
  const Recipe r = parse_recipe(
      "[specimen]\nwidth = \"50mm\"\nheight = \"10 cm\"\n[packing]\nradius_min = \"210 um\"\n"
      "radius_max = \"350 \u00b5m\"\nporosity = 0.16\n[matrix]\ndensity = \"3.0 t/m3\"\n"
      "E_c = \"22e9 Pa\"\nsigma_c = \"145 psi\"\ntau_c = \"1.5e8 N/m2\"\n[[bedding]]\n"
      "theta = \"30\u00b0\"\nspacing = \"0.5 cm\"\nk_n = \"1e13 N/m3\"\nsigma_n = \"30 N/mm2\"\n"
      "cohesion = \"80 MN/m2\"\n[test]\nplaten_speed = \"5 cm/s\"\n",
      "r.toml");
  EXPECT_EQ(r.packing.radius_max, 350e-6);
  EXPECT_EQ(r.matrix.density, 3000.0);
  EXPECT_NEAR(r.matrix.sigma_c, 145.0 * 4.4482216152605 / (0.0254 * 0.0254), 1e-3) << "pound-force by inch^2";
  EXPECT_EQ(r.matrix.tau_c, 150e6);
  EXPECT_EQ(r.bedding[0].theta, 30.0);
  EXPECT_EQ(r.bedding[0].k_n, 1e13);
  EXPECT_EQ(r.bedding[0].sigma_n, 30e6);
  EXPECT_EQ(r.bedding[0].cohesion, 80e6);
  EXPECT_EQ(r.test.platen_speed, 0.05);
}

TEST(Recipe, PorosityReplacesTheDefaultNumberOfGrains) {
  const Recipe r = parse_recipe("[packing]\nporosity = 0.16\n", "r.toml");
  EXPECT_EQ(r.packing.n_grains, 0);
  EXPECT_EQ(parse_recipe(write_recipe(r), "r.toml").packing.porosity, 0.16);
}

// The parser recurses over nested tables: a hostile file must not reach the end of the stack.
TEST(Recipe, DeepNestingIsRefused) {
  std::string dots, lists(4000, '[');
  for (int i = 0; i < 2000; ++i) dots += "a.";
  EXPECT_THAT(problems_of(dots + "a = 1\n"), HasSubstr("r.toml:1: expected keys of at most 16 full stops"));
  EXPECT_THAT(problems_of("[" + dots + "a]\n" + dots + "a = 1\n"), HasSubstr("r.toml:1"));
  EXPECT_THAT(problems_of("name = " + lists), HasSubstr("r.toml:1"));
  std::string begin = "name = ", end;  // lists of tables of tables, line by line
  for (int i = 0; i < 120; ++i) begin += "[\n{" + dots.substr(0, 3800) + "a = ", end += "}\n]";
  EXPECT_THAT(problems_of(begin + "1" + end), HasSubstr("r.toml:2: expected keys of at most 16 full stops"));
}

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
    refused += problems_of(text) == "no error" ? 0 : 1;
  }
  EXPECT_GT(refused, 100);
}

}  // namespace
}  // namespace phy::io
