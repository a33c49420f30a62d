#include "theory/flat_path.hpp"

#include <algorithm>
#include <cmath>

namespace phy::theory {
namespace {

/// Least value of a convex function on 0 ... 1, by the golden section; its ends are tried as they are.
template <class F>
double least(const F& f) {
  constexpr double golden = 0.6180339887498949;
  double from = 0.0, to = 1.0, x = 1.0 - golden, y = golden, fx = f(x), fy = f(y);
  // The least value may lie at an end, which the section never reaches.
  double best = std::min({f(0.0), f(1.0), fx, fy});
  for (int i = 0; i < 50; ++i) {
    if (fx < fy) {
      to = y, y = x, fy = fx, x = to - golden * (to - from), fx = f(x);
    } else {
      from = x, x = y, fx = fy, y = from + golden * (to - from), fy = f(y);
    }
    best = std::min({best, fx, fy});
  }
  return best;
}

}  // namespace

ExactFlat::ExactFlat(const Interface& whole) {
  // An independent solution by elements: nothing is shared with the law but its definition.
  const double n = whole.elements, h = whole.half_length / n;
  for (int e = 0; e < whole.elements; ++e)
    elements_.push_back({-whole.half_length + (2.0 * e + 1.0) * h,
                         h,
                         {whole.k_n / n,
                          whole.k_s / n,
                          whole.k_n / n * h,
                          whole.edge,
                          whole.S_0 / n,
                          whole.tan_phi,
                          whole.capacity / n,
                          {}},
                         0.0,
                         whole.mu});
}

ContactForces ExactFlat::Element::pressing(const ContactPoint& where) const {
  const double a = where.closure, turn = std::fabs(where.rotation), per_length = bond.k_n / (2.0 * h);
  const double least_closed = a - turn * h, most_closed = a + turn * h;
  if (most_closed <= 0.0) return {};
  // All of it is closed: it answers as if bonded.
  if (least_closed >= 0.0) {
    const double F = bond.k_n * a;
    return {F, 0.0, -(F * x) - per_length * 2.0 / 3.0 * h * h * h * where.rotation};
  }
  // A triangle of pressure over the closed part; it acts a third of its length from the closed end.
  const double length = most_closed / turn, F = per_length * 0.5 * most_closed * length;
  const double where_it_acts = x + std::copysign(h - length / 3.0, where.rotation);
  return {F, 0.0, -F * where_it_acts};
}

/// Slides along `step` unbonded.
void ExactFlat::Element::rub(ContactPoint from, ContactPoint step) {
  const double d = -bond.k_s * step.slide, sense = d < 0.0 ? -1.0 : 1.0;
  const auto limit = [&](double x_now) { return mu * pressing(from + x_now * step).F_n; };
  const auto closed = [&](const ContactPoint& p) { return p.closure >= std::fabs(p.rotation) * h; };
  const bool straight = closed(from) && closed(from + step);  // the limit moves evenly
  const auto extreme = [&](double rate) {
    const auto f = [&](double x_now) { return limit(x_now) + rate * x_now; };
    return straight ? std::min(f(0.0), f(1.0)) : least(f);
  };
  // Play operator: a force driven one way between two limits that move, solved in one piece.
  const double drive = std::fabs(d), pushed = drive - extreme(drive), held = drive + extreme(-drive);
  S = sense * std::min(std::max(sense * S + drive, pushed), held);
}

void ExactFlat::Element::leg(ContactPoint step) {
  step.closure += step.rotation * x;
  double done = 0.0;
  if (bond.capacity > 0.0) {
    if (bond.leg(step, done) == Cement::Breakage::none) return;
    S = bond.forces().F_s;
    bond.capacity = 0.0;
    // The force of the bond is kept as far as friction can.
    const double limit = mu * pressing(bond.at).F_n;
    S = std::clamp(S, -limit, limit);
  }
  const ContactPoint rest = (1.0 - done) * step;
  rub(bond.at, rest);
  bond.at = bond.at + rest;
}

ContactForces ExactFlat::Element::forces() const {
  if (!(bond.capacity > 0.0)) {
    const ContactForces f = pressing(bond.at);
    return {f.F_n, S, f.M};
  }
  const ContactForces f = bond.forces();
  return {f.F_n, f.F_s, -(f.F_n * x) - bond.k_n * h * h / 3.0 * bond.at.rotation};
}

void ExactFlat::leg(ContactPoint step, double) {
  for (Element& e : elements_) e.leg(step);
}

ContactForces ExactFlat::forces() const {
  ContactForces sum;
  for (const Element& e : elements_) {
    const ContactForces f = e.forces();
    sum = {sum.F_n + f.F_n, sum.F_s + f.F_s, sum.M + f.M};
  }
  return sum;
}

}  // namespace phy::theory
