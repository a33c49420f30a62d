#include "contact/smooth_joint.hpp"

#include <algorithm>
#include <cmath>

#include "base/exact_math.hpp"
#include "contact/model.hpp"

namespace phy::contact {
namespace {

constexpr ElasticParameter joint_elasticity[] = {
    {"k_n", "Pa/m", nullptr, &BeddingRecipe::k_n},
    {"k_s", "Pa/m", nullptr, &BeddingRecipe::k_s},
};

double area_of(const Specimen& s, const Contact& c) {
  const std::vector<Disc>& d = s.packing->discs;
  return laws::smooth_joint::area(s.bedding_of(c.set).radius_multiplier, d[c.a].r, d[c.b].r);
}

class SmoothJointModel final : public ContactModel {
  using F = SmoothJoint;

 public:
  Size size() const override { return {F::n_fields, F::n_parameters, F::n_geometry, 1}; }

  // Any matrix can have bedding in it.
  bool describes(const MatrixRecipe&, const std::vector<BeddingRecipe>&) const override { return true; }

  // Nothing of the recipe is in the geometry: lambda and stiffnesses are parameters.
  bool same_geometry(const MatrixRecipe&, const MatrixRecipe&) const override { return true; }

  void geometry(const MatrixRecipe&, double r1, double r2, double* out) const override {
    out[F::area] = 2.0 * std::min(r1, r2);
  }

  void parameters(const Specimen& specimen, std::uint8_t number, double* out) const override {
    const BeddingRecipe& set = specimen.bedding_of(number);
    const Vec2 n = plane_normal(set.theta);
    // The normal is that of the plane and stays, as in PFC (small strain): grains may then slide into each
    // other along it.
    out[F::nx] = n.x, out[F::ny] = n.y;
    out[F::k_n] = set.k_n * set.radius_multiplier, out[F::k_s] = set.k_s * set.radius_multiplier;
    out[F::mu] = specimen.matrix.unbreakable ? unlimited : set.mu;
    out[F::S_0] = set.cohesion * set.radius_multiplier;
    out[F::tan_phi] = tan_degrees(set.phi), out[F::tan_psi] = tan_degrees(set.psi);
  }

  void idle_parameters(double* out) const override {
    std::fill_n(out, F::n_parameters, 0.0);
    // Ones where the law divides, and a normal of length 1.
    out[F::ny] = out[F::k_n] = out[F::k_s] = out[F::S_0] = 1.0;
  }

  void install(const Specimen& s, const Contact& c, double* fields) const override {
    // c.sigma_n is the drawn strength over its mean: 1 where the recipe has no scatter.
    fields[F::capacity] = s.bedding_of(c.set).sigma_n * c.sigma_n * area_of(s, c);
  }

  void meet(double gap, double F_s, double* fields) const override {
    // Open by the gap between the discs, so that it presses once they touch; an overlap counts as closed, or
    // it would push at once.
    fields[F::closure] = -std::max(gap, 0.0);
    fields[F::shear] = F_s;
  }

  Vec2 normal(const Specimen& s, const Contact& c, Vec2) const override {
    // From the first grain to the second, as the law has it.
    return static_cast<double>(c.side) * plane_normal(s.bedding_of(c.set).theta);
  }

  laws::Tangent<double> stiffness(const Specimen& s, const Contact& c, bool) const override {
    const double A = area_of(s, c);
    return {s.bedding_of(c.set).k_n * A, s.bedding_of(c.set).k_s * A, 0.0};
  }

  ElasticPart elastic(const Specimen& s, const Contact& c, double) const override {
    // A bonded joint pulls as it pushes: all of it is bilateral.
    return {{0.0, 0.0, 0.0}, stiffness(s, c, true)};
  }

  std::span<const ElasticParameter> elastic_parameters() const override { return joint_elasticity; }

  ElasticPart elastic_rate(const Specimen& s, const Contact& c, double,
                           const ElasticParameter& p) const override {
    const double A = area_of(s, c);
    constexpr laws::Tangent<double> none{0.0, 0.0, 0.0};
    if (p.bedding == &BeddingRecipe::k_n) return {none, {A, 0.0, 0.0}};
    if (p.bedding == &BeddingRecipe::k_s) return {none, {0.0, A, 0.0}};
    return {none, none};
  }

  void affine_start(const Standing& c, Vec2 du, double* fields) const override {
    const BeddingRecipe& set = c.specimen.bedding_of(c.set);
    const Vec2 n = c.side * plane_normal(set.theta);
    // Bonded joints slide by elasticity alone; dilation is still zero.
    fields[F::shear] = -set.k_s * set.radius_multiplier * c.geometry[F::area] * dot(du, tangent(n));
    fields[F::closure] = -dot(du, n);
  }

  bool at_strength(const Standing& c) const override {
    if (!unbroken(c.fields)) return false;
    const BeddingRecipe& set = c.specimen.bedding_of(c.set);
    const double A = set.radius_multiplier * c.geometry[F::area];
    const double F_n = set.k_n * A * (c.fields[F::closure] + c.fields[F::dilation]);
    const double S = set.cohesion * A + F_n * tan_degrees(set.phi);
    return -F_n >= c.fields[F::capacity] || std::fabs(c.fields[F::shear]) >= S;
  }

  bool unbroken(const double* fields) const override { return fields[F::capacity] > 0.0; }

  void describe(const Standing& c, ContactState& out) const override {
    const BeddingRecipe& set = c.specimen.bedding_of(c.set);
    const double A = set.radius_multiplier * c.geometry[F::area];
    out.kind = ContactKind::joint;
    out.broken = !unbroken(c.fields);
    out.normal = c.side * plane_normal(set.theta);
    const double g = c.fields[F::closure] + c.fields[F::dilation];
    // Broken it cannot pull.
    out.F_n = set.k_n * A * (out.broken ? std::max(g, 0.0) : g);
    out.F_s = c.fields[F::shear];
  }

  void crack(const Standing& c, std::size_t, CrackEvent& out) const override {
    const BeddingRecipe& set = c.specimen.bedding_of(c.set);
    out.place = CrackPlace::bedding;
    // Of the plane and not of the branch: the crack lies in the bedding.
    out.normal = plane_normal(set.theta);
    out.size = 2.0 * set.radius_multiplier * c.r_min;
  }
};

}  // namespace

const ContactModel& SmoothJoint::model() {
  static const SmoothJointModel model;
  return model;
}

}  // namespace phy::contact
