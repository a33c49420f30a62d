// A contact model that exists only here: a linear contact whose grains also resist rolling on each other
// (Iwashita & Oda 1998, J. Eng. Mech. 124:285-292): a couple M = -k_r rotation, bounded by mu_r r_min F_n.
// It shows what a model of one's own costs: this file, given to a group or a network as an argument. Its
// parameters are constants, for it has no recipe.
#pragma once
#include <algorithm>
#include <cmath>

#include "contact/model.hpp"
#include "contact/models.hpp"
#include "laws/linear/linear.hpp"

namespace phy::contact {

struct Rolling {
  enum Field { shear, couple, turned, n_fields };  // turned: rotation of the last step
  enum Parameter { k_n, k_s, inv_k_s, mu, k_r, n_parameters };
  enum Geometry { inv_r_min, reach, n_geometry };    // reach: mu_r r_min
  static constexpr double rolling_stiffness = 50.0;  // [N]
  static constexpr double rolling_friction = 0.2;
  static const ContactModel& model();

  template <bool sample, class R, class P, class G, class Memory, class Broke>
  PHY_HOT static ContactForce<R> respond(const Given<P, G>& given, const Memory& memory, const Step<R>& step,
                                         Sums<R>& sums, const Broke&) {
    const auto& [p, g] = given;
    const Kinematics<R>& k = step.motion;
    const R d_slide = (k.vy * k.nx - k.vx * k.ny) * step.dt, closure = -(k.stretch + step.gap);
    const laws::linear::Parameters<R> law{p[k_n], p[k_s], p[inv_k_s], p[mu]};
    laws::linear::State<R> state{memory.load(shear)};
    const laws::Reaction<R> r =
        laws::linear::respond(law, state, laws::Motion<R>{closure, R(0), d_slide, R(0)});
    const R last = memory.load(turned);  // 0: they did not press on each other, their rolling counts from now
    const R rolled = select(abs(last) > R(0), k.rotation - last, R(0));
    const R before = memory.load(couple), trial = before - p[k_r] * rolled;
    const R M = clip(trial, R(g[reach]) * r.F_n);
    memory.store(shear, state.F_s);
    memory.store(couple, M);
    memory.store(turned, select(r.F_n > R(0), k.rotation, R(0)));
    sums.slip += memory.only_here(r.dissipated + R(0.5f) * (before + M) * (trial - M) / p[k_r], R(0));
    if constexpr (sample) {
      sums.linear +=
          memory.only_here(laws::linear::strain_energy(law, r.F_n, r.F_s) + R(0.5f) * M * M / p[k_r], R(0));
      sums.overlap = max(sums.overlap, memory.only_here(closure * R(g[inv_r_min]), R(0)));
    }
    return {r.F_n * k.nx - r.F_s * k.ny, r.F_n * k.ny + r.F_s * k.nx, M};
  }
};

class RollingModel final : public ContactModel {
  using F = Rolling;

 public:
  Size size() const override { return {F::n_fields, F::n_parameters, F::n_geometry, 0}; }
  bool describes(const MatrixRecipe&, const std::vector<BeddingRecipe>&) const override { return true; }
  bool same_geometry(const MatrixRecipe&, const MatrixRecipe&) const override { return true; }
  void geometry(const MatrixRecipe&, double r1, double r2, double* out) const override {
    out[F::inv_r_min] = 1.0 / std::min(r1, r2), out[F::reach] = F::rolling_friction * std::min(r1, r2);
  }
  void parameters(const Specimen& s, std::uint8_t, double* out) const override {
    const MatrixRecipe& m = s.matrix;
    out[F::k_n] = m.E_c, out[F::k_s] = m.ks_over_kn * m.E_c, out[F::inv_k_s] = 1.0 / out[F::k_s];
    out[F::mu] = m.mu, out[F::k_r] = F::rolling_stiffness;
  }
  void idle_parameters(double* out) const override { parameters(Specimen{}, 0, out); }
  void install(const Specimen&, const Contact&, double*) const override {}
  void meet(double, double, double*) const override {}
  Vec2 normal(const Specimen&, const Contact&, Vec2 branch) const override { return branch; }
  laws::Tangent<double> stiffness(const Specimen& s, const Contact&, bool) const override {
    return {s.matrix.E_c, s.matrix.ks_over_kn * s.matrix.E_c, F::rolling_stiffness};
  }
  ElasticPart elastic(const Specimen& s, const Contact& c, double) const override {
    return {stiffness(s, c, true), {0.0, 0.0, 0.0}};
  }
  std::span<const ElasticParameter> elastic_parameters() const override { return {}; }
  ElasticPart elastic_rate(const Specimen&, const Contact&, double, const ElasticParameter&) const override {
    return {{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}};
  }
  void affine_start(const Standing&, Vec2, double*) const override {}
  bool at_strength(const Standing&) const override { return false; }
  bool unbroken(const double*) const override { return false; }
  void describe(const Standing& c, ContactState& out) const override {
    out.normal = (1.0 / norm(c.branch)) * c.branch;
    out.F_n = c.specimen.matrix.E_c * std::max(norm(c.branch_0) - norm(c.branch) - c.gap, 0.0);
    out.F_s = c.fields[F::shear];
  }
  void crack(const Standing&, std::size_t, CrackEvent&) const override {}
};

inline const ContactModel& Rolling::model() {
  static const RollingModel model;
  return model;
}

}  // namespace phy::contact
