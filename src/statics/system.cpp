#include "statics/system.hpp"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "base/check.hpp"

namespace phy::statics {
namespace {

using Matrix = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;

std::size_t number(const Freedom& f) {
  return 3 * std::size_t{f.body} + static_cast<std::size_t>(f.component);
}

std::array<std::size_t, 6> freedoms(const Link& l) {
  const std::size_t a = 3 * std::size_t{l.a}, b = 3 * std::size_t{l.b};
  return {a, a + 1, a + 2, b, b + 1, b + 2};
}

/// Order of elimination of the bodies: approximate minimum degree on the graph of bodies with free movements.
std::vector<std::int32_t> elimination_order(const Network& net, const std::vector<char>& free_body) {
  std::vector<Eigen::Triplet<double, int>> entries;
  const int n = static_cast<int>(net.x.size());
  for (int i = 0; i < n; ++i) entries.emplace_back(i, i, 1.0);
  for (const Link& l : net.links) {
    if (!free_body[l.a] || !free_body[l.b]) continue;
    entries.emplace_back(static_cast<int>(l.a), static_cast<int>(l.b), 1.0);
    entries.emplace_back(static_cast<int>(l.b), static_cast<int>(l.a), 1.0);
  }
  Matrix graph(n, n);
  graph.setFromTriplets(entries.begin(), entries.end());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order;
  Eigen::AMDOrdering<int>()(graph, order);
  return {order.indices().data(), order.indices().data() + n};
}

bool sound(double k) { return k >= 0.0 && std::isfinite(k); }
bool sound(const laws::Tangent<double>& k) {
  return sound(k.k_n) && sound(k.k_s) && sound(k.k_m) && std::isfinite(k.k_ns + k.k_nm + k.k_sm);
}

ElasticOutcome bad(std::string reason, std::vector<std::uint32_t> grains) {
  return {ElasticStatus::bad_stiffness, std::move(reason), "check moduli, stiffness ratios and the discs",
          std::move(grains)};
}

/// Negative, not finite or all zero: no matrix is made of these.
ElasticOutcome check_stiffness(const Network& net, const std::vector<laws::Tangent<double>>& k) {
  double largest = 0.0;
  for (std::size_t i = 0; i < k.size(); ++i) {
    const Link& l = net.links[i];
    const bool fine = sound(k[i]) && std::isfinite(dot(l.branch, l.branch)) && std::isfinite(l.arm_a) &&
                      std::isfinite(l.arm_b);
    if (!fine)
      return bad("the contact of grains " + std::to_string(l.a) + " and " + std::to_string(l.b) +
                     " has a negative or infinite stiffness, or its grains share a centre",
                 {l.a, l.b});
    largest = std::max({largest, k[i].k_n, k[i].k_s});
  }
  if (largest > 0.0) return {};
  std::vector<std::uint32_t> all(net.n_grains);
  for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = i;
  return bad("no contact has any stiffness: all grains, 0 to " + std::to_string(net.n_grains) +
                 " (excluded), are loose",
             std::move(all));
}

}  // namespace

StiffnessSystem::StiffnessSystem(const Network& net, std::vector<Freedom> prescribed)
    : prescribed_(std::move(prescribed)) {
  std::vector<char> given(3 * net.x.size(), 0), free_body(net.x.size(), 0);
  for (const Freedom& f : prescribed_) {
    PHY_CHECK(f.body < net.x.size() && f.component >= 0 && f.component < 3,
              "a movement of a body is prescribed");
    given[number(f)] = 1;
  }
  for (std::size_t i = 0; i < given.size(); ++i)
    if (!given[i]) free_body[i / 3] = 1;
  equation_.assign(given.size(), -1);
  std::int32_t n = 0;
  for (const std::int32_t body : elimination_order(net, free_body))
    for (std::size_t f = 3 * static_cast<std::size_t>(body), end = f + 3; f < end; ++f)
      if (!given[f]) equation_[f] = n++;
  for (const Link& l : net.links) pairs_.push_back(l.a), pairs_.push_back(l.b);
  diagonal_.resize(static_cast<std::size_t>(n));
  factor_ = SparseCholesky(place_coefficients(net));
}

// Upper triangle by columns: entry (i, j), i <= j, has the key j * 2^32 + i.
SymmetricPattern StiffnessSystem::place_coefficients(const Network& net) {
  using Key = std::uint64_t;
  constexpr Key none = ~Key{0};
  const auto key = [](std::int32_t i, std::int32_t j) {
    if (i < 0 || j < 0) return none;
    return (static_cast<Key>(std::max(i, j)) << 32U) | static_cast<Key>(std::min(i, j));
  };
  std::vector<Key> wanted;
  wanted.reserve(21 * net.links.size());
  for (const Link& l : net.links) {
    const std::array<std::size_t, 6> f = freedoms(l);
    for (std::size_t r = 0; r < 6; ++r)
      for (std::size_t c = 0; c <= r; ++c) wanted.push_back(key(equation_[f[r]], equation_[f[c]]));
  }
  std::vector<Key> keys = wanted;
  const auto n = static_cast<std::int32_t>(diagonal_.size());
  for (std::int32_t i = 0; i < n; ++i) keys.push_back(key(i, i));
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  if (!keys.empty() && keys.back() == none) keys.pop_back();
  SymmetricPattern pattern;
  pattern.column.assign(diagonal_.size() + 1, 0);
  for (const Key k : keys) {
    pattern.row.push_back(static_cast<std::int32_t>(k & 0xffffffffU));
    ++pattern.column[(k >> 32U) + 1];
  }
  std::partial_sum(pattern.column.begin(), pattern.column.end(), pattern.column.begin());
  coefficients_.resize(keys.size());
  const auto find = [&](Key k) {  // within its column
    const std::int32_t* const column = pattern.column.data() + (k >> 32U);
    const auto first = keys.begin() + column[0], last = keys.begin() + column[1];
    return static_cast<std::int32_t>(std::lower_bound(first, last, k) - keys.begin());
  };
  slot_.reserve(wanted.size());
  for (const Key k : wanted) slot_.push_back(k == none ? -1 : find(k));
  for (std::int32_t i = 0; i < n; ++i) diagonal_[static_cast<std::size_t>(i)] = find(key(i, i));
  return pattern;
}

bool StiffnessSystem::fits(const Network& net, const std::vector<Freedom>& prescribed) const {
  if (3 * net.x.size() != equation_.size() || 2 * net.links.size() != pairs_.size()) return false;
  const auto same = [](const Freedom& a, const Freedom& b) {
    return a.body == b.body && a.component == b.component;
  };
  // Prescribed movements decide which equations there are.
  if (!std::equal(prescribed.begin(), prescribed.end(), prescribed_.begin(), prescribed_.end(), same))
    return false;
  for (std::size_t i = 0; i < net.links.size(); ++i)
    if (net.links[i].a != pairs_[2 * i] || net.links[i].b != pairs_[2 * i + 1]) return false;
  return true;
}

ElasticOutcome StiffnessSystem::factor(const Network& net, const std::vector<laws::Tangent<double>>& k) {
  if (ElasticOutcome outcome = check_stiffness(net, k); !outcome.ok()) return outcome;
  // Before the factorisation: a grain that nothing holds would make the matrix singular.
  loose_ = loose_bodies(net, k, prescribed_);
  std::vector<double>& K = coefficients_;
  std::fill(K.begin(), K.end(), 0.0);
  double stiffest = 0.0;
  for (std::size_t i = 0; i < net.links.size(); ++i) {
    const LinkRows row = rows(net.links[i]);
    const std::int32_t* slot = &slot_[21 * i];
    for (std::size_t r = 0; r < 6; ++r) {
      // K = B^T k B of the contact, row by row of B; symmetric, so half of it is enough.
      const std::array<double, 3> q = resistance(k[i], {row[0][r], row[1][r], row[2][r]});
      for (std::size_t c = 0; c <= r; ++c, ++slot)
        if (*slot >= 0)
          K[static_cast<std::size_t>(*slot)] += q[0] * row[0][c] + q[1] * row[1][c] + q[2] * row[2][c];
    }
    stiffest = std::max({stiffest, k[i].k_n, k[i].k_s});
  }
  // Loose grains hang on springs far below all others: they take part in no load, and the matrix stays
  // regular.
  ground_ = ground_stiffness * stiffest, length_ = net.length;
  for (std::size_t f = 0; f < equation_.size(); ++f)
    if (equation_[f] >= 0 && loose_[f / 3])
      K[static_cast<std::size_t>(diagonal_[static_cast<std::size_t>(equation_[f])])] +=
          // A rotation is held as firmly as a displacement at the length of a grain.
          f % 3 == 2 ? ground_ * length_ * length_ : ground_;
  if (factor_.factorise(K)) return {};
  return {ElasticStatus::mechanism,
          "the stiffness matrix is singular to rounding",
          "check for stiffnesses that differ by more than 1e12",
          {}};
}

Movements StiffnessSystem::solve(const std::vector<double>& f) const {
  std::vector<double> x(diagonal_.size());
  for (std::size_t i = 0; i < equation_.size(); ++i)
    if (equation_[i] >= 0) x[static_cast<std::size_t>(equation_[i])] = f[i];
  // In place: load in, movement out.
  factor_.solve(x);
  Movements u(equation_.size(), 0.0);
  for (std::size_t i = 0; i < equation_.size(); ++i)
    if (equation_[i] >= 0) u[i] = x[static_cast<std::size_t>(equation_[i])];
  return u;
}

Movements StiffnessSystem::solve(const Network& net, const std::vector<laws::Tangent<double>>& k,
                                 const Boundary& boundary) const {
  Movements given(equation_.size(), 0.0);
  for (const Given& m : boundary.movements) {
    PHY_CHECK(equation_[number(m.where)] < 0, "only prescribed movements are given");
    given[number(m.where)] = m.value;
  }
  // What prescribed movements alone would press is the load of the others, with the opposite sign.
  std::vector<double> f = inner_forces(net, k, given, boundary.gradient);
  for (double& x : f) x = -x;
  for (const Given& load : boundary.loads) f[number(load.where)] += load.value;
  Movements u = solve(f);
  for (std::size_t i = 0; i < u.size(); ++i) u[i] += given[i];
  return u;
}

double StiffnessSystem::ground_share(const Movements& u, double force) const {
  double sum = 0.0;
  for (std::size_t f = 0; f < u.size(); ++f)
    // What the weak springs carry of the load should be nothing: else a loose part is being pushed.
    if (equation_[f] >= 0 && loose_[f / 3]) sum += ground_ * std::fabs(u[f]) * (f % 3 == 2 ? length_ : 1.0);
  return sum / force;
}

std::vector<double> inner_forces(const Network& net, const std::vector<laws::Tangent<double>>& k,
                                 const Movements& u, const Gradient& gradient) {
  std::vector<double> f(u.size(), 0.0);
  for (std::size_t i = 0; i < net.links.size(); ++i) {
    const Link& l = net.links[i];
    const std::array<double, 3> q = resistance(k[i], strains(l, u, gradient));
    const LinkRows row = rows(l);
    const std::array<std::size_t, 6> at = freedoms(l);
    for (std::size_t r = 0; r < 6; ++r) f[at[r]] += row[0][r] * q[0] + row[1][r] * q[1] + row[2][r] * q[2];
  }
  return f;
}

void move_with(Boundary& boundary, const Network& net, std::uint32_t body, const Gradient& g) {
  const Vec2 u = g(net.x[body]);
  boundary.movements.push_back({{body, 0}, u.x});
  boundary.movements.push_back({{body, 1}, u.y});
  // A grain turns with the medium: the antisymmetric part of the gradient.
  boundary.movements.push_back({{body, 2}, 0.5 * (g.yx - g.xy)});
}

std::array<double, 3> stress_share(const Link& l, const laws::Tangent<double>& k,
                                   const std::array<double, 3>& strains) {
  const std::array<double, 3> q = forces(k, strains);
  const Vec2 on_b = q[0] * l.n + q[1] * tangent(l.n), branch = (l.arm_a + l.arm_b) * l.branch;
  // Love-Weber: force times branch over the area; the mean of both products, since couples would make it
  // unsymmetric.
  return {-on_b.x * branch.x, -on_b.y * branch.y, -0.5 * (on_b.x * branch.y + on_b.y * branch.x)};
}

LoadCase solve_once(const Network& net, const Boundary& boundary, std::vector<char> active) {
  if (active.empty()) active.assign(net.links.size(), 1);
  std::vector<Freedom> prescribed;
  for (const Given& m : boundary.movements) prescribed.push_back(m.where);
  StiffnessSystem system(net, std::move(prescribed));
  const std::vector<laws::Tangent<double>> k = stiffnesses(net, active);
  LoadCase result;
  result.outcome = system.factor(net, k);
  if (!result.outcome.ok()) return result;
  result.u = system.solve(net, k, boundary);
  double force = 0.0;
  // The largest force there is, as the measure of what the weak springs may carry.
  for (const double f : inner_forces(net, k, result.u, boundary.gradient))
    force = std::max(force, std::fabs(f));
  for (const Given& load : boundary.loads) force = std::max(force, std::fabs(load.value));
  // Negated: a solution that is not finite does not pass either.
  if (force > 0.0 && !(system.ground_share(result.u, force) < 1e-6)) {
    result.outcome = {ElasticStatus::mechanism,
                      "the load meets a part that moves without resistance",
                      "bond it or support it",
                      {}};
    for (std::uint32_t i = 0; i < net.n_grains; ++i)
      if (system.loose()[i]) result.outcome.grains.push_back(i);
  }
  return result;
}

CellStiffness cell_stiffness(const Network& net, double area) {
  // Periodic, so that only the rigid translation has to be taken out; rotation would change the cell.
  const std::vector<Freedom> pinned{{0, 0}, {0, 1}};
  StiffnessSystem system(net, pinned);
  const std::vector<laws::Tangent<double>> k = stiffnesses(net, std::vector<char>(net.links.size(), 1));
  CellStiffness cell;
  cell.outcome = system.factor(net, k);
  for (std::size_t c = 0; c < unit_strains.size() && cell.outcome.ok(); ++c) {
    Boundary boundary;
    boundary.gradient = unit_strains[c];
    const Movements u = system.solve(net, k, boundary);
    for (std::size_t i = 0; i < net.links.size(); ++i) {
      const Link& l = net.links[i];
      const std::array<double, 3> share = stress_share(l, k[i], strains(l, u, boundary.gradient));
      for (std::size_t r = 0; r < 3; ++r) cell.C[r][c] += share[r] / area;
    }
  }
  return cell;
}

}  // namespace phy::statics
