// Both sides of every model in the list: what the force loop computes from parameters and geometry has to be
// what stiffnesses, snapshots and the direct solution say.
#include "contact/models.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "contact/direction.hpp"
#include "contact/model.hpp"
#include "contact/wall.hpp"
#include "records/assembly.hpp"

namespace phy::contact {
namespace {

constexpr double R1 = 3e-4, R2 = 5e-4, tiny = 1e-10;

Specimen two_grains(StiffnessConvention convention) {
  MatrixRecipe m;
  m.stiffness_convention = convention;
  m.radius_multiplier = 0.8, m.bond_ks_over_kn = 0.45, m.E_b = 21e9, m.mu = 0.7;
  Specimen s = assembly({{0.0, 0.0, R1}, {R1 + R2, 0.0, R2}}, m);
  bond_touching(s);
  BeddingRecipe set;
  set.theta = 90.0;  // the plane's normal is (-1, 0)
  set.radius_multiplier = 0.9;
  s.bedding = {set};
  return s;
}

/// A contact of the hot side in double, moved by hand.
template <class Model>
struct Moved {
  const Specimen& specimen;
  Contact contact;
  double gap = 0.0;
  std::vector<double> p, g, fields;
  Kinematics<double> motion{1.0, 0.0, 0.0, 0.0, 0.0, R1, R2, 0.0, 0.0};
  Sums<double> sums;
  int n_broken = 0;

