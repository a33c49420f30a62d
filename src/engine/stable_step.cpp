#include "engine/stable_step.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/exact_math.hpp"
#include "contact/wall.hpp"

namespace phy::engine {
namespace {

/// Largest eigenvalue of a positive semi-definite matrix, from above: Newton's method on the characteristic
/// polynomial started at the trace falls monotonically to the largest root.
double largest_eigenvalue(const Sym3& m) {
  // Coefficients of lambda^3 - c2 lambda^2 + c1 lambda - c0. The trace is not below the largest eigenvalue,
  // and beyond the largest root the cubic is convex and rising: Newton's method cannot step past it.
  const double c2 = m[0] + m[1] + m[2];
  const double c1 = m[0] * m[1] + m[0] * m[2] + m[1] * m[2] - m[3] * m[3] - m[4] * m[4] - m[5] * m[5];
  const double c0 = m[0] * (m[1] * m[2] - m[5] * m[5]) - m[3] * (m[3] * m[2] - m[5] * m[4]) +
                    m[4] * (m[3] * m[5] - m[1] * m[4]);
  double root = c2;
  for (int i = 0; i < 40; ++i) {
    const double p = ((root - c2) * root + c1) * root - c0;
    const double slope = (3.0 * root - 2.0 * c2) * root + c1;
    if (!(p > 0.0) || !(slope > 0.0)) break;
    const double next = root - p / slope;
    if (!(next < root)) break;
    root = next;
  }
  // Rounding may leave the iterate slightly below the root; the result has to be an upper bound.
  return root * (1.0 + 1e-9);
}

/// Rows: normal, shear, bending; columns: u_x, u_y, rotation, scaled by 1/sqrt(m), 1/sqrt(I).
using Gradient = std::array<std::array<double, 3>, 3>;

/// One of the two grains of a contact.
struct Side {
  double sign;          // -1: the first, 1: the second
  double lever;         // from its centre to the contact [m]
  double inv_m, inv_i;  // 1/sqrt(m), 1/sqrt(I)
};

Gradient gradient(const Side& side, const ContactStiffness& k) {
  const auto [sign, lever, inv_m, inv_i] = side;
  // Row 0 is opening, row 1 slide at the contact point, row 2 relative rotation; the lever turns spin into
  // motion across the branch.
  const Vec2 t = tangent(k.normal), branch_t = tangent(k.branch);
  return {{{sign * k.normal.x * inv_m, sign * k.normal.y * inv_m, -lever * dot(k.normal, branch_t) * inv_i},
           {sign * t.x * inv_m, sign * t.y * inv_m, -lever * dot(t, branch_t) * inv_i},
           {0.0, 0.0, sign * inv_i}}};
}

std::array<std::array<double, 3>, 3> product(const Gradient& a, const Gradient& b,
                                             const ContactStiffness& of) {
  const laws::Tangent<double>& k = of.k;
  const std::array<double, 3> d = {k.k_n, k.k_s, k.k_m};
  std::array<std::array<double, 3>, 3> m{};
  // a^T K b, the stiffness between two grains (or of one grain with itself).
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t q = 0; q < 3; ++q) m[i][j] += a[q][i] * d[q] * b[q][j];
  if (!k.coupled()) return m;
  // Row 0 measures opening, the tangent closure: couplings with it change their sign.
  const auto couple = [&](std::size_t p, std::size_t q, double c) {
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) m[i][j] += c * (a[p][i] * b[q][j] + a[q][i] * b[p][j]);
  };
  couple(0, 1, -k.k_ns), couple(0, 2, -k.k_nm), couple(1, 2, k.k_sm);
  return m;
}

Sym3 gram(const std::array<std::array<double, 3>, 3>& b) {
  const auto entry = [&](std::size_t i, std::size_t j) {
    return b[0][i] * b[0][j] + b[1][i] * b[1][j] + b[2][i] * b[2][j];
  };
  return {entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(0, 2), entry(1, 2)};
}

/// A body's contact, for the diagonal block of its grain. `rubs`: the body has friction.
Sym3 wall_block(const Specimen& specimen, const Inertia& inertia, const Touch& t, bool rubs) {
  // The body moves as prescribed and is no degree of freedom, so its contact only stiffens the grain:
  // k_n n n^T + k_s s s^T, where s = (t, -sqrt(m r^2/I)) is the slide per displacement and scaled rotation.
  // Without friction nothing is carried across; what is kept of k_s then lies on the safe side.
  const double k_n = contact::wall::normal_stiffness(specimen.matrix), ratio = specimen.matrix.ks_over_kn;
  const double mass = inertia.mass(t.grain, specimen.matrix.density), round = inertia.roundness();
  const double xx = t.normal.x * t.normal.x, yy = t.normal.y * t.normal.y;
  const Vec2 across = tangent(t.normal);
  const double turning = rubs ? std::sqrt(round) * ratio * k_n / mass : 0.0;
  return {(xx + ratio * yy) * k_n / mass,
          (yy + ratio * xx) * k_n / mass,
          round * ratio * k_n / mass,
          (1.0 - ratio) * t.normal.x * t.normal.y * k_n / mass,
          -turning * across.x,
          -turning * across.y};
}

