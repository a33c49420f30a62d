// Files of a whole specimen for PFC2D: everything of it once, and its numbers to the last bit. What PFC2D
// makes of them nobody has seen yet.
#include "report/pfc_specimen.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <charconv>
#include <sstream>

#include "base/check.hpp"
#include "records/assembly.hpp"

namespace phy::report {
namespace {

using testing::HasSubstr;
using testing::Not;

/// Four rows of four discs, a plane of bedding in the middle, strengths that no two bonds share.
Specimen layered(const MatrixRecipe& matrix) {
  Specimen s = assembly(hexagonal(4, 4, 0.1 / 3.0), matrix);
  bond_touching(s);
  BeddingRecipe set;
  set.theta = 0.0, set.spacing = 0.5 * s.packing->height;
  s.bedding = {set};
  joint_crossing(s);
  double strength = 65e6 / 7.0;
  for (Contact& c : s.contacts) c.sigma_c = strength += 1.0 / 3.0, c.tau_c = strength += 1.0 / 3.0;
  s.contacts.front().kind = ContactKind::touching;
  s.name = "theta = 0 deg";
  return s;
}

/// The arguments of every line that begins so, split at commas.
std::vector<std::vector<std::string>> calls(const std::string& text, const std::string& begin) {
  std::vector<std::vector<std::string>> found;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with(begin)) continue;
    std::istringstream arguments(line.substr(begin.size(), line.find(')') - begin.size()));
    found.emplace_back();
    for (std::string word; std::getline(arguments, word, ',');) found.back().push_back(word);
  }
  return found;
}
double number(const std::string& text) {
  double value = -1.0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

TEST(PfcSpecimen, HasEveryDiscOnceToTheLastBit) {
  const Specimen s = layered({});
  std::istringstream text(pfc_specimen({}, s, "x").specimen);
  std::size_t n = 0;
  for (std::string line; std::getline(text, line);) {
    if (!line.starts_with("ball create")) continue;
    std::istringstream words(line);
    std::string word, id, r, x, y;
    words >> word >> word >> word >> id >> word >> r >> word >> x >> word >> y;
    ASSERT_LT(n, s.packing->discs.size());
    const Disc& d = s.packing->discs[n++];
    EXPECT_EQ(id, std::to_string(n));
    EXPECT_EQ(number(r), d.r);
    EXPECT_EQ(number(x), d.x);
    EXPECT_EQ(number(y), d.y);
  }
  EXPECT_EQ(n, s.packing->discs.size());
}

TEST(PfcSpecimen, HasEveryBondAndJointOnceWithItsOwnStrength) {
  Specimen s = layered({});
  for (Contact& c : s.contacts) c.sigma_n = 1.0 + 1e-3 * c.a;
  const std::string text = pfc_specimen({}, s, "x").specimen;
  const auto bonds = calls(text, "[bond("), joints = calls(text, "[joint("),
             marks = calls(text, "[mark_joint(");
  std::size_t b = 0, j = 0;
  for (const Contact& c : s.contacts) {
    const std::string one = std::to_string(c.a + 1), two = std::to_string(c.b + 1);
    if (c.kind == ContactKind::bonded) {
      ASSERT_LT(b, bonds.size());
      const auto& call = bonds[b++];
      EXPECT_EQ(call[0] + " " + call[1], one + " " + two);
      EXPECT_EQ(number(call[2]), c.sigma_c);
      EXPECT_EQ(number(call[3]), c.tau_c);
    }
    if (c.kind == ContactKind::joint) {
      ASSERT_LT(j, joints.size());
      const auto &call = joints[j], &mark = marks[j];
      ++j;
      EXPECT_EQ(call[0] + " " + call[1], one + " " + two);
      EXPECT_EQ(mark[0] + " " + mark[1], one + " " + two);
      EXPECT_EQ(number(call[2]), s.bedding[0].theta);
      EXPECT_EQ(call[3], c.side > 0 ? "1" : "-1");
      EXPECT_EQ(number(call[4]), s.bedding[0].sigma_n * c.sigma_n);
    }
  }
  EXPECT_EQ(b, bonds.size());
  EXPECT_EQ(j, joints.size());
  EXPECT_GT(b, 10U);
  EXPECT_GT(j, 3U);
  EXPECT_THAT(text, HasSubstr(std::to_string(s.packing->discs.size()) + " discs, " + std::to_string(b) +
                              " bonds, " + std::to_string(j) + " joints"));
  EXPECT_THAT(text, HasSubstr("contact.prop(c,'sj_kn') = 3.36e+12"));
}

TEST(PfcSpecimen, WithoutJointsNothingIsSaidOfThem) {
  Specimen s = layered({});
  for (Contact& c : s.contacts) c.kind = ContactKind::bonded;
  EXPECT_THAT(pfc_specimen({}, s, "x").specimen, Not(HasSubstr("smoothjoint range")));
}

TEST(PfcSpecimen, TheTestIsThatOfTheRecipe) {
  Recipe r;
  r.test.platen_speed = 0.05, r.test.stop_at = 0.7, r.test.history_interval = 50, r.test.ramp_strain = 2e-5;
  r.engine.damping = 0.6;
  const Specimen s = layered(r.matrix);
  const PfcFiles files = pfc_specimen(r, s, "theta_0_deg");
  EXPECT_THAT(files.specimen, HasSubstr("damp 0.6"));
  EXPECT_THAT(files.test, HasSubstr("program call 'theta_0_deg-specimen.p2dat'"));
  EXPECT_THAT(files.test, HasSubstr("[speed = 0.05]"));
  EXPECT_THAT(files.test, HasSubstr("[stop_at = 0.7]"));
  EXPECT_THAT(files.test, HasSubstr("model cycle 50"));
  EXPECT_THAT(files.test, HasSubstr("'theta_0_deg-pfc.csv'"));
  for (const std::string& text : {files.specimen, files.test})
    EXPECT_THAT(text, HasSubstr("NOT YET RUN IN PFC2D"));
}

TEST(PfcSpecimen, WhatHasNoPlaceInTheFilesIsRefusedAllAtOnce) {
  EXPECT_NO_THROW(check_pfc_export({}, "r.toml"));
  Recipe r;
  r.matrix.model = MatrixModel::flat_joint;
  r.packing.initial_stress = InitialStress::isotropic;
  r.test.pre_strain = 1e-3;
  r.test.approach_strain = 2e-3, r.test.approach_speed = 1.0;
  try {
    check_pfc_export(r, "r.toml");
    FAIL();
  } catch (const InputError& e) {
    EXPECT_EQ(e.problems().size(), 4U);
    EXPECT_THAT(e.what(), HasSubstr("r.toml"));
  }
}

}  // namespace
}  // namespace phy::report
