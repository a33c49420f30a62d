// Input for PFC2D: the numbers of the recipe in the other program's terms.
#include "report/pfc_commands.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "report/paper_recipe_fixture.hpp"

namespace phy::report {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(PfcCommands, TranslateRatiosStiffnessesAndTheAngle) {
  const std::string text = pfc_commands(paper());
  EXPECT_THAT(text, HasSubstr("kn 3.8e+10 ks 1.14e+10"));  // PFC 3.1: k_n = E_c t, k_s = 0.3 k_n
  EXPECT_THAT(text,
              HasSubstr("pb_deformability emod 3.8e+10 kratio 3.3333333"));  // kn/ks, the inverse of ours
  EXPECT_THAT(text, HasSubstr("[theta = 30]"));
  EXPECT_THAT(text, HasSubstr("'dip') = 180.0 - theta"));
  EXPECT_THAT(text, HasSubstr("contact.prop(c,'sj_kn') = 3.36e+12"));
  EXPECT_THAT(text, HasSubstr("zone rule"));
}

TEST(PfcCommands, TheGapOfBondsIsPfcs) {
  Recipe r = paper();
  EXPECT_THAT(pfc_commands(r),
              HasSubstr("contact method bond gap 3.325e-10"));  // touching: 1e-6 of 0.3325 mm
  r.matrix.bond_gap = 3.5e-5;
  EXPECT_THAT(pfc_commands(r), HasSubstr("contact method bond gap 3.5e-05 range"));
}

TEST(PfcCommands, FollowTheConventionAndTheRuleOfTheRecipe) {
  Recipe r = paper();
  r.matrix.stiffness_convention = StiffnessConvention::pfc5;
  r.bedding[0].rule = BeddingRule::crossing;
  const std::string text = pfc_commands(r);
  EXPECT_THAT(text, HasSubstr("contact method deformability emod 3.8e+10 kratio 3.3333333"));
  EXPECT_THAT(text, HasSubstr("crossing rule"));
  r.bedding.clear();
  EXPECT_THAT(pfc_commands(r), Not(HasSubstr("smoothjoint")));
}

TEST(PfcCommands, FlatJointsHaveTheirOwnWordsAndJointsLieBetweenThem) {
  Recipe r = paper();
  r.matrix.model = MatrixModel::flat_joint, r.matrix.elements = 3;
  r.matrix.E_c = 76e9, r.matrix.phi = 20.0;
  const std::string text = pfc_commands(r);
  EXPECT_THAT(text, HasSubstr("model flatjoint property fj_nr 3 fj_rmul 1"));
  EXPECT_THAT(text, HasSubstr("deformability emod 7.6e+10 kratio 3.3333333"));
  EXPECT_THAT(text, HasSubstr("fj_fric 0.8 fj_fa 20"));
  EXPECT_THAT(text, HasSubstr("contact.prop(c,'fj_coh') = draw(tau_c,tau_c_sd)"));
  EXPECT_THAT(text,
              HasSubstr("if contact.model(c) = 'flatjoint' then\n        contact.model(c) = 'smoothjoint'"));
  EXPECT_THAT(text, Not(HasSubstr("pb_")));
  EXPECT_THAT(text, Not(HasSubstr("linearpbond")));
}

TEST(PfcCommands, DirectionsActOnWhatTheMatrixHas) {
  Recipe r = paper();
  r.matrix.tension_ratio = 3.0;  // W = -1/2
  EXPECT_THAT(pfc_commands(r), HasSubstr("of_ten = 1.0 + (-0.5)*cos_2a"));
  EXPECT_THAT(pfc_commands(r), HasSubstr("contact.prop(c,'pb_ten') = of_ten*contact.prop(c,'pb_ten')"));
  r.matrix.model = MatrixModel::flat_joint;
  EXPECT_THAT(pfc_commands(r), HasSubstr("contact.prop(c,'fj_ten') = of_ten*contact.prop(c,'fj_ten')"));
  EXPECT_THAT(pfc_commands(r), Not(HasSubstr("pb_")));
}

TEST(PfcCommands, WhatHasNoCommandIsNamed) {
  EXPECT_THAT(pfc_commands(paper()), Not(HasSubstr("NOT IN THIS FILE")));
  Recipe r = paper();
  r.matrix.model = MatrixModel::flat_joint, r.matrix.break_at = BreakAt::edge;
  const std::string text = pfc_commands(r);
  EXPECT_LT(text.find("NOT IN THIS FILE: break_at"), text.find("ball attribute")) << "at the head";
  r.matrix.unbreakable = true;
  r.bedding.clear();
  EXPECT_THAT(pfc_commands(r), HasSubstr("NOT IN THIS FILE: bonds that never break"));
  r = paper();
  r.bedding[0].persistence = 0.7;
  EXPECT_THAT(pfc_commands(r), HasSubstr("NOT IN THIS FILE: bonded patches"));
  r.bedding[0].rule = BeddingRule::oriented;
  EXPECT_THAT(pfc_commands(r), Not(HasSubstr("smoothjoint")));
}

}  // namespace
}  // namespace phy::report