void add_to(Sym3& to, const Sym3& block, double factor = 1.0) {
  for (std::size_t i = 0; i < 6; ++i) to[i] += factor * block[i];
}

}  // namespace

ContactStiffness stiffness_of(const contact::Models& models, const Specimen& specimen, const Contact& contact,
                              Vec2 branch, bool unbroken) {
  const contact::ContactModel& model = models.of(contact.kind);
  return {contact.a,
          contact.b,
          model.stiffness(specimen, contact, unbroken),
          model.normal(specimen, contact, branch),
          branch,
          0.0};
}

std::vector<ContactStiffness> initial_stiffnesses(const contact::Models& models, const Specimen& specimen) {
  std::vector<ContactStiffness> all;
  for (const Contact& c : specimen.contacts) all.push_back(initial_stiffness(models, specimen, c));
  return all;
}

ContactStiffness initial_stiffness(const contact::Models& models, const Specimen& specimen,
                                   const Contact& contact) {
  const Disc& a = specimen.packing->discs[contact.a];
  const Disc& b = specimen.packing->discs[contact.b];
  const Vec2 centres{b.x - a.x, b.y - a.y};
  const double distance = norm(centres);
  ContactStiffness k = stiffness_of(models, specimen, contact, (1.0 / distance) * centres);
  k.gap = distance - a.r - b.r;
  return k;
}

FrequencyBound::FrequencyBound(const Specimen& specimen, const std::vector<ContactStiffness>& contacts,
                               const Inertia& inertia, const Boundary& boundary, double body_friction)
    : packing_(specimen.packing.get()), inertia_(inertia), density_(specimen.matrix.density) {
  renew(specimen, contacts, boundary, body_friction);
}

void FrequencyBound::renew(const Specimen& specimen, const std::vector<ContactStiffness>& contacts,
                           const Boundary& boundary, double body_friction) {
  std::vector<OfBody> bodies;
  for (const BoundaryBody& body : boundary.bodies)
    for (const Touch& t : body.touches)
      // Also grains that will touch soon: the bound does not grow when a body reaches them.
      if (t.gap < packing_->discs[t.grain].r)
        bodies.push_back({t.grain, wall_block(specimen, inertia_, t, body.rough && body_friction > 0.0)});
  std::vector<Blocks> blocks;
  blocks.reserve(contacts.size());
  for (const ContactStiffness& c : contacts) blocks.push_back(blocks_of(c));
  if (inertia_.kind() == GrainInertia::equal) {
    bound_by_tensors(blocks, bodies);
  } else {
    bound_by_norms(blocks, bodies);
  }
  tight_ = bound_;
}

void FrequencyBound::bound_by_norms(const std::vector<Blocks>& contacts, const std::vector<OfBody>& bodies) {
  const std::size_t n = packing_->discs.size();
  // Diagonal blocks add up over the contacts of a grain; off-diagonal blocks belong to one contact each, and
  // only their norm is needed.
  std::vector<Sym3> diagonal(n, Sym3{});
  for (const Blocks& c : contacts) add_to(diagonal[c.a], c.of_a), add_to(diagonal[c.b], c.of_b);
  for (const OfBody& b : bodies) add_to(diagonal[b.grain], b.block);
  std::vector<double> own(n), next(n);
  for (std::size_t i = 0; i < n; ++i) own[i] = largest_eigenvalue(diagonal[i]);
  x_.assign(n, 1.0);
  row_.assign(n, 0.0);
  bound_ = 0.0;
  // Collatz-Wielandt: max_i (N x)_i/x_i bounds rho(N) for every x > 0, and x <- N x brings it down.
  for (int iteration = 0; iteration < 100; ++iteration) {
    for (std::size_t i = 0; i < n; ++i) next[i] = own[i] * x_[i];
    for (const Blocks& c : contacts) next[c.a] += c.norm_ab * x_[c.b], next[c.b] += c.norm_ab * x_[c.a];
    double top = 0.0, largest = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      row_[i] = next[i] / x_[i];
      top = std::max(top, row_[i]);
      largest = std::max(largest, next[i]);
    }
    // Every tenth iteration: done if the last one has lowered the bound by less than 0.1 %.
    if (iteration > 0 && top > 0.999 * bound_ && iteration % 10 == 0) {
      bound_ = top;
      break;
    }
    bound_ = top;
    if (iteration + 1 <
        100)  // grains far from the hot spot keep a floor, so that later contacts stay bounded
      for (std::size_t i = 0; i < n; ++i) x_[i] = std::max(next[i] / largest, 1e-3);
  }
}

