// E and nu between platens: against symmetries, derivatives against differences, bad
// specimens.
#include "statics/uniaxial.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "genesis/packing.hpp"
#include "genesis/specimen.hpp"
#include "records/assembly.hpp"

namespace phy::statics {
namespace {

/// About 350 grains in 8 x 16 mm with two or three planes.
Recipe small_recipe() {
  Recipe r;
  r.specimen = {0.008, 0.016};
  r.packing.n_grains = 340;
  r.matrix.bond_ks_over_kn = 0.4;
  r.bedding.push_back({});
  r.bedding[0].rule = BeddingRule::crossing;
  return r;
}

std::shared_ptr<const Packing> small_packing() {
  static const auto packing = [] {
    const Recipe r = small_recipe();
    return std::make_shared<const Packing>(genesis::make_packing(r.specimen, r.packing, r.matrix));
  }();
  return packing;
}

Specimen small_specimen(double theta, double stiffness_ratio = 1.0) {
  Recipe r = small_recipe();
  r.matrix.stiffness_ratio = stiffness_ratio;
  genesis::turn_layers(r.matrix, r.bedding, theta);
  return genesis::make_specimen(small_packing(), r.matrix, r.bedding, "small");
}

/// The same specimen with other discs; keeps contacts and bedding.
Specimen with_discs(Specimen s, const std::function<void(Packing&)>& change) {
  auto packing = std::make_shared<Packing>(*s.packing);
  change(*packing);
  s.packing = std::move(packing);
  return s;
}

const Sensitivity& of(const ElasticResult& r, const std::string& parameter) {
  return *std::find_if(r.sensitivities.begin(), r.sensitivities.end(),
                       [&](const Sensitivity& s) { return s.parameter == parameter; });
}

/// Four columns of ten equal discs, bonded.
Specimen columns(double R) {
  std::vector<Disc> discs;
  for (int j = 0; j < 10; ++j)
    for (int i = 0; i < 4; ++i) discs.push_back({R * (1.0 + 2.0 * i), R * (1.0 + 2.0 * j), R});
  MatrixRecipe m;
  m.E_c = 31e9, m.E_b = 17e9;
  Specimen s = assembly(discs, m);
  bond_touching(s);
  return s;
}

TEST(Uniaxial, SquareLatticeOfColumnsHasTheClosedForm) {
  const Specimen s = columns(1e-3);
  const MatrixRecipe& m = s.matrix;
  const ElasticResult r = solve_uniaxial(s);
  ASSERT_TRUE(r.outcome.ok()) << r.outcome.reason;
  const double K = m.E_c + m.E_b, wall = 2.0 * m.E_c;
  EXPECT_NEAR(r.E_gauge, K, 1e-9 * K);
  EXPECT_NEAR(r.nu_gauge, 0.0, 1e-9);
  const double column = 1.0 / (9.0 / K + 2.0 / wall);  // contacts in series
  EXPECT_NEAR(r.E_platen, column * 10.0, 1e-9 * K);
  EXPECT_EQ(r.n_open, 0);
  EXPECT_EQ(r.n_loose, 0);
}

// Columns of discs through seams of another stiffness: springs in series.
TEST(Uniaxial, SeamsAreSpringsInSeries) {
  constexpr double R = 1e-3;
  Specimen s = columns(R);
  const MatrixRecipe& m = s.matrix;
  const std::vector<Disc>& discs = s.packing->discs;
  s.bedding.resize(1);
  s.bedding[0].layer_thickness = R, s.bedding[0].layer_stiffness = 0.4;
  int n_soft = 0;
  for (Contact& c : s.contacts) {
    const double y = 0.5 * (discs[c.a].y + discs[c.b].y) / R;
    if (y != 4.0 && y != 10.0 && y != 16.0) continue;
    c.layer = 0.4, ++n_soft;
  }
  ASSERT_EQ(n_soft, 12);
  const ElasticResult r = solve_uniaxial(s);
  ASSERT_TRUE(r.outcome.ok()) << r.outcome.reason;
  const double K = m.E_c + m.E_b, column = 1.0 / (6.0 / K + 3.0 / (0.4 * K) + 2.0 / (2.0 * m.E_c));
  EXPECT_NEAR(r.E_platen, column * 10.0, 1e-9 * K);
  ElasticOptions options;
  options.sensitivities = true;
  for (const Sensitivity& d : solve_uniaxial(s, options).sensitivities)
    EXPECT_NE(d.parameter, "matrix.stiffness_ratio") << "there is no foliation";
}

TEST(Uniaxial, ContactsThatWouldPullAreOpen) {
  constexpr double R = 1e-3;
  MatrixRecipe m;
  m.E_c = 31e9, m.E_b = 17e9, m.ks_over_kn = m.bond_ks_over_kn = 0.2;
  Specimen s = assembly(hexagonal(6, 13, R), m);
  bond_touching(s);
  UniaxialStatics statics;
  const ElasticResult one = statics.solve(s);
  ASSERT_TRUE(one.outcome.ok()) << one.outcome.reason;
  EXPECT_GT(one.n_open, 0);
  for (std::size_t i = 0; i < statics.network().links.size(); ++i) {
    const Link& l = statics.network().links[i];
    const double closure = strains(l, statics.movements())[0];
    EXPECT_EQ(statics.active()[i] != 0, closure > 0.0) << l.a << " " << l.b;
    EXPECT_TRUE(statics.active()[i] || std::fabs(l.n.y) < 0.5 || !l.unilateral)
        << "only rows across the load open";
  }
  ElasticOptions both;
  both.bilateral = true;
  const ElasticResult two = solve_uniaxial(s, both);
  EXPECT_EQ(two.n_iterations, 1);
  EXPECT_LT(one.E_gauge, two.E_gauge);
  EXPECT_GT(one.nu_gauge, two.nu_gauge);
}

TEST(Uniaxial, SensitivitiesAreCentralDifferences) {
  struct Case {
    bool bilateral;
    double stiffness_ratio;
  };
  for (const auto& [bilateral, ratio] : {Case{true, 1.0}, Case{false, 1.0}, Case{false, 1.7}}) {
    ElasticOptions options;
    options.bilateral = bilateral;
    const Specimen s = small_specimen(35.0, ratio);
    UniaxialStatics statics;
    const ElasticResult r = statics.solve(s, options);
    ASSERT_TRUE(r.outcome.ok()) << r.outcome.reason;
    const std::vector<char> active = statics.active();
    const auto check = [&](const std::string& name, const std::function<void(Specimen&, double)>& scale) {
      constexpr double h = 1e-4;
      Specimen up = s, down = s;
      scale(up, 1.0 + h), scale(down, 1.0 - h);
      const ElasticResult a = statics.solve_held(up, active, options),
                          b = statics.solve_held(down, active, options);
      const Sensitivity& d = of(r, name);
      EXPECT_NEAR(d.dE * d.value, (a.E_gauge - b.E_gauge) / (2.0 * h), 1e-5 * std::fabs(d.dE * d.value))
          << name;
      EXPECT_NEAR(d.dnu * d.value, (a.nu_gauge - b.nu_gauge) / (2.0 * h), 1e-5 * std::fabs(d.dnu * d.value))
          << name;
      EXPECT_GT(std::fabs(d.dE), 0.0) << name;
    };
    check("matrix.E_c", [](Specimen& x, double f) { x.matrix.E_c *= f; });
    check("matrix.E_b", [](Specimen& x, double f) { x.matrix.E_b *= f; });
    check("matrix.ks_over_kn", [](Specimen& x, double f) { x.matrix.ks_over_kn *= f; });
    check("matrix.bond_ks_over_kn", [](Specimen& x, double f) { x.matrix.bond_ks_over_kn *= f; });
    check("bedding[0].k_n", [](Specimen& x, double f) { x.bedding[0].k_n *= f; });
    check("bedding[0].k_s", [](Specimen& x, double f) { x.bedding[0].k_s *= f; });
    if (ratio != 1.0)
      check("matrix.stiffness_ratio", [](Specimen& x, double f) { x.matrix.stiffness_ratio *= f; });
    const Sensitivity& both = of(r, "ks_over_kn");
    EXPECT_DOUBLE_EQ(both.dE, of(r, "matrix.ks_over_kn").dE + of(r, "matrix.bond_ks_over_kn").dE);
    EXPECT_DOUBLE_EQ(both.dnu, of(r, "matrix.ks_over_kn").dnu + of(r, "matrix.bond_ks_over_kn").dnu);
  }
}

TEST(Uniaxial,
     StiffnessesScaleTheModulusOnly) {  // Euler: E is homogeneous of degree 1 in all moduli, nu of degree 0
  const ElasticResult r = solve_uniaxial(small_specimen(35.0));
  double dE = 0.0, dnu = 0.0;
  for (const char* name : {"matrix.E_c", "matrix.E_b", "bedding[0].k_n", "bedding[0].k_s"})
    dE += of(r, name).dE * of(r, name).value, dnu += of(r, name).dnu * of(r, name).value;
  EXPECT_NEAR(dE, r.E_gauge, 1e-8 * r.E_gauge);
  EXPECT_NEAR(dnu, 0.0, 1e-8);
}

// Of a set that is laid plane by plane: one derivative, for all of its planes.
TEST(Uniaxial, ASetWhosePlanesScatterIsOneParameter) {
  Recipe r = small_recipe();
  r.bedding[0].spacing_sd = 0.2, r.bedding[0].theta_sd = 5.0, r.bedding[0].theta = 35.0;
  const Specimen s = genesis::make_specimen(small_packing(), r.matrix, r.bedding, "scattered");
  ASSERT_GT(s.laid_sets.size(), 3U);
  const ElasticResult answer = solve_uniaxial(s);
  double dE = 0.0;
  for (const Sensitivity& d : answer.sensitivities)
    if (d.parameter != "ks_over_kn" && !d.parameter.ends_with("ks_over_kn")) dE += d.dE * d.value;
  EXPECT_NEAR(dE, answer.E_gauge, 1e-8 * answer.E_gauge);
  EXPECT_GT(of(answer, "bedding[0].k_s").dE, 0.0);
  EXPECT_EQ(answer.sensitivities.back().parameter, "bedding[0].k_s");
}

TEST(Uniaxial, MirrorImageHasTheSameModuli) {
  const Specimen s = small_specimen(30.0);
  Specimen mirror = with_discs(s, [](Packing& p) {
    for (Disc& d : p.discs) d.x = p.width - d.x;
  });
  mirror.bedding[0].theta = 150.0;
  for (Contact& c : mirror.contacts)
    c.side = static_cast<std::int8_t>(-c.side);  // n_j.y turns its sign with theta
  const ElasticResult a = solve_uniaxial(s), b = solve_uniaxial(mirror);
  ASSERT_TRUE(a.outcome.ok() && b.outcome.ok());
  EXPECT_NEAR(a.E_gauge, b.E_gauge, 1e-6 * a.E_gauge);
  EXPECT_NEAR(a.nu_gauge, b.nu_gauge, 1e-6);
}

TEST(Uniaxial, KeptSymbolicPartGivesTheSameBits) {
  UniaxialStatics kept;
  kept.solve(small_specimen(0.0));
  const ElasticResult a = kept.solve(small_specimen(70.0)), b = solve_uniaxial(small_specimen(70.0));
  EXPECT_EQ(a.E_gauge, b.E_gauge);
  EXPECT_EQ(a.nu_gauge, b.nu_gauge);
}

TEST(Uniaxial, ThreadsDoNotMatter) {
  std::vector<Specimen> specimens;
  for (const double theta : {0.0, 30.0, 60.0, 90.0}) specimens.push_back(small_specimen(theta));
  const auto one = solve_all(specimens, {}, 1), three = solve_all(specimens, {}, 3);
  ASSERT_EQ(three.size(), specimens.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].E_gauge, three[i].E_gauge);
    EXPECT_EQ(one[i].sensitivities.back().dnu, three[i].sensitivities.back().dnu);
  }
}

