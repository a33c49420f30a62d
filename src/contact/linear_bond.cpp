#include "contact/linear_bond.hpp"

#include <algorithm>
#include <cmath>

#include "base/exact_math.hpp"
#include "contact/direction.hpp"
#include "contact/model.hpp"

namespace phy::contact {
namespace {

double linear_stiffness_factor(const MatrixRecipe& m, double r1, double r2) {
  return laws::linear::stiffness_factor(m.stiffness_convention == StiffnessConvention::pfc5, r1, r2);
}
/// Potyondy & Cundall (2004) have a constant shear strength; PFC 5 adds the friction of the cement.
double tan_phi_of(const MatrixRecipe& m) {
  return m.shear_strength == ShearStrength::constant ? 0.0 : tan_degrees(m.phi);
}
laws::parallel_bond::Geometry bond_of(const Specimen& s, const Contact& c) {
  return laws::parallel_bond::geometry(s.matrix.radius_multiplier, radius_of(s, c.a), radius_of(s, c.b));
}

constexpr ElasticParameter bond_elasticity[] = {
    {"E_c", "Pa", &MatrixRecipe::E_c},
    {"E_b", "Pa", &MatrixRecipe::E_b},
    {"ks_over_kn", "1", &MatrixRecipe::ks_over_kn, nullptr, "ks_over_kn"},
    {"bond_ks_over_kn", "1", &MatrixRecipe::bond_ks_over_kn, nullptr, "ks_over_kn"},
    {"stiffness_ratio", "1", &MatrixRecipe::stiffness_ratio},  // the last: only of the uneven model
};

/// Of all stiffnesses of a contact.
double stiffness_factor(const Specimen& s, const Contact& c) {
  return direction_factor(s.matrix.stiffness_ratio, c.cos_2a) * c.layer;
}

laws::Tangent<double> operator*(double f, const laws::Tangent<double>& k) {
  return {f * k.k_n, f * k.k_s, f * k.k_m};
}

template <bool uneven>
class LinearBondModel final : public ContactModel {
  using F = LinearBondWith<uneven>;

 public:
  Size size() const override { return {F::n_fields, F::n_parameters, F::n_geometry, 1}; }

  bool describes(const MatrixRecipe& matrix, const std::vector<BeddingRecipe>& bedding) const override {
    return matrix.model == MatrixModel::parallel_bond && (uneven || !uneven_stiffness(matrix, bedding));
  }

  // Specimens share a group where the numbers of their contacts are alike: only the convention of stiffness
  // makes them differ, moduli are parameters.
  bool same_geometry(const MatrixRecipe& one, const MatrixRecipe& other) const override {
    return one.stiffness_convention == other.stiffness_convention;
  }

  void geometry(const MatrixRecipe& m, double r1, double r2, double* out) const override {
    // Moduli and lambda are left out: they are parameters, which lanes may differ in.
    const double r_min = std::min(r1, r2), length = r1 + r2, factor = linear_stiffness_factor(m, r1, r2);
    out[F::linear_factor] = factor, out[F::inv_linear_factor] = 1.0 / factor;
    out[F::bond_factor] = 2.0 * r_min / length;
    out[F::bend_factor] = 2.0 / 3.0 * r_min * r_min * r_min / length;
    out[F::inv_r_min] = 1.0 / r_min;
  }

  void parameters(const Specimen& specimen, std::uint8_t, double* out) const override {
    const MatrixRecipe& m = specimen.matrix;
    const double lambda = m.radius_multiplier;
    out[F::k_n] = m.E_c, out[F::k_s] = m.ks_over_kn * m.E_c, out[F::inv_k_s] = 1.0 / (m.ks_over_kn * m.E_c);
    // The elastic comparison forbids slip as well as cracks, or its answer would not be linear.
    out[F::mu] = m.unbreakable ? unlimited : m.mu;
    out[F::kb_n] = m.E_b * lambda, out[F::kb_s] = m.bond_ks_over_kn * m.E_b * lambda;
    out[F::kb_m] = m.E_b * lambda * lambda * lambda, out[F::arm] = 3.0 * m.moment_contribution / lambda;
    out[F::tan_phi] = tan_phi_of(m);
  }

