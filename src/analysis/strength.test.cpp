#include "analysis/strength.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "analysis/histories_fixture.hpp"

namespace phy::analysis {
namespace {

constexpr double E = 50e9;  // of the marble, by platens

/// n cracks at platen strains from, from + step, ...
std::vector<CrackEvent> cracks_from(double from, double step, std::size_t n) {
  std::vector<CrackEvent> cracks(n);
  for (std::size_t i = 0; i < n; ++i) cracks[i].strain = from + step * static_cast<double>(i);
  return cracks;
}
std::vector<Number> initiation(const History& h, const std::vector<CrackEvent>& cracks, double jump = 0.0) {
  return crack_initiation(loading_branch(h), cracks, jump);
}

TEST(Strength, LargestStressAndItsStrain) {
  const auto numbers = strength(loading_branch(marble()));
  EXPECT_DOUBLE_EQ(value(numbers, "ucs"), 100e6);
  EXPECT_DOUBLE_EQ(value(numbers, "peak_strain"), 0.002);
  EXPECT_EQ(note(numbers, "ucs"), "");
}

TEST(Strength, TheFirstOfTwoEqualPeaksCounts) {
  History h = marble();
  h.rows[220].axial_stress = h.rows[199].axial_stress;
  EXPECT_DOUBLE_EQ(value(strength(loading_branch(h)), "peak_strain"), 0.002);
}

TEST(Strength, ALaterHigherPeakCounts) {
  History h = marble();
  h.rows[220].axial_stress = 110e6;
  EXPECT_DOUBLE_EQ(value(strength(loading_branch(h)), "ucs"), 110e6);
}

TEST(Strength, NoPeakNoStrength) {
  const auto numbers = strength(loading_branch(unfinished()));
  for (const char* name : {"ucs", "peak_strain"}) {
    EXPECT_TRUE(std::isnan(value(numbers, name)));
    EXPECT_EQ(note(numbers, name), "no peak and no knee: the largest stress is 100 MPa");
  }
  const auto rule = strength_rule(loading_branch(unfinished()));
  EXPECT_EQ(value(rule, "strength_rule"), 3.0);
  EXPECT_DOUBLE_EQ(value(rule, "largest_stress"), 100e6);
}

/// The marble up to 100 MPa at 0.002, then 2 % of its modulus up to 101 MPa at 0.003.
History hardening() {
  History h = unfinished();
  for (int i = 1; i <= 100; ++i) {
    HistoryRow r = h.rows[199];
    r.axial_strain += 1e-5 * i, r.axial_stress += 1e4 * i;
    h.rows.push_back(r);
  }
  return h;
}

TEST(Strength, OfATestThatHardensIsItsKneeAndSaysSo) {
  const LoadingBranch branch = loading_branch(hardening());
  const auto numbers = strength(branch), rule = strength_rule(branch);
  EXPECT_NEAR(value(numbers, "ucs"), 100e6, 0.2e6);
  EXPECT_EQ(note(numbers, "ucs"), "a knee, no peak: the axial stress rises to 101 MPa later");
  EXPECT_NE(find(numbers, "ucs")->definition.find("up to the knee"), std::string::npos);
  EXPECT_EQ(find(numbers, "peak_strain")->definition,
            "axial strain of the platens at the knee of the axial stress");
  EXPECT_EQ(value(rule, "strength_rule"), 2.0);
  EXPECT_DOUBLE_EQ(value(rule, "largest_stress"), 101e6);
}

// Only compression hardens behind a knee: a disc that carries more after a bend has its strength at the
// largest load.
TEST(Strength, OtherTestsHaveNoKnee) {
  History h = hardening();
  h.rows.push_back(h.rows.back());
  h.kind = TestKind("brazilian");
  const LoadingBranch branch = loading_branch(h);
  EXPECT_DOUBLE_EQ(value(strength(branch), "bts"), 101e6);
  EXPECT_TRUE(strength_rule(branch).empty());
}

TEST(Strength, OfAFirstPeakThatIsExceededLaterIsThatPeak) {
  History h = marble();
  h.rows.resize(220);  // down to 90 MPa
  for (int i = 1; i <= 200; ++i) {
    HistoryRow r = h.rows[219];
    r.axial_strain += 1e-5 * i, r.axial_stress += 1e5 * i;
    h.rows.push_back(r);
  }
  const LoadingBranch branch = loading_branch(h);
  EXPECT_DOUBLE_EQ(value(strength(branch), "ucs"), 100e6);
  EXPECT_EQ(note(strength(branch), "ucs"), "the first peak: the axial stress rises to 110 MPa later");
  EXPECT_EQ(value(strength_rule(branch), "strength_rule"), 1.0);
}

TEST(Strength, TensionOnlyIsNoCompressionTest) {
  History h = marble();
  for (HistoryRow& r : h.rows) r.axial_stress = -r.axial_stress;
  EXPECT_TRUE(std::isnan(value(strength(loading_branch(h)), "ucs")));
  EXPECT_EQ(note(strength(loading_branch(h)), "ucs"), "the stress never rises above zero");
}

TEST(CrackInitiation,
     TheOnePercentOfManyCracks) {  // 1 % of 1000 is the tenth, of 901 too; of 900 it is the ninth
  const History h = marble();
  EXPECT_NEAR(value(initiation(h, cracks_from(0.0010005, 1e-7, 1000)), "sigma_ci"), E * (0.0010005 + 9e-7),
              1.0);
  EXPECT_NEAR(value(initiation(h, cracks_from(0.0010005, 1e-7, 901)), "sigma_ci"), E * (0.0010005 + 9e-7),
              1.0);
  EXPECT_NEAR(value(initiation(h, cracks_from(0.0010005, 1e-7, 900)), "sigma_ci"), E * (0.0010005 + 8e-7),
              1.0);
}

TEST(CrackInitiation, TheThirdOfFewCracks) {
  const auto numbers = initiation(marble(), cracks_from(0.001, 1e-6, 40));
  EXPECT_NEAR(value(numbers, "sigma_ci"), E * (0.001 + 2e-6), 1.0);
  EXPECT_NEAR(value(numbers, "sigma_first_crack"), E * 0.001, 1.0);
  EXPECT_EQ(note(numbers, "sigma_ci") + note(numbers, "sigma_first_crack"), "");
}

TEST(CrackInitiation, CracksAfterThePeakDoNotCount) {
  auto cracks = cracks_from(0.001, 1e-6, 40);
  const auto after = cracks_from(0.0021, 1e-8, 5000);
  cracks.insert(cracks.end(), after.begin(), after.end());
  EXPECT_NEAR(value(initiation(marble(), cracks), "sigma_ci"), E * (0.001 + 2e-6), 1.0);
}

TEST(CrackInitiation, TheOrderOfTheCracksDoesNotMatter) {
  auto cracks = cracks_from(0.001, 1e-7, 1000);
  const double forwards = value(initiation(marble(), cracks), "sigma_ci");
  std::reverse(cracks.begin(), cracks.end());
  EXPECT_EQ(value(initiation(marble(), cracks), "sigma_ci"), forwards);
}

TEST(CrackInitiation, NoneOrTooFewCracks) {
  const auto none = initiation(marble(), {});
  for (const char* name : {"sigma_ci", "sigma_first_crack"}) {
    EXPECT_TRUE(std::isnan(value(none, name)));
    EXPECT_EQ(note(none, name), "no crack before the peak");
  }
  const auto two = initiation(marble(), cracks_from(0.001, 1e-6, 2));
  EXPECT_TRUE(std::isnan(value(two, "sigma_ci")));
  EXPECT_EQ(note(two, "sigma_ci"), "only 2 of 3 cracks before the peak");
  EXPECT_NEAR(value(two, "sigma_first_crack"), E * 0.001, 1.0);
}

TEST(CrackInitiation, AfterAJumpStartItIsAnUpperBound) {
  History h = marble();
  h.rows.erase(h.rows.begin(), h.rows.begin() + 79);  // first row: 40 MPa at strain 0.0008
  const auto early = initiation(h, cracks_from(0.00079, 1e-6, 40), 0.00079);
  EXPECT_NEAR(value(early, "sigma_ci"), 40e6, 1.0);
  EXPECT_EQ(note(early, "sigma_ci"), "below 40 MPa: the crack came by the end of the affine pre-strain");
  EXPECT_TRUE(find(early, "sigma_ci")->upper_bound);
  EXPECT_EQ(note(early, "sigma_first_crack"),
            "below 40 MPa: the crack came by the end of the affine pre-strain");
  const auto late = initiation(h, cracks_from(0.001, 1e-6, 40), 0.00079);
  EXPECT_NEAR(value(late, "sigma_ci"), E * (0.001 + 2e-6), 1.0);
  EXPECT_EQ(note(late, "sigma_ci"), "");
  EXPECT_FALSE(find(late, "sigma_ci")->upper_bound);
}

TEST(CrackInitiation, RowsWithinTheJumpDoNotHideIt) {  // the history begins before the jump ends at 0.0008
  const auto numbers = initiation(marble(), cracks_from(0.0007, 1e-6, 40), 0.0008);
  EXPECT_NEAR(value(numbers, "sigma_ci"), 40e6, 1.0);
  EXPECT_EQ(note(numbers, "sigma_ci"), "below 40 MPa: the crack came by the end of the affine pre-strain");
}

TEST(CrackInitiation, BeforeTheFirstRow) {
  const auto numbers = initiation(marble(), cracks_from(0.0, 1e-7, 40));
  EXPECT_NEAR(value(numbers, "sigma_ci"), 0.5e6, 1.0);
  EXPECT_EQ(note(numbers, "sigma_ci"), "below 0.5 MPa: the crack came before the first row of the history");
}

TEST(CrackInitiation, AFirstRowWithoutANumberIsNoRow) {
  History h = marble();
  h.rows[0].axial_strain = std::nan("");
  const auto numbers = initiation(h, cracks_from(0.0, 1e-7, 40));
  EXPECT_NEAR(value(numbers, "sigma_ci"), 1e6, 1.0);
  EXPECT_EQ(note(numbers, "sigma_ci"), "below 1 MPa: the crack came before the first row of the history");
  EXPECT_NEAR(value(initiation(h, cracks_from(0.001, 1e-6, 40)), "sigma_ci"), E * (0.001 + 2e-6), 1.0);
  EXPECT_EQ(note(initiation(h, cracks_from(0.001, 1e-6, 40)), "sigma_ci"), "");
}

TEST(CrackInitiation, WithoutAPeakOnlyTheFirstCrackIsKnown) {
  const auto numbers = initiation(unfinished(), cracks_from(0.001, 1e-6, 40));
  EXPECT_TRUE(std::isnan(value(numbers, "sigma_ci")));
  EXPECT_TRUE(note(numbers, "sigma_ci").starts_with("no peak")) << note(numbers, "sigma_ci");
  EXPECT_NEAR(value(numbers, "sigma_first_crack"), E * 0.001, 1.0);
}

TEST(CrackDamage,
     WhereTheVolumeTurns) {  // from row 150 on the lateral strain grows by 2e-5 a row, the axial by 9e-6
  History h = marble();
  for (std::size_t i = 150; i < h.rows.size(); ++i)
    h.rows[i].lateral_strain_gauge -= 2e-5 * static_cast<double>(i - 149);
  const Number n = crack_damage(loading_branch(h));
  EXPECT_EQ(n.value, h.rows[149].axial_stress);
  EXPECT_EQ(n.note, "");
}

TEST(CrackDamage, NoTurnBeforeThePeak) {
  const Number n = crack_damage(loading_branch(marble()));
  EXPECT_TRUE(std::isnan(n.value));
  EXPECT_EQ(n.note, "the volumetric strain does not turn before the largest axial stress");
}

// From row 120 on the lateral strain grows by 6e-6 a row more: the area still shortens (9 - 2.25 - 6 =
// 0.75e-6 a row), the volume of a laboratory no longer does (9 - 4.5 - 12).
TEST(CrackDamage, OfTheVolumeComesBeforeThatOfTheArea) {
  History h = marble();
  for (std::size_t i = 120; i < h.rows.size(); ++i)
    h.rows[i].lateral_strain_gauge -= 6e-6 * static_cast<double>(i - 119);
  EXPECT_EQ(crack_damage_volume(loading_branch(h)).value, h.rows[119].axial_stress);
  EXPECT_EQ(crack_damage_volume(loading_branch(h)).note, "");
  EXPECT_TRUE(std::isnan(crack_damage(loading_branch(h)).value));
}

TEST(CrackDamage, OfTheVolumeAsksForALowPoissonsRatio) {
  for (const double nu : {0.45, 0.48, 0.7}) {
    const Number n = crack_damage_volume(loading_branch(straight(E, nu + 1e-9, 100e6, 200)));
    EXPECT_TRUE(std::isnan(n.value));
    EXPECT_TRUE(n.note.starts_with("nu is not below 0.45: ")) << n.note;
  }
  EXPECT_EQ(crack_damage_volume(loading_branch(straight(E, 0.44, 100e6, 200))).note,
            "the volumetric strain does not turn before the largest axial stress");
  History h = marble();
  for (HistoryRow& r : h.rows) r.lateral_strain_gauge = std::nan("");
  EXPECT_TRUE(crack_damage_volume(loading_branch(h)).note.starts_with("nu is not known: "));
}

TEST(CrackDamage, DilationFromTheStart) {
  const Number n = crack_damage(loading_branch(straight(E, 1.2, 100e6, 200)));
  EXPECT_TRUE(std::isnan(n.value));
  EXPECT_EQ(n.note, "the specimen dilates from the first row on");
}

TEST(CrackDamage, DilationFromTheStartOfAHistoryThatBeginsShortened) {
  History h = straight(E, 1.2, 100e6, 200);
  for (HistoryRow& r : h.rows) r.axial_strain_gauge += 0.001;
  EXPECT_EQ(crack_damage(loading_branch(h)).note, "the specimen dilates from the first row on");
}

TEST(CrackDamage, NoLateralGauge) {
  History h = marble();
  for (HistoryRow& r : h.rows) r.lateral_strain_gauge = std::nan("");
  EXPECT_EQ(crack_damage(loading_branch(h)).note, "the history has no gauge strains");
}

}  // namespace
}  // namespace phy::analysis