// Solved packing by packing, given back as they were asked for.
TEST(Uniaxial, ResultsKeepTheOrderOfSpecimensOfSeveralPackings) {
  std::vector<Specimen> specimens;
  for (const double theta : {0.0, 30.0, 60.0, 90.0}) {
    specimens.push_back(small_specimen(theta));
    if (specimens.size() % 2 == 0) specimens.back() = with_discs(specimens.back(), [](Packing&) {});
  }
  const std::vector<ElasticResult> all = solve_all(specimens, {}, 2);
  for (std::size_t i = 0; i < specimens.size(); ++i)
    EXPECT_EQ(all[i].E_gauge, solve_uniaxial(specimens[i]).E_gauge) << i;
}

TEST(Uniaxial, GluedPlatensAreStiffer) {
  ElasticOptions glued;
  glued.platens = Platens::glued;
  const Specimen s = small_specimen(60.0);
  EXPECT_GT(solve_uniaxial(s, glued).E_platen, 1.01 * solve_uniaxial(s).E_platen);
}

TEST(Uniaxial, FloatingDiscsAreNamedAndLeftAside) {
  const Specimen s = small_specimen(20.0);
  const auto extra = static_cast<std::uint32_t>(s.packing->discs.size());
  const Specimen more = with_discs(s, [](Packing& p) {
    p.discs.push_back({0.5 * p.width, 0.5 * p.height, 1e-5});
    p.discs.push_back({0.4 * p.width, 0.5 * p.height, 1e-5});
  });
  const ElasticResult a = solve_uniaxial(s), b = solve_uniaxial(more);
  EXPECT_EQ(b.outcome.status, ElasticStatus::solved);
  EXPECT_EQ(b.n_loose, 2);
  EXPECT_EQ(b.outcome.grains, (std::vector<std::uint32_t>{extra, extra + 1}));
  EXPECT_NE(b.outcome.reason.find(std::to_string(extra)), std::string::npos);
  EXPECT_NEAR(a.E_gauge, b.E_gauge, 1e-9 * a.E_gauge);
}