  // Lanes that hold nothing run the loop all the same: any parameters without zeros to divide by will do.
  void idle_parameters(double* out) const override { parameters(Specimen{}, 0, out); }

  void install(const Specimen& s, const Contact& c, double* fields) const override {
    if (c.kind != ContactKind::bonded) return;
    // Strengths are stresses in the specimen and forces in the loop, which then needs no area.
    const double A = bond_of(s, c).A;
    fields[F::capacity] = c.sigma_c * A;
    fields[F::shear_capacity] = c.tau_c * A;
    // Less one, so that a pair that meets later, with zeroed memory, has the factor 1.
    if constexpr (uneven) fields[F::excess] = stiffness_factor(s, c) - 1.0;
  }

  // A linear contact begins without memory: two grains that meet have not slid yet.
  void meet(double, double, double*) const override {}

  Vec2 normal(const Specimen&, const Contact&, Vec2 branch) const override { return branch; }

  laws::Tangent<double> stiffness(const Specimen& s, const Contact& c, bool unbroken) const override {
    const MatrixRecipe& m = s.matrix;
    const double k_n = m.E_c * linear_stiffness_factor(m, radius_of(s, c.a), radius_of(s, c.b));
    // Grains alone roll on each other freely; only cement resists rotation.
    laws::Tangent<double> k{k_n, m.ks_over_kn * k_n, 0.0};
    if (c.kind == ContactKind::bonded && unbroken) {
      const laws::parallel_bond::Geometry g = bond_of(s, c);
      k.k_n += m.E_b / g.L * g.A;
      k.k_s += m.bond_ks_over_kn * m.E_b / g.L * g.A;
      k.k_m = m.E_b / g.L * g.I;
    }
    return stiffness_factor(s, c) * k;
  }

  ElasticPart elastic(const Specimen& s, const Contact& c, double gap) const override {
    const MatrixRecipe& m = s.matrix;
    const Factors f = factors(s, c, gap);
    // Grains only push, cement also pulls: the direct solution opens the first part and keeps the second.
    const double k_n = m.E_c * f.linear, kb_n = m.E_b * f.bond;
    return {{k_n, m.ks_over_kn * k_n, 0.0}, {kb_n, m.bond_ks_over_kn * kb_n, m.E_b * f.bend}};
  }

  std::span<const ElasticParameter> elastic_parameters() const override {
    return std::span(bond_elasticity).first(std::size(bond_elasticity) - (uneven ? 0 : 1));
  }

  ElasticPart elastic_rate(const Specimen& s, const Contact& c, double gap,
                           const ElasticParameter& p) const override {
    const MatrixRecipe& m = s.matrix;
    const Factors f = factors(s, c, gap);
    constexpr laws::Tangent<double> none{0.0, 0.0, 0.0};
    if (p.matrix == &MatrixRecipe::E_c) return {{f.linear, m.ks_over_kn * f.linear, 0.0}, none};
    if (p.matrix == &MatrixRecipe::E_b) return {none, {f.bond, m.bond_ks_over_kn * f.bond, f.bend}};
    if (p.matrix == &MatrixRecipe::ks_over_kn) return {{0.0, m.E_c * f.linear, 0.0}, none};
    if (p.matrix == &MatrixRecipe::bond_ks_over_kn) return {none, {0.0, m.E_b * f.bond, 0.0}};
    if (p.matrix == &MatrixRecipe::stiffness_ratio) {
      // All stiffnesses of a contact are proportional to its factor, so its logarithmic rate is that of all.
      const ElasticPart k = elastic(s, c, gap);
      const double rate =
          direction_factor_rate(m.stiffness_ratio, c.cos_2a) / direction_factor(m.stiffness_ratio, c.cos_2a);
      return {rate * k.unilateral, rate * k.bilateral};
    }
    return {none, none};
  }

