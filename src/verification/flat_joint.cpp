// The flat joint against closed forms of an interface of length 2R, driven step by step like in the engine.
#include <algorithm>
#include <cmath>
#include <string>

#include "base/units.hpp"
#include "laws/flat_joint/flat_joint.hpp"
#include "verification/cases.hpp"

namespace phy::verification {
namespace {

constexpr double R = 3e-4, k = 76e9 / 6.6e-4, sigma_c = 20e6, cohesion = 100e6, mu = 0.5;
constexpr double A = 2.0 * R, I = 2.0 / 3.0 * R * R * R;

/// An interface of N elements, its stiffness k [Pa/m].
template <int N>
struct Interface {
  laws::flat_joint::Parameters<double> p{k * A, 0.3 * k* A, 1.0 / (0.3 * k * A), R,  mu, cohesion* A,
                                         0.0,   0.0,        sigma_c* A,          0.0};
  laws::flat_joint::State<double, N> s{laws::flat_joint::whole<N>, 0.0, {}};
  laws::flat_joint::Cracks<double, N> cracks{};
  int n_cracks = 0;

  laws::Reaction<double> to(double closure, double slide, double rotation) {
    const laws::Reaction<double> r =
        laws::flat_joint::respond<N, double>(p, s, {closure, 0.0, slide, rotation}, cracks);
    for (int e = 0; cracks.some && e < N; ++e) n_cracks += cracks.tension[e] || cracks.shear[e] ? 1 : 0;
    return r;
  }
  /// Turned at the normal force P, where the bonds that hold balance it.
  laws::Reaction<double> hold(double P, double rotation) {
    const int before = n_cracks;
    double low = -2e-4, high = 2e-4;
    for (int i = 0; i < 100; ++i) {
      Interface trial = *this;
      trial.p.extra_strength = 1e30;
      const double closure = 0.5 * (low + high);
      (trial.to(closure, 0.0, rotation).F_n < P ? low : high) = closure;
    }
    const laws::Reaction<double> r = to(0.5 * (low + high), 0.0, rotation);
    return n_cracks > before ? hold(P, rotation) : r;
  }
};

template <int N>
void whole_interface(std::vector<Check>& checks) {
  const std::string of = "N = " + std::to_string(N) + ": ";
  Interface<N> pulled, bent;
  double opening = 0.0, most = 0.0;
  for (laws::Reaction<double> r{}; pulled.n_cracks == 0; opening += 1e-13, most = std::max(most, -r.F_n))
    r = pulled.to(-opening, 0.0, 0.0);
  checks.push_back({of + "tension at break 2R sigma_c [N/m]", A * sigma_c, most, 1e-6});
  if (N == 1) return;
  double M = 0.0;
  for (double turn = 0.0; bent.n_cracks == 0; turn += 1e-9) M = std::max(M, -bent.to(0.0, 0.0, turn).M);
  checks.push_back({of + "moment at first break (2/3) sigma_c R^2/(1 - 1/N) [N]",
                    2.0 / 3.0 * sigma_c * R * R / (1.0 - 1.0 / N), M, 3e-6});
}

std::vector<Check> strength() {
  std::vector<Check> checks;
  whole_interface<1>(checks), whole_interface<2>(checks);
  whole_interface<3>(checks), whole_interface<4>(checks);
  for (const double p : {0.0, 50e6}) {
    Interface<3> i;
    i.p.tan_phi = std::tan(0.5);
    const double peak = A * (cohesion + p * i.p.tan_phi), d = peak / i.p.k_s * 1e-6;
    double most = 0.0;
    laws::Reaction<double> r = i.to(p / k, 0.0, 0.0);
    for (; i.n_cracks == 0; r = i.to(p / k, d, 0.0)) most = std::fabs(r.F_s);
    const std::string at = "at " + print_number(p * 1e-6) + " MPa: ";
    checks.push_back({at + "shear force at break 2R (c + p tan phi) [N/m]", peak, most, 3e-6});
    checks.push_back({at + "and after it, mu p 2R [N/m]", mu * p * A, std::fabs(r.F_s), 1e-9});
  }
  return checks;
}

/// M at the normal force P of an interface without bonds: closed over l = 2R sqrt(theta_0/theta), the stress
/// a triangle that acts l/3 from the closed edge.
std::vector<Check> opening() {
  std::vector<Check> checks;
  const double P = 20e3, theta_0 = P / (2.0 * k * R * R);
  for (const double turn : {0.5, 1.5, 3.0, 10.0, 100.0}) {
    Interface<3> i;
    i.s.bonds = 0.0;
    const double M = turn <= 1.0 ? k * I * turn * theta_0 : P * (R - A / std::sqrt(turn) / 3.0);
    checks.push_back({"moment at constant force, " + print_number(turn) + " times the turn that opens it [N]",
                      M, -i.hold(P, turn * theta_0).M, 1e-10});
  }
  return checks;
}

template <int N>
void breaks_of(std::vector<Check>& checks, std::initializer_list<double> expected) {
  Interface<N> i;
  double turn = 0.0;
  for (const double at : expected) {
    const int before = i.n_cracks;
    for (; i.n_cracks == before; turn += 1e-7) i.hold(0.0, turn);
    checks.push_back(
        {"N = " + std::to_string(N) + ": rotation at break " + std::to_string(i.n_cracks) + " [rad]",
         at * sigma_c / (k * R), turn, 3e-4});
  }
}

/// Bent without normal force: n elements that hold turn about the middle of their length, and the outermost
/// centre is (n - 1) R/N from it.
std::vector<Check> element_by_element() {
  std::vector<Check> checks;
  breaks_of<2>(checks, {2.0});
  breaks_of<3>(checks, {1.5, 3.0});
  breaks_of<4>(checks, {4.0 / 3.0, 2.0, 4.0});
  return checks;
}

std::vector<Check> what_is_left() {
  Interface<3> i;
  i.s.bonds = 6.0;  // the first element of three is broken: those left have their middle at R/3
  const laws::Tangent<double> t = laws::flat_joint::tangent<3, double>(i.p, i.s, {-1e-8, 0.0, 0.0, 0.0});
  return {{"normal stiffness (2/3) k 2R [N/m per m]", 2.0 / 3.0 * k * A, t.k_n, 1e-12},
          {"shear stiffness (2/3) k_s 2R [N/m per m]", 0.2 * k * A, t.k_s, 1e-12},
          {"coupling (2/3) k 2R R/3 [N/m]", 2.0 / 9.0 * k * A * R, t.k_nm, 1e-12},
          {"bending stiffness k (R^3 + (R/3)^3)/3 [N]", k * R * R * R * (28.0 / 81.0), t.k_m, 1e-12}};
}

}  // namespace

std::vector<VerificationCase> flat_joint_cases() {
  const char* const source = "derived by hand: docs/theory/flat_joint.md";
  return {{"V24", "Flat joint: strengths of the whole interface", source,
           "driving steps of 1e-6 of the strength", strength},
          {"V24", "Flat joint without bonds: moment while it opens", source, "a root found by bisection",
           opening},
          {"V24", "Flat joint: elements break one by one in bending", source, "driving steps of 1e-7 rad",
           element_by_element},
          {"V24", "Flat joint: tangent of what is left", source, "rounding", what_is_left}};
}

}  // namespace phy::verification