TEST(Uniaxial, UnbondedHalfIsNamed) {
  Specimen s = small_specimen(0.0);
  const double middle = 0.5 * s.packing->height;
  const auto upper = [&](std::uint32_t i) { return s.packing->discs[i].y > middle; };
  std::erase_if(s.contacts, [&](const Contact& c) { return upper(c.a) != upper(c.b); });
  const ElasticResult r = solve_uniaxial(s);
  EXPECT_EQ(r.outcome.status, ElasticStatus::no_load_path);
  EXPECT_GT(r.outcome.grains.size(), 100U);
  const bool first = upper(r.outcome.grains.front());
  for (const std::uint32_t i : r.outcome.grains) EXPECT_EQ(upper(i), first);
  EXPECT_NE(r.outcome.reason.find(std::to_string(r.outcome.grains.front())), std::string::npos);
  EXPECT_TRUE(std::isnan(r.E_gauge) && std::isnan(r.nu_gauge));
}

TEST(Uniaxial, ZeroStiffnessIsNamed) {
  Specimen s = small_specimen(0.0);
  s.matrix.E_c = s.matrix.E_b = 0.0;
  s.bedding[0].k_n = s.bedding[0].k_s = 0.0;
  const ElasticResult r = solve_uniaxial(s);
  EXPECT_EQ(r.outcome.status, ElasticStatus::bad_stiffness);
  EXPECT_EQ(r.outcome.grains.size(), s.packing->discs.size());
  EXPECT_FALSE(r.outcome.reason.empty());
}