  void affine_start(const Standing& c, Vec2 du, double* fields) const override {
    const MatrixRecipe& m = c.specimen.matrix;
    const Vec2 n = (1.0 / norm(c.branch_0)) * c.branch_0;
    const double slide = dot(du, tangent(n));
    const double closure = -dot(du, n) - c.gap;
    const double factor = remembered_factor(fields);
    const double k_n = m.E_c * c.geometry[F::linear_factor] * factor;
    // Coulomb bounds the start, too: else the first step would release what never was carried.
    const double limit = (m.unbreakable ? unlimited : m.mu) * k_n * std::max(closure, 0.0);
    fields[F::shear] = std::clamp(-m.ks_over_kn * k_n * slide, -limit, limit);
    if (!unbroken(fields)) return;
    // The cement is stress-free at the start whatever the gap, so its shear has no bound but its strength.
    const double kb = m.E_b * m.radius_multiplier * c.geometry[F::bond_factor] * factor;
    fields[F::bond_shear] = -m.bond_ks_over_kn * kb * slide;
  }

  bool at_strength(const Standing& c) const override {
    if (!unbroken(c.fields)) return false;
    const MatrixRecipe& m = c.specimen.matrix;
    const double lambda = m.radius_multiplier;
    const double E_b = m.E_b * remembered_factor(c.fields);
    // The law in closed form from where the grains stand: nothing of a step is needed.
    const double F_n = E_b * lambda * c.geometry[F::bond_factor] * (norm(c.branch_0) - norm(c.branch));
    const double M = E_b * (lambda * lambda * lambda) * c.geometry[F::bend_factor] * std::fabs(c.rotation);
    const double arm = 3.0 * m.moment_contribution / lambda * c.geometry[F::inv_r_min];
    const double S = c.fields[F::shear_capacity] + F_n * tan_phi_of(m);
    return arm * M - F_n >= c.fields[F::capacity] || std::fabs(c.fields[F::bond_shear]) >= S;
  }

  bool unbroken(const double* fields) const override { return fields[F::capacity] > 0.0; }

  void describe(const Standing& c, ContactState& out) const override {
    const MatrixRecipe& m = c.specimen.matrix;
    const double closure = norm(c.branch_0) - norm(c.branch);
    // A broken bond keeps its kind in pictures; a pair that met later never was one.
    out.kind = c.original ? ContactKind::bonded : ContactKind::touching;
    out.broken = c.original && !unbroken(c.fields);
    out.normal = (1.0 / norm(c.branch)) * c.branch;
    out.F_n = m.E_c * c.geometry[F::linear_factor] * std::max(closure - c.gap, 0.0);
    if (unbroken(c.fields)) out.F_n += m.E_b * m.radius_multiplier * c.geometry[F::bond_factor] * closure;
    out.F_n *= remembered_factor(c.fields);
    out.F_s = c.fields[F::shear] + c.fields[F::bond_shear];
  }

  void crack(const Standing& c, std::size_t, CrackEvent& out) const override {
    out.place = CrackPlace::matrix;
    // The length of the cement, which breaks at once over all of it.
    out.size = 2.0 * c.specimen.matrix.radius_multiplier * c.r_min;
  }

 private:
  /// Of all stiffnesses, as the memory of a contact has it.
  static double remembered_factor([[maybe_unused]] const double* fields) {
    if constexpr (uneven) return 1.0 + fields[F::excess];
    return 1.0;
  }
  /// Stiffness over modulus: k_n = E_c linear, kb_n A = E_b bond, kb_n I = E_b bend.
  struct Factors {
    double linear = 0.0, bond = 0.0, bend = 0.0;
  };
  static Factors factors(const Specimen& s, const Contact& c, double gap) {
    const double r1 = radius_of(s, c.a), r2 = radius_of(s, c.b), factor = stiffness_factor(s, c);
    Factors f;
    // Across a gap there is cement and no contact of the grains: only bonds may have one.
    if (gap <= touching_gap * 0.5 * (r1 + r2)) f.linear = factor * linear_stiffness_factor(s.matrix, r1, r2);
    if (c.kind != ContactKind::bonded) return f;
    const laws::parallel_bond::Geometry g = bond_of(s, c);
    f.bond = factor * g.A / g.L, f.bend = factor * g.I / g.L;
    return f;
  }
};

}  // namespace

template <bool uneven>
const ContactModel& LinearBondWith<uneven>::model() {
  static const LinearBondModel<uneven> model;
  return model;
}
template const ContactModel& LinearBondWith<false>::model();
template const ContactModel& LinearBondWith<true>::model();

}  // namespace phy::contact
