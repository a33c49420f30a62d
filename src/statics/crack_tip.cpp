#include "statics/crack_tip.hpp"

#include <Eigen/LU>
#include <cmath>
#include <complex>
#include <vector>

#include "base/check.hpp"
#include "base/exact_math.hpp"
#include "base/least_squares.hpp"
#include "base/polynomial.hpp"

namespace phy::statics {
namespace {

constexpr int orders = 5;       // n = 1 ... orders: more follow the scatter of the grains
constexpr double apart = 1e-3;  // roots closer than this are told apart: isotropic rock has a double one

using Complex = std::complex<double>;

bool within(const Window& w, Vec2 p, double margin = 0.0) {
  return p.x > w.lo.x - margin && p.x < w.hi.x + margin && p.y > w.lo.y - margin && p.y < w.hi.y + margin;
}

/// Over the contacts in the window: xx, yy, xy, tension positive.
Eigen::Vector3d mean_stress(const Network& net, const std::vector<laws::Tangent<double>>& k,
                            const Movements& u, const Window& w) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < net.links.size(); ++i) {
    const Link& l = net.links[i];
    // A contact counts where its point lies, as a whole: edges of the window even out over many contacts.
    if (!within(w, net.x[l.a] + l.arm_a * l.branch)) continue;
    const std::array<double, 3> share = stress_share(l, k[i], strains(l, u));
    sum += Eigen::Vector3d(share[0], share[1], share[2]);
  }
  return sum / ((w.hi.x - w.lo.x) * (w.hi.y - w.lo.y));
}

/// Least squares over the grains in the window: strain xx, yy, 2 xy.
Eigen::Vector3d mean_strain(const Network& net, const Movements& u, const Window& w) {
  std::size_t n = 0;
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  Eigen::Matrix<double, 3, 2> right = Eigen::Matrix<double, 3, 2>::Zero();
  for (std::size_t i = 0; i < net.n_grains; ++i) {
    if (!within(w, net.x[i])) continue;
    // A plane through the displacements: their gradient is the mean strain, whatever the shape of the window.
    const Eigen::Vector3d place(1.0, net.x[i].x - w.lo.x, net.x[i].y - w.lo.y);
    ++n, squares += place * place.transpose();
    right += place * Eigen::RowVector2d(u[3 * i], u[3 * i + 1]);
  }
  PHY_CHECK(n >= 3, "three grains in a window");
  const Eigen::Matrix<double, 3, 2> fit = squares.inverse() * right;
  return {fit(1, 0), fit(2, 1), fit(2, 0) + fit(1, 1)};
}

/// A tensor of compliance, given in x and y, in axes turned to `axis`.
Compliance turned(const Eigen::Matrix3d& S, Vec2 axis) {
  const double c = axis.x, s = axis.y;
  Eigen::Matrix3d Q;  // takes strains from x, y to the turned axes; Q^T takes stresses back
  Q << c * c, s * s, c * s, s * s, c * c, -c * s, -2.0 * c * s, 2.0 * c * s, c * c - s * s;
  const Eigen::Matrix3d t = Q * S * Q.transpose();
  Compliance out;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      out[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] = 0.5 * (t(i, j) + t(j, i));
  return out;
}

/// The two ways of a body to answer along z_k.
struct Roots {
  std::array<Complex, 2> mu, p, q;
};

Roots roots_of(const Compliance& S) {
  const double scale = 1.0 / S[0][0];
  Roots r;
  std::size_t n = 0;
  for (const Complex& root : roots_of_monic({S[1][1] * scale, -2.0 * S[1][2] * scale,
                                             (2.0 * S[0][1] + S[2][2]) * scale, -2.0 * S[0][2] * scale}))
    if (root.imag() > 0.0 && n < 2) r.mu[n++] = root;
  // The formulas divide by their difference, and isotropic rock has mu = i twice. Moved apart to both sides,
  // so that what this changes is of second order.
  if (std::abs(r.mu[0] - r.mu[1]) < apart) r.mu[0] *= 1.0 - apart, r.mu[1] *= 1.0 + apart;
  for (std::size_t k = 0; k < 2; ++k) {
    const Complex m = r.mu[k];
    r.p[k] = S[0][0] * m * m + S[0][1] - S[0][2] * m;
    r.q[k] = S[0][1] * m + S[1][1] / m - S[1][2];
  }
  return r;
}