TEST(Uniaxial, GrainsThatShareACentreAreNamed) {
  Specimen s = small_specimen(0.0);
  const Contact c = s.contacts[10];
  s = with_discs(s, [&](Packing& p) { p.discs[c.b].x = p.discs[c.a].x, p.discs[c.b].y = p.discs[c.a].y; });
  const ElasticResult r = solve_uniaxial(s);
  EXPECT_EQ(r.outcome.status, ElasticStatus::bad_stiffness);
  EXPECT_EQ(r.outcome.grains, (std::vector<std::uint32_t>{c.a, c.b}));
}

TEST(Uniaxial,
     SlidingPairIsAMechanism) {  // two smooth discs one above the other, aside: they slip past each other
  constexpr double R = 1e-3;
  MatrixRecipe m;
  m.ks_over_kn = 0.0;
  Specimen s = assembly({{R, R, R}, {2.0 * R, R * (1.0 + std::sqrt(3.0)), R}}, m);
  bond_touching(s);
  s.contacts[0].kind = ContactKind::touching;
  const ElasticResult r = solve_uniaxial(s);
  EXPECT_EQ(r.outcome.status, ElasticStatus::mechanism);
  EXPECT_EQ(r.outcome.grains, (std::vector<std::uint32_t>{0, 1}));
}

TEST(Uniaxial, NothingInTheMiddleToReadAStrainFrom) {
  constexpr double R = 1e-3;
  Specimen s = assembly({{R, R, R}, {3.0 * R, R, R}}, MatrixRecipe{});
  bond_touching(s);
  EXPECT_EQ(solve_uniaxial(s).outcome.status, ElasticStatus::no_gauge);
}

TEST(Uniaxial, EmptySpecimen) {
  EXPECT_EQ(solve_uniaxial(assembly({}, MatrixRecipe{})).outcome.status, ElasticStatus::bad_stiffness);
}

TEST(Uniaxial, SaysWhenContactsStillAlternate) {
  ElasticOptions hasty;
  hasty.max_iterations = 1;
  const ElasticResult r = solve_uniaxial(small_specimen(20.0), hasty);
  EXPECT_EQ(r.outcome.status, ElasticStatus::not_converged);
  EXPECT_GT(r.n_alternating, 0);
  EXPECT_TRUE(std::isfinite(r.E_gauge));
}

}  // namespace
}  // namespace phy::statics
