#include "contact/flat_joint.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/exact_math.hpp"
#include "contact/model.hpp"

namespace phy::contact {
namespace {

constexpr ElasticParameter flat_joint_elasticity[] = {
    {"E_c", "Pa", &MatrixRecipe::E_c},
    {"ks_over_kn", "1", &MatrixRecipe::ks_over_kn},
};

class FlatJointModel final : public ContactModel {
  using F = FlatJoint;

 public:
  Size size() const override { return {F::n_fields, F::n_parameters, F::n_geometry, F::most_elements}; }

  bool describes(const MatrixRecipe& m, const std::vector<BeddingRecipe>& bedding) const override {
    return m.model == MatrixModel::flat_joint && !uneven_stiffness(m, bedding);
  }

  bool same_geometry(const MatrixRecipe& one, const MatrixRecipe& other) const override {
    // The number of elements decides which code runs: it cannot differ between lanes.
    return one.elements == other.elements;
  }

  void geometry(const MatrixRecipe& m, double r1, double r2, double* out) const override {
    const double r_min = std::min(r1, r2), factor = laws::linear::stiffness_factor(true, r1, r2);
    out[F::factor] = factor, out[F::inv_factor] = 1.0 / factor;
    out[F::r_min] = r_min, out[F::inv_r_min] = 1.0 / r_min;
    out[F::elements] = static_cast<double>(m.elements);
  }

  void parameters(const Specimen& specimen, std::uint8_t, double* out) const override {
    const MatrixRecipe& m = specimen.matrix;
    out[F::k_n] = m.modulus(), out[F::k_s] = m.ks_over_kn * m.modulus();
    out[F::inv_k_s] = 1.0 / out[F::k_s];
    out[F::lambda] = m.radius_multiplier;
    out[F::mu] = m.unbreakable ? unlimited : m.mu;
    out[F::tan_phi] = m.shear_strength == ShearStrength::constant ? 0.0 : tan_degrees(m.phi);
    out[F::share] = 1.0 / static_cast<double>(m.elements);
    // One more than the law counts: zero has to mean that there is no interface.
    out[F::whole] = 1.0 + all_bonds(m);
    out[F::edge] = m.break_at == BreakAt::edge ? 1.0 : 0.0;
  }

  void idle_parameters(double* out) const override { parameters(Specimen{}, 0, out); }

  void install(const Specimen& s, const Contact& c, double* fields) const override {
    if (c.kind != ContactKind::bonded) return;
    const double length = 2.0 * half_length(s, c);
    // Without strength an interface is a slit from the start, which presses and rubs.
    fields[F::bonds] = 1.0 + (c.sigma_c > 0.0 ? all_bonds(s.matrix) : 0.0);
    fields[F::capacity] = c.sigma_c * length;
    fields[F::shear_capacity] = c.tau_c * length;
    // Free of force at the distance that the discs have now, unless the recipe opens it.
    fields[F::start_gap] = c.gap;
  }

  void meet(double, double, double*) const override {}

  Vec2 normal(const Specimen&, const Contact&, Vec2 branch) const override { return branch; }

  laws::Tangent<double> stiffness(const Specimen& s, const Contact& c, bool) const override {
    const double k_n = s.matrix.modulus() * factor(s, c), R = half_length(s, c);
    // Uniform springs over the length 2R resist rotation by k_n R^2/3; discs that merely touch do not.
    return {k_n, s.matrix.ks_over_kn * k_n, c.kind == ContactKind::bonded ? k_n * (R * R / 3.0) : 0.0};
  }

  /// A slit is either closed or open over its whole length here.
  ElasticPart elastic(const Specimen& s, const Contact& c, double gap) const override {
    constexpr laws::Tangent<double> none{0.0, 0.0, 0.0};
    const bool interface = c.kind == ContactKind::bonded;
    if (interface && c.sigma_c > 0.0) return {none, stiffness(s, c, true)};
    // A slit closes by its own gap, discs by theirs.
    const double closing = interface ? c.gap : gap;
    const bool closed = closing <= touching_gap * 0.5 * (radius_of(s, c.a) + radius_of(s, c.b));
    return {closed ? stiffness(s, c, true) : none, none};
  }

  std::span<const ElasticParameter> elastic_parameters() const override { return flat_joint_elasticity; }

  ElasticPart elastic_rate(const Specimen& s, const Contact& c, double gap,
                           const ElasticParameter& p) const override {
    // All is proportional to E_c; the ratio acts on shear alone.
    const ElasticPart k = elastic(s, c, gap);
    const auto rate = [&](const laws::Tangent<double>& t) -> laws::Tangent<double> {
      const double E = s.matrix.E_c;
      if (p.matrix == &MatrixRecipe::E_c) return {t.k_n / E, t.k_s / E, t.k_m / E};
      if (p.matrix == &MatrixRecipe::ks_over_kn) return {0.0, t.k_n, 0.0};
      return {0.0, 0.0, 0.0};
    };
    return {rate(k.unilateral), rate(k.bilateral)};
  }

