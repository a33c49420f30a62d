#include "engine/stable_step.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/exact_math.hpp"
#include "contact/wall.hpp"

namespace phy::engine {
namespace {

using Sym3 = std::array<double, 6>;  // xx yy zz xy xz yz

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

Gradient gradient(double sign, double lever, Vec2 branch_t, const ContactStiffness& k, double inv_m,
                  double inv_i) {
  // Row 0 is opening, row 1 slide at the contact point, row 2 relative rotation; the lever turns spin into
  // motion across the branch.
  const Vec2 t = tangent(k.normal);
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

/// A body's contact, on the diagonal block of its grain. `rubs`: the body has friction.
void add_wall(const Specimen& specimen, const Touch& t, bool rubs, Sym3& block) {
  // The body moves as prescribed and is no degree of freedom, so its contact only stiffens the grain:
  // k_n n n^T + k_s s s^T, where s = (t, -sqrt(2)) is the slide per displacement and scaled rotation. Without
  // friction nothing is carried across; what is kept of k_s then lies on the safe side.
  const double k_n = contact::wall::normal_stiffness(specimen.matrix), ratio = specimen.matrix.ks_over_kn;
  const double r = specimen.packing->discs[t.grain].r, mass = specimen.matrix.density * pi * r * r;
  const double xx = t.normal.x * t.normal.x, yy = t.normal.y * t.normal.y;
  block[0] += (xx + ratio * yy) * k_n / mass;
  block[1] += (yy + ratio * xx) * k_n / mass;
  block[2] += 2.0 * ratio * k_n / mass;
  block[3] += (1.0 - ratio) * t.normal.x * t.normal.y * k_n / mass;
  if (!rubs) return;
  const Vec2 across = tangent(t.normal);
  block[4] -= std::sqrt(2.0) * ratio * k_n / mass * across.x;
  block[5] -= std::sqrt(2.0) * ratio * k_n / mass * across.y;
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
                               const Boundary& boundary, double body_friction)
    : packing_(specimen.packing.get()), density_(specimen.matrix.density) {
  const std::size_t n = packing_->discs.size();
  std::vector<Sym3> diagonal(n, Sym3{});
  std::vector<Entry> entries;
  entries.reserve(contacts.size());
  // Diagonal blocks add up over the contacts of a grain; off-diagonal blocks belong to one contact each, and
  // only their norm is needed.
  for (const ContactStiffness& c : contacts) {
    std::array<double, 12> d{};
    const double norm_ab = block_norm(c, d.data(), d.data() + 6);
    for (std::size_t i = 0; i < 6; ++i) diagonal[c.a][i] += d[i], diagonal[c.b][i] += d[6 + i];
    entries.push_back({c.a, c.b, norm_ab});
  }
  std::vector<double> own(n), next(n);
  for (const BoundaryBody& body : boundary.bodies)
    for (const Touch& t : body.touches)
      // Also grains that will touch soon: the bound does not grow when a body reaches them.
      if (t.gap < packing_->discs[t.grain].r)
        add_wall(specimen, t, body.rough && body_friction > 0.0, diagonal[t.grain]);
  for (std::size_t i = 0; i < n; ++i) {
    own[i] = largest_eigenvalue(diagonal[i]);
  }
  x_.assign(n, 1.0);
  row_.assign(n, 0.0);
  bound_ = 0.0;
  // Collatz-Wielandt: max_i (N x)_i/x_i bounds rho(N) for every x > 0, and x <- N x brings it down.
  for (int iteration = 0; iteration < 100; ++iteration) {
    for (std::size_t i = 0; i < n; ++i) next[i] = own[i] * x_[i];
    for (const Entry& e : entries) next[e.a] += e.norm * x_[e.b], next[e.b] += e.norm * x_[e.a];
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
  tight_ = bound_;
}

double FrequencyBound::block_norm(const ContactStiffness& k, double* diag_a, double* diag_b) const {
  const Disc& da = packing_->discs[k.a];
  const Disc& db = packing_->discs[k.b];
  const Vec2 t = tangent(k.branch);
  const double inv_ma = 1.0 / std::sqrt(density_ * pi * da.r * da.r);
  const double inv_mb = 1.0 / std::sqrt(density_ * pi * db.r * db.r);
  // Disc: I = m r^2/2, so 1/sqrt(I) = sqrt(2)/(r sqrt(m)).
  const double root2 = std::sqrt(2.0);
  const Gradient ga = gradient(-1.0, da.r + 0.5 * k.gap, t, k, inv_ma, inv_ma * root2 / da.r);
  const Gradient gb = gradient(1.0, db.r + 0.5 * k.gap, t, k, inv_mb, inv_mb * root2 / db.r);
  const auto put = [](const std::array<std::array<double, 3>, 3>& m, double* out) {
    out[0] = m[0][0], out[1] = m[1][1], out[2] = m[2][2], out[3] = m[0][1], out[4] = m[0][2],
    out[5] = m[1][2];
  };
  put(product(ga, ga, k), diag_a);
  put(product(gb, gb, k), diag_b);
  // Spectral norm of the off-diagonal block: square root of the largest eigenvalue of B^T B.
  return std::sqrt(largest_eigenvalue(gram(product(ga, gb, k))));
}

double FrequencyBound::omega() const { return std::sqrt(bound_); }

void FrequencyBound::add(const ContactStiffness& k) {
  std::array<double, 12> d{};
  const double norm_ab = block_norm(k, d.data(), d.data() + 6);
  const std::uint32_t a = k.a, b = k.b;
  // The trace of what is added to a diagonal block is not less than the growth of its largest eigenvalue.
  const auto trace = [&](std::size_t at) { return d[at] + d[at + 1] + d[at + 2]; };
  row_[a] += trace(0) + norm_ab * x_[b] / x_[a];
  row_[b] += trace(6) + norm_ab * x_[a] / x_[b];
  bound_ = std::max({bound_, row_[a], row_[b]});
}

}  // namespace phy::engine