void FrequencyBound::bound_by_tensors(const std::vector<Blocks>& contacts,
                                      const std::vector<OfBody>& bodies) {
  constexpr double floor = 1e-3;  // as above
  const std::size_t n = packing_->discs.size();
  // A bound that is renewed goes on from its last witness: few contacts have changed.
  const int n_iterations = x_.empty() ? 10 : 3;
  std::vector<double> x = x_.empty() ? std::vector<double>(n, 1.0) : x_, row(n);
  for (int iteration = 0; iteration < n_iterations; ++iteration) {
    std::vector<Sym3> diagonal(n, Sym3{});
    for (const OfBody& b : bodies) add_to(diagonal[b.grain], b.block);
    for (const Blocks& c : contacts) {
      const double ratio = x[c.b] / x[c.a];
      add_to(diagonal[c.a], c.of_a, 1.0 + ratio), add_to(diagonal[c.b], c.of_b, 1.0 + 1.0 / ratio);
    }
    for (std::size_t i = 0; i < n; ++i) row[i] = largest_eigenvalue(diagonal[i]);
    const double top = *std::max_element(row.begin(), row.end());
    if (iteration == 0 || top < bound_) bound_ = top, x_ = x, diagonal_.swap(diagonal);
    double largest = 0.0;
    for (std::size_t i = 0; i < n; ++i) largest = std::max(largest, x[i] *= std::max(row[i] / top, floor));
    for (double& value : x) value = std::max(value / largest, floor);
  }
}

FrequencyBound::Blocks FrequencyBound::blocks_of(const ContactStiffness& k) const {
  const double r_a = packing_->discs[k.a].r, r_b = packing_->discs[k.b].r;
  const double inv_ma = 1.0 / std::sqrt(inertia_.mass(k.a, density_));
  const double inv_mb = 1.0 / std::sqrt(inertia_.mass(k.b, density_));
  // 1/sqrt(I) = sqrt(m r^2/I)/(r sqrt(m)).
  const double root = std::sqrt(inertia_.roundness());
  const Gradient ga = gradient({-1.0, r_a + 0.5 * k.gap, inv_ma, inv_ma * root / r_a}, k);
  const Gradient gb = gradient({1.0, r_b + 0.5 * k.gap, inv_mb, inv_mb * root / r_b}, k);
  const auto symmetric = [](const std::array<std::array<double, 3>, 3>& m) {
    return Sym3{m[0][0], m[1][1], m[2][2], m[0][1], m[0][2], m[1][2]};
  };
  Blocks blocks{k.a, k.b, symmetric(product(ga, ga, k)), symmetric(product(gb, gb, k)), 0.0};
  // Spectral norm of the off-diagonal block: square root of the largest eigenvalue of B^T B.
  if (inertia_.kind() != GrainInertia::equal)
    blocks.norm_ab = std::sqrt(largest_eigenvalue(gram(product(ga, gb, k))));
  return blocks;
}

double FrequencyBound::omega() const { return std::sqrt(bound_); }

void FrequencyBound::add(const ContactStiffness& k) {
  const Blocks c = blocks_of(k);
  if (inertia_.kind() == GrainInertia::equal) {
    const double ratio = x_[c.b] / x_[c.a];
    add_to(diagonal_[c.a], c.of_a, 1.0 + ratio), add_to(diagonal_[c.b], c.of_b, 1.0 + 1.0 / ratio);
    bound_ = std::max({bound_, largest_eigenvalue(diagonal_[c.a]), largest_eigenvalue(diagonal_[c.b])});
    return;
  }
  // The trace of what is added to a diagonal block is not less than the growth of its largest eigenvalue.
  const auto trace = [](const Sym3& block) { return block[0] + block[1] + block[2]; };
  row_[c.a] += trace(c.of_a) + c.norm_ab * x_[c.b] / x_[c.a];
  row_[c.b] += trace(c.of_b) + c.norm_ab * x_[c.a] / x_[c.b];
  bound_ = std::max({bound_, row_[c.a], row_[c.b]});
}

}  // namespace phy::engine