  void affine_start(const Standing& c, Vec2 du, double* fields) const override {
    const MatrixRecipe& m = c.specimen.matrix;
    const Vec2 n = (1.0 / norm(c.branch_0)) * c.branch_0;
    const double mu = m.unbreakable ? unlimited : m.mu;
    const double k_n = m.modulus() * c.geometry[F::factor];
    const double S = -m.ks_over_kn * k_n * dot(du, tangent(n));
    const bool interface = fields[F::bonds] > 0.0;
    const double gap = interface ? fields[F::start_gap] : c.gap;
    // What is not bonded carries no more shear than friction allows, from the start on.
    const double limit = mu * k_n * std::max(-dot(du, n) - gap, 0.0), rubbing = std::clamp(S, -limit, limit);
    fields[F::shear] = interface ? S : rubbing;
    if (interface && !unbroken(fields))
      for (std::int64_t e = 0; e < m.elements; ++e)
        // All elements of a slit have slid alike so far.
        fields[F::element_shear + e] = rubbing / static_cast<double>(m.elements);
  }

  bool at_strength(const Standing& c) const override { return unbroken(c.fields) && now(c, 0.0).breaks; }

  bool unbroken(const double* fields) const override { return fields[F::bonds] > 1.0; }

  void describe(const Standing& c, ContactState& out) const override {
    const bool joined = c.original && c.fields[F::capacity] > 0.0;
    out.kind = joined ? ContactKind::bonded : ContactKind::touching;
    out.broken = joined && !unbroken(c.fields);
    out.normal = (1.0 / norm(c.branch)) * c.branch;
    // Asked with unlimited strength: a picture must not break anything.
    const laws::Reaction<double> r = now(c, unlimited).forces;
    out.F_n = r.F_n, out.F_s = r.F_s;
  }

  void crack(const Standing& c, std::size_t part, CrackEvent& out) const override {
    const MatrixRecipe& m = c.specimen.matrix;
    const auto n = static_cast<double>(m.elements);
    const double half = m.radius_multiplier * c.r_min / n;
    out.place = CrackPlace::matrix;
    out.size = 2.0 * half;
    // An element breaks by itself: the crack is where it lies along the interface, not at the contact point.
    out.position = out.position + (2.0 * static_cast<double>(part) + 1.0 - n) * half * tangent(out.normal);
  }

 private:
  static double half_length(const Specimen& s, const Contact& c) {
    return s.matrix.radius_multiplier * std::min(radius_of(s, c.a), radius_of(s, c.b));
  }
  /// k_n 2R over E_c lambda.
  static double factor(const Specimen& s, const Contact& c) {
    return laws::linear::stiffness_factor(true, radius_of(s, c.a), radius_of(s, c.b));
  }

  /// `bonds` of a whole interface, as the law counts them.
  static double all_bonds(const MatrixRecipe& m) {
    return std::ldexp(1.0, static_cast<int>(m.elements)) - 1.0;
  }

  /// A contact asked where it stands, without sliding further.
  struct Now {
    laws::Reaction<double> forces{};
    bool breaks = false;
  };
  Now now(const Standing& c, double extra_strength) const {
    std::array<double, F::n_parameters> p{};
    parameters(c.specimen, 0, p.data());
    const double closure = norm(c.branch_0) - norm(c.branch);
    const auto law =
        F::law<double>(p, c.geometry, c.fields[F::capacity], c.fields[F::shear_capacity], extra_strength);
    Now out;
    // A pair that never was joined, or has left its interface: a linear contact.
    if (!(c.fields[F::bonds] > 0.0)) {
      out.forces.F_n = law.k_n * std::max(closure - c.gap, 0.0), out.forces.F_s = c.fields[F::shear];
      return out;
    }
    const laws::Motion<double> m{closure - c.fields[F::start_gap], 0.0, 0.0, c.rotation};
    F::of_elements(c.geometry, [&]<int N>(F::Elements<N>) {
      laws::flat_joint::State<double, N> s{c.fields[F::bonds] - 1.0, c.fields[F::shear], {}};
      std::copy_n(c.fields + F::element_shear, N, s.S);
      laws::flat_joint::Cracks<double, N> cracks;
      out.forces = laws::flat_joint::respond<N, double>(law, s, m, cracks);
      out.breaks = cracks.some;
    });
    return out;
  }
};

}  // namespace

const ContactModel& FlatJoint::model() {
  static const FlatJointModel model;
  return model;
}

}  // namespace phy::contact