/// Movements (1, 2) of the two terms of order n at (x_1, x_2): for sum c_k = unit, then sum mu_k c_k = unit.
Eigen::Matrix2d terms(const Roots& r, int n, double x_1, double x_2) {
  // Faces of the crack are free of stress: terms of odd order have real coefficients, of even order imaginary
  // ones.
  const Complex unit = n % 2 == 1 ? Complex(1.0, 0.0) : Complex(0.0, 1.0);
  const Complex span = r.mu[1] - r.mu[0];
  const std::array<std::array<Complex, 2>, 2> c = {
      {{r.mu[1] / span * unit, -r.mu[0] / span * unit}, {-unit / span, unit / span}}};
  Eigen::Matrix2d out = Eigen::Matrix2d::Zero();
  for (std::size_t k = 0; k < 2; ++k) {
    const Complex power = std::pow(x_1 + r.mu[k] * x_2, 0.5 * n);
    for (std::size_t j = 0; j < 2; ++j) {
      out(0, static_cast<int>(j)) += 2.0 * (r.p[k] * c[j][k] * power).real();
      out(1, static_cast<int>(j)) += 2.0 * (r.q[k] * c[j][k] * power).real();
    }
  }
  return out;
}

}  // namespace

EffectiveCompliance effective_compliance(const Network& net, std::span<const Window> windows, double margin,
                                         Vec2 axis) {
  std::vector<std::uint32_t> driven;
  std::vector<Freedom> prescribed;
  for (std::uint32_t i = 0; i < net.n_grains; ++i) {
    bool inside = false;
    for (const Window& w : windows) inside = inside || within(w, net.x[i], margin);
    // Everything outside moves with a uniform strain; only the windows, and a margin, answer freely.
    if (inside) continue;
    driven.push_back(i);
    for (int component = 0; component < 3; ++component) prescribed.push_back({i, component});
  }
  const std::vector<laws::Tangent<double>> k = stiffnesses(net, std::vector<char>(net.links.size(), 1));
  StiffnessSystem system(net, prescribed);
  EffectiveCompliance result;
  result.outcome = system.factor(net, k);
  if (!result.outcome.ok()) return result;
  Eigen::Matrix3d stress = Eigen::Matrix3d::Zero(), strain = Eigen::Matrix3d::Zero();
  for (int c = 0; c < 3; ++c) {
    Boundary boundary;
    for (const std::uint32_t i : driven)
      move_with(boundary, net, i, unit_strains[static_cast<std::size_t>(c)]);
    const Movements u = system.solve(net, k, boundary);
    for (const Window& w : windows)
      stress.col(c) += mean_stress(net, k, u, w), strain.col(c) += mean_strain(net, u, w);
  }
  result.S = turned(strain * stress.inverse(), axis);
  return result;
}

StressIntensity stress_intensity(const Network& net, const Movements& u, const CrackTip& tip,
                                 const Compliance& compliance) {
  const Roots roots = roots_of(compliance);
  const Vec2 across = tangent(tip.ahead);
  std::vector<std::size_t> ring;
  for (std::size_t i = 0; i < net.n_grains; ++i)
    if (const double r = norm(net.x[i] - tip.end); r > tip.nearest && r < tip.farthest) ring.push_back(i);
  constexpr int n_unknown = 2 + 2 * orders;
  Eigen::MatrixXd A(2 * static_cast<Eigen::Index>(ring.size()), n_unknown);
  Eigen::VectorXd b(A.rows());
  for (std::size_t g = 0; g < ring.size(); ++g) {
    const Vec2 x = net.x[ring[g]] - tip.end, v{u[3 * ring[g]], u[3 * ring[g] + 1]};
    const auto row = 2 * static_cast<Eigen::Index>(g);
    A.block<2, 2>(row, 0).setIdentity();
    for (int n = 1; n <= orders; ++n)  // lengths over that of the ring: columns of like size
      A.block<2, 2>(row, Eigen::Index{2} * n) =
          terms(roots, n, dot(x, tip.ahead) / tip.farthest, dot(x, across) / tip.farthest);
    b.segment<2>(row) = Eigen::Vector2d(dot(v, tip.ahead), dot(v, across));
  }
  // Columns are scaled to length 1: orders grow with the distance, and the fit would be ill-conditioned.
  const Eigen::VectorXd size = A.colwise().norm();
  const Eigen::VectorXd fit = linear_least_squares(A * size.cwiseInverse().asDiagonal(), b).x;
  const Eigen::VectorXd c = fit.cwiseQuotient(size);
  const double scale = std::sqrt(2.0 * pi / tip.farthest);
  const Eigen::VectorXd moved = b - A.leftCols(2) * c.head(2);
  // The first order is the square root: its two coefficients are K_I and K_II.
  return {scale * c[2], -scale * c[3], (b - A * c).norm() / moved.norm()};
}

}  // namespace phy::statics