  Moved(const Specimen& s, Contact c)
      : specimen(s), contact(c), p(Model::n_parameters), g(Model::n_geometry), fields(Model::n_fields) {
    const ContactModel& model = Model::model();
    model.parameters(s, c.set, p.data());
    model.geometry(s.matrix, R1, R2, g.data());
    model.install(s, c, fields.data());
  }
  /// One step of length 1: closer by `closure`, grain 2 sliding along t = (0, 1), and turning.
  ContactForce<double> step(double closure, double slide, double rotation) {
    motion.stretch -= closure, motion.rotation += rotation;
    motion.vx = -closure, motion.vy = slide;
    const Memory<double, true> memory{fields.data(), true};
    sums = {};
    const double side = contact.kind == ContactKind::joint ? -1.0 : 0.0;
    return Model::template respond<true>(Given{p, g.data()}, memory,
                                         Step<double>{motion, gap, side, 1.0, 0.0}, sums,
                                         [&](bool, bool, double, int) { ++n_broken; });
  }
  Standing standing() const {
    const Vec2 d0{R1 + R2, 0.0};
    return {specimen,
            contact.set,
            contact.kind == ContactKind::joint ? -1.0 : 0.0,
            true,
            R1,
            gap,
            d0,
            {d0.x + motion.stretch, 0.0},
            motion.rotation,
            g.data(),
            fields.data()};
  }
};

template <class Model>
void expect_one_model(const Specimen& s, const Contact& c, int n_cracks = 1) {
  Moved<Model> hot(s, c);
  const ContactForce<double> f = hot.step(1e-8, 2e-10, 3e-7);
  const laws::Tangent<double> k = Model::model().stiffness(s, c, true);
  EXPECT_NEAR(f.fx, k.k_n * 1e-8, tiny * std::fabs(f.fx));
  EXPECT_NEAR(f.fy, -k.k_s * 2e-10, tiny * std::fabs(f.fy));
  EXPECT_NEAR(f.M, -k.k_m * 3e-7, tiny * k.k_m * 3e-7);
  const double energy = 0.5 * (k.k_n * 1e-16 + k.k_s * 4e-20 + k.k_m * 9e-14);
  EXPECT_NEAR(hot.sums.linear + hot.sums.bond + hot.sums.joint, energy, tiny * energy);
  ContactState reported;
  Model::model().describe(hot.standing(), reported);
  EXPECT_NEAR(reported.F_n, f.fx, tiny * std::fabs(f.fx));
  EXPECT_NEAR(reported.F_s, f.fy, tiny * std::fabs(f.fy));
  EXPECT_FALSE(reported.broken);
  EXPECT_NEAR(reported.normal.x, 1.0, 1e-15);
  const ElasticPart parts = Model::model().elastic(s, c, 0.0);
  EXPECT_NEAR(parts.unilateral.k_n + parts.bilateral.k_n, k.k_n, 1e-14 * k.k_n);
  EXPECT_NEAR(parts.unilateral.k_s + parts.bilateral.k_s, k.k_s, 1e-14 * k.k_s);
  EXPECT_NEAR(parts.unilateral.k_m + parts.bilateral.k_m, k.k_m, 1e-14 * k.k_m);
  EXPECT_FALSE(Model::model().at_strength(hot.standing()));
  hot.step(-1.0, 0.0, 0.0);
  EXPECT_EQ(hot.n_broken, n_cracks);
  EXPECT_FALSE(Model::model().unbroken(hot.fields.data()));
}

/// The bond of the two grains in a matrix that is 2.5 times as stiff along its foliation, in a soft layer.
Specimen directional(Specimen s) {
  s.matrix.stiffness_ratio = 2.5;
  s.contacts[0].cos_2a = 0.6, s.contacts[0].layer = 0.7;
  return s;
}

/// The same two grains held by a flat joint of n elements.
Specimen flat_jointed(Specimen s, int n) {
  s.matrix.model = MatrixModel::flat_joint, s.matrix.elements = n;
  return s;
}

TEST(Models, LoopAndFilesAgree) {
  for (const auto convention : {StiffnessConvention::pfc31, StiffnessConvention::pfc5}) {
    const Specimen s = two_grains(convention), d = directional(s);
    Contact c = s.contacts[0];
    expect_one_model<LinearBond>(s, c);
    expect_one_model<UnevenBond>(d, d.contacts[0]);
    c.kind = ContactKind::joint, c.side = -1;
    expect_one_model<SmoothJoint>(s, c);
    for (const int n : {1, 2, 3, 4}) {
      const Specimen f = flat_jointed(s, n);
      expect_one_model<FlatJoint>(f, f.contacts[0], n);
    }
  }
}

void expect_rates_of_the_stiffness(const Specimen& s) {
  const auto total = [](const ElasticPart& p) {
    return p.unilateral.k_n + 3.0 * p.unilateral.k_s + p.bilateral.k_n + 2.0 * p.bilateral.k_s +
           1e7 * p.bilateral.k_m;
  };
  for (const ContactKind kind : {ContactKind::touching, ContactKind::bonded, ContactKind::joint}) {
    Contact c = s.contacts[0];
    c.kind = kind;
    const ContactModel& model = models_of(s).of(kind);
    for (const ElasticParameter& p : model.elastic_parameters()) {
      const auto at = [&](double factor) {
        Specimen moved = s;
        (p.matrix != nullptr ? moved.matrix.*p.matrix : moved.bedding[0].*p.bedding) *= factor;
        return total(model.elastic(moved, c, 0.0));
      };
      const double value = p.matrix != nullptr ? s.matrix.*p.matrix : s.bedding[0].*p.bedding;
      const double rate = total(model.elastic_rate(s, c, 0.0, p)),
                   slope = (at(1.0001) - at(0.9999)) / (0.0002 * value);
      EXPECT_NEAR(rate, slope, 1e-8 * std::fabs(slope)) << p.name;
    }
  }
}

TEST(Models, AJointHasATensileStrengthOfItsOwn) {
  const Specimen s = two_grains(StiffnessConvention::pfc31);
  Contact c = s.contacts[0];
  c.kind = ContactKind::joint, c.side = -1, c.sigma_n = 1.5;
  Moved<SmoothJoint> hot(s, c);
  const double opening = s.bedding[0].sigma_n / s.bedding[0].k_n;  // at the mean strength
  hot.step(-1.49 * opening, 0.0, 0.0);
  EXPECT_EQ(hot.n_broken, 0);
  EXPECT_FALSE(SmoothJoint::model().at_strength(hot.standing()));
  hot.step(-0.02 * opening, 0.0, 0.0);
  EXPECT_EQ(hot.n_broken, 1);
}

// A central difference over each parameter of the recipe that the model says its stiffness depends on.
TEST(Models, RatesAreDerivativesOfTheirStiffness) {
  for (const Specimen& s : {directional(two_grains(StiffnessConvention::pfc5)),
                            flat_jointed(two_grains(StiffnessConvention::pfc31), 3)})
    expect_rates_of_the_stiffness(s);
}

// The affine start leaves a contact where steps would have brought it.
TEST(Models, AffineStartIsWhatOneStepGives) {
  const Specimen s = two_grains(StiffnessConvention::pfc31);
  const auto check = [&]<class Model>(Model, Contact c) {
    Moved<Model> stepped(s, c), placed(s, c);
    stepped.step(4e-8, 3e-8, 0.0);
    std::vector<double> fields = placed.fields;
    Model::model().affine_start(placed.standing(), {-4e-8, 3e-8}, fields.data());
    for (std::size_t i = 0; i < fields.size(); ++i)
      EXPECT_NEAR(fields[i], stepped.fields[i], 1e-12 * std::fabs(fields[i])) << i;
  };
  Contact c = s.contacts[0];
  check(LinearBond{}, c);
  const Specimen d = directional(s);
  Moved<UnevenBond> stepped(d, d.contacts[0]), placed(d, d.contacts[0]);
  stepped.step(4e-8, 3e-8, 0.0);
  std::vector<double> fields = placed.fields;
  UnevenBond::model().affine_start(placed.standing(), {-4e-8, 3e-8}, fields.data());
  for (std::size_t i = 0; i < fields.size(); ++i)
    EXPECT_NEAR(fields[i], stepped.fields[i], 1e-12 * std::fabs(fields[i])) << i;
  c.kind = ContactKind::joint, c.side = -1;
  check(SmoothJoint{}, c);
  for (const double sigma_c : {s.matrix.sigma_c, 0.0}) {  // bonded, and a slit that slips
    Specimen f = flat_jointed(s, 3);
    f.contacts[0].sigma_c = sigma_c;
    Moved<FlatJoint> once(f, f.contacts[0]), start(f, f.contacts[0]);
    once.step(4e-8, 3e-7, 0.0);
    std::vector<double> now = start.fields;
    FlatJoint::model().affine_start(start.standing(), {-4e-8, 3e-7}, now.data());
    for (std::size_t i = 0; i < now.size(); ++i)
      EXPECT_NEAR(now[i], once.fields[i], 1e-12 * std::fabs(now[i])) << i;
  }
}

// Bent until its first element breaks: one crack, at the place where the interface opens most.
TEST(FlatJointModel, BreaksInParts) {
  const Specimen s = flat_jointed(two_grains(StiffnessConvention::pfc31), 4);
  Moved<FlatJoint> hot(s, s.contacts[0]);
  const laws::Tangent<double> k = FlatJoint::model().stiffness(s, s.contacts[0], true);
  const double half = 0.8 * R1, turn = s.matrix.sigma_c * 2.0 * half / (k.k_n * 0.75 * half);
  hot.step(0.0, 0.0, 0.999 * turn);
  EXPECT_EQ(hot.n_broken, 0);
  EXPECT_FALSE(FlatJoint::model().at_strength(hot.standing()));
  Moved<FlatJoint> held = hot;
  held.motion.rotation = 1.001 * turn;
  EXPECT_TRUE(FlatJoint::model().at_strength(held.standing()));
  const ContactForce<double> f = hot.step(0.0, 0.0, 0.002 * turn);
  EXPECT_EQ(hot.n_broken, 1);
  EXPECT_TRUE(FlatJoint::model().unbroken(hot.fields.data())) << "three elements hold";
  ContactState reported;
  FlatJoint::model().describe(hot.standing(), reported);
  EXPECT_NEAR(reported.F_n, f.fx, tiny * f.fx);
  EXPECT_FALSE(reported.broken);
  CrackEvent crack;
  crack.position = {R1, 0.0}, crack.normal = {1.0, 0.0};
  FlatJoint::model().crack(hot.standing(), 0, crack);
  EXPECT_NEAR(crack.position.y, -0.75 * half, 1e-12);
  EXPECT_NEAR(crack.size, 0.5 * half, 1e-12);
}

// Broken, its faces still press, rub and resist rotation. Slid off each other they are a linear contact.
TEST(FlatJointModel, EndsAsALinearContact) {
  const Specimen s = flat_jointed(two_grains(StiffnessConvention::pfc31), 3);
  Moved<FlatJoint> hot(s, s.contacts[0]);
  const laws::Tangent<double> k = FlatJoint::model().stiffness(s, s.contacts[0], true);
  hot.step(-1e-5, 0.0, 0.0);
  hot.step(1e-5 + 2e-8, 0.0, 0.0);
  EXPECT_NEAR(hot.step(0.0, 0.0, 1e-5).M, -k.k_m * 1e-5, tiny);
  const double length = 2.0 * 0.8 * R1;
  double slip = 0.0;
  for (int i = 0; i < 99; ++i) hot.step(0.0, 0.01 * length, 0.0), slip += hot.sums.slip;
  EXPECT_GT(hot.fields[FlatJoint::bonds], 0.0);
  EXPECT_NEAR(slip, 0.7 * k.k_n * 2e-8 * 0.99 * length, 1e-2 * slip);
  const double held = hot.sums.bond;
  const ContactForce<double> f = hot.step(0.0, 0.02 * length, 0.0);
  EXPECT_EQ(hot.fields[FlatJoint::bonds], 0.0);
  EXPECT_NEAR(f.fx, k.k_n * 2e-8, tiny * f.fx);
  EXPECT_NEAR(f.fy, -0.7 * f.fx, tiny * f.fx);
  EXPECT_EQ(f.M, 0.0);
  const double work = 0.7 * f.fx * 0.02 * length;
  EXPECT_NEAR(hot.sums.slip + hot.sums.linear, work + held, 1e-9 * work) << "what it held in bending is lost";
  EXPECT_EQ(hot.sums.bond, 0.0);
}

// An interface that starts open presses after its own gap, however far the discs have overlapped by then.
TEST(FlatJointModel, AGapClosesFirst) {
  Specimen s = flat_jointed(two_grains(StiffnessConvention::pfc31), 2);
  s.contacts[0].sigma_c = s.contacts[0].tau_c = 0.0, s.contacts[0].gap = 1e-7;
  Moved<FlatJoint> hot(s, s.contacts[0]);
  EXPECT_EQ(hot.step(0.9e-7, 0.0, 0.0).fx, 0.0);
  const laws::Tangent<double> k = FlatJoint::model().stiffness(s, s.contacts[0], true);
  EXPECT_NEAR(hot.step(0.2e-7, 0.0, 0.0).fx, k.k_n * 1e-8, 1e-9 * k.k_n * 1e-8);
  EXPECT_EQ(hot.step(-1e-6, 0.0, 0.0).fx, 0.0);
  EXPECT_EQ(hot.n_broken, 0);
  ContactState reported;
  FlatJoint::model().describe(hot.standing(), reported);
  EXPECT_EQ(reported.kind, ContactKind::touching);
  EXPECT_FALSE(reported.broken);
  const ElasticPart part = FlatJoint::model().elastic(s, s.contacts[0], 0.0);
  EXPECT_EQ(part.unilateral.k_n + part.bilateral.k_n, 0.0) << "open to the direct solution";
}

// Lanes in which a pair is no contact hold zeros: they have to mean the plain linear contact.
TEST(Models, APairWithoutMemoryIsTheSameInBoth) {
  const Specimen s = two_grains(StiffnessConvention::pfc31), d = directional(s);
  Contact c = s.contacts[0];
  c.kind = ContactKind::touching, c.cos_2a = 0.0;
  Moved<LinearBond> plain(s, c);
  Moved<UnevenBond> other(d, c);
  other.fields.assign(UnevenBond::n_fields, 0.0);
  for (int i = 0; i < 3; ++i) {
    const ContactForce<double> one = plain.step(3e-8, 2e-8, 1e-7), two = other.step(3e-8, 2e-8, 1e-7);
    EXPECT_EQ(one.fx, two.fx);
    EXPECT_EQ(one.fy, two.fy);
    EXPECT_EQ(plain.sums.slip, other.sums.slip);
  }
}

// A lane in which an interface has left, so that its grains rub as linear contacts, beside a lane whose
// interface is a slit: what it loses by slip is what it loses alone.
TEST(Models, ALinearContactBesideASlitKeepsItsSlip) {
  using R = Pack<double, 2>;
  const Specimen s = flat_jointed(two_grains(StiffnessConvention::pfc31), 3);
  Moved<FlatJoint> alone(s, s.contacts[0]);
  alone.fields.assign(FlatJoint::n_fields, 0.0);
  std::vector<double> p, fields(2 * FlatJoint::n_fields, 0.0);
  for (const double v : alone.p) p.insert(p.end(), {v, v});
  fields[2 * FlatJoint::bonds + 1] = 1.0;  // a slit in lane 1
  Kinematics<R> motion{R(1), R(0), R(0), R(0), R(0), R(R1), R(R2), R(0), R(0)};
  const auto nothing_breaks = [](auto&&...) { ADD_FAILURE(); };
  double slip = 0.0;
  for (int i = 0; i < 3; ++i) {
    alone.step(3e-8, 2e-7, 0.0);
    motion.stretch -= R(3e-8), motion.vx = R(-3e-8), motion.vy = R(2e-7);
    const MaskOf<R> both = R(0) < R(1);
    const Memory<R, true> memory{fields.data(), both};
    const R side(0), dt(1), extra(0);
    Sums<R> sums;
    const Row<R> row{p.data()};
    FlatJoint::respond<true>(Given{row, alone.g.data()}, memory, Step<R>{motion, 0.0, side, dt, extra}, sums,
                             nothing_breaks);
    EXPECT_EQ(sums.slip[0], alone.sums.slip);
    slip += alone.sums.slip;
  }
  EXPECT_GT(slip, 0.0);
}

TEST(Models, OnlyAnUnevenStiffnessTakesTheLineThatPaysForIt) {
  Specimen s;
  EXPECT_EQ(models_of(s).matrix, &LinearBond::model());
  s.matrix.tension_ratio = 3.0, s.matrix.cohesion_oblique = 2.0;
  s.bedding.resize(1);
  s.bedding[0].layer_thickness = 0.001, s.bedding[0].layer_strength = 0.5;
  EXPECT_EQ(models_of(s).matrix, &LinearBond::model());
  s.bedding[0].layer_stiffness = 0.5;
  EXPECT_EQ(models_of(s).matrix, &UnevenBond::model());
  s.bedding.clear();
  s.matrix.stiffness_ratio = 2.0;
  EXPECT_EQ(models_of(s).matrix, &UnevenBond::model());
  s.matrix = {};
  s.matrix.model = MatrixModel::flat_joint;
  for (s.matrix.elements = 1; s.matrix.elements <= 4; ++s.matrix.elements)
    EXPECT_EQ(models_of(s).matrix, &FlatJoint::model());
}

// What the two factors promise: ratios, means over all directions, and the specimen turned by 90 degrees.
TEST(Direction, FactorsHaveTheirRatiosAndTheMeanOne) {
  for (const double r : {0.3, 1.0, 2.5}) {
    EXPECT_NEAR(direction_factor(r, -1.0) / direction_factor(r, 1.0), r, 1e-14);
    EXPECT_NEAR(oblique_factor(r, 0.0) / oblique_factor(r, 1.0), r, 1e-14);
    EXPECT_EQ(oblique_factor(r, 1.0), oblique_factor(r, -1.0));
    double sum = 0.0, product = 0.0;
    for (int i = 0; i < 360; ++i) {
      const double c = std::cos(2.0 * std::numbers::pi * i / 360.0);
      sum += direction_factor(r, c) / 360.0;
      product += direction_factor(r, c) * oblique_factor(1.7, c) / 360.0;
      EXPECT_NEAR(direction_factor(r, c), direction_factor(1.0 / r, -c), 1e-14);
    }
    EXPECT_NEAR(sum, 1.0, 1e-13);
    EXPECT_NEAR(product, 1.0, 1e-13);
  }
  EXPECT_EQ(direction_factor(1.0, 0.37), 1.0);
  EXPECT_EQ(oblique_factor(1.0, 0.37), 1.0);
}

TEST(Wall, RatesAreDerivativesOfItsStiffness) {
  const MatrixRecipe m;
  for (const bool smooth : {true, false})
    for (const ElasticParameter& p : LinearBond::model().elastic_parameters()) {
      MatrixRecipe up = m, down = m;
      up.*p.matrix *= 1.01, down.*p.matrix *= 0.99;
      const laws::Tangent<double> rate = wall::elastic_rate(m, smooth, p), a = wall::elastic(up, smooth),
                                  b = wall::elastic(down, smooth);
      const double step = 0.02 * m.*p.matrix;
      EXPECT_NEAR(rate.k_n, (a.k_n - b.k_n) / step, 1e-9 * std::fabs(rate.k_n));
      EXPECT_NEAR(rate.k_s, (a.k_s - b.k_s) / step, 1e-9 * std::fabs(rate.k_s));
    }
}

}  // namespace
}  // namespace phy::contact
