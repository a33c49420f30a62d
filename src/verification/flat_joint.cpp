// The flat joint against closed forms of an interface of length 2R, driven step by step like in the engine:
// FJ1 to FJ8 of docs/theory/flat_joint.md. FJ0, FJ9 and FJ10 are of grains and specimens: dynamics.cpp,
// statics.cpp, tests.cpp.
#include <algorithm>
#include <cmath>
#include <string>

#include "base/units.hpp"
#include "laws/flat_joint/flat_joint.hpp"
#include "verification/cases.hpp"

namespace phy::verification {
namespace {

constexpr double R_f = 3e-4, k_f = 76e9 / 6.6e-4, sigma_c = 20e6, cohesion = 100e6, mu = 0.5;
constexpr double A_f = 2.0 * R_f, I_f = 2.0 / 3.0 * R_f * R_f * R_f;

/// An interface of N elements, its stiffness k_f [Pa/m].
template <int N>
struct Interface {
  laws::flat_joint::Parameters<double> p{
      k_f * A_f, 0.3 * k_f* A_f, 1.0 / (0.3 * k_f * A_f), R_f, mu, cohesion* A_f, 0.0, 0.0, sigma_c* A_f,
      0.0};
  laws::flat_joint::State<double, N> s{laws::flat_joint::whole<N>, 0.0, {}};
  laws::flat_joint::Cracks<double, N> cracks{};
  int n_cracks = 0;
  laws::Motion<double> at{0.0, 0.0, 0.0, 0.0};

  laws::Reaction<double> to(double closure, double slide, double rotation) {
    at = {closure, closure - at.closure, slide, rotation, rotation - at.rotation};
    const laws::Reaction<double> r = laws::flat_joint::respond<N, double>(p, s, at, cracks);
    for (int e = 0; cracks.some && e < N; ++e) n_cracks += cracks.tension[e] || cracks.shear[e] ? 1 : 0;
    return r;
  }
  /// Turned at the normal force P, where the bonds that hold balance it.
  laws::Reaction<double> hold(double P, double rotation) {
    const int before = n_cracks;
    double low = -2e-4, high = 2e-4;
    for (int i = 0; i < 100; ++i) {
      Interface trial = *this;
      // The closure is found with bonds that cannot break, then tried with those that can.
      trial.p.extra_strength = 1e30;
      const double closure = 0.5 * (low + high);
      (trial.to(closure, 0.0, rotation).F_n < P ? low : high) = closure;
    }
    const laws::Reaction<double> r = to(0.5 * (low + high), 0.0, rotation);
    // A break moves the axis: balanced anew until nothing more breaks.
    return n_cracks > before ? hold(P, rotation) : r;
  }
};

template <int N>
void pulled(std::vector<Check>& checks) {
  const std::string of = "N = " + std::to_string(N) + ": ";
  Interface<N> i;
  double opening = 0.0, most = 0.0;
  laws::Reaction<double> r{};
  for (; i.n_cracks == 0; opening += 1e-13, most = std::max(most, -r.F_n)) r = i.to(-opening, 0.0, 0.0);
  checks.push_back({of + "tension at break 2R sigma_c [N/m]", A_f * sigma_c, most, 1e-6});
  checks.push_back({of + "elements that break at once", N, static_cast<double>(i.n_cracks), 0.0});
  checks.push_back({of + "released sigma_c^2 R/k [J/m]", sigma_c * sigma_c * R_f / k_f, r.released, 2e-6});
}

std::vector<Check> tension() {
  std::vector<Check> checks;
  pulled<1>(checks), pulled<2>(checks), pulled<3>(checks), pulled<4>(checks);
  return checks;
}

std::vector<Check> shear() {
  std::vector<Check> checks;
  for (const double p : {0.0, 50e6, -10e6}) {
    Interface<3> i;
    i.p.tan_phi = std::tan(0.5);
    const double peak = A_f * (cohesion + p * i.p.tan_phi), d = peak / i.p.k_s * 1e-6;
    double most = 0.0;
    laws::Reaction<double> r = i.to(p / k_f, 0.0, 0.0);
    for (; i.n_cracks == 0; r = i.to(p / k_f, d, 0.0)) most = std::fabs(r.F_s);
    const std::string at = "at " + print_number(p * 1e-6) + " MPa: ";
    checks.push_back({at + "shear force at break 2R (c + p tan phi) [N/m]", peak, most, 3e-6});
    checks.push_back({at + "and after it, mu p 2R, none if pulled [N/m]", mu * std::max(p, 0.0) * A_f,
                      std::fabs(r.F_s), 1e-9});
  }
  return checks;
}

/// When the outermost element has gone, the moment is less by that element's share of I: the slice of length
/// 2h, h = R/N, whose middle is at R - h.
template <int N>
void bent(std::vector<Check>& checks) {
  const std::string of = "N = " + std::to_string(N) + ": ";
  Interface<N> i;
  laws::Reaction<double> r{};
  double M = 0.0;
  for (double turn = 0.0; i.n_cracks == 0; turn += 1e-9) r = i.to(0.0, 0.0, turn), M = std::max(M, -r.M);
  const double first = 2.0 / 3.0 * sigma_c * R_f * R_f / (1.0 - 1.0 / N), inner = R_f - 2.0 * R_f / N;
  checks.push_back({of + "moment at first break (2/3) sigma_c R^2/(1 - 1/N) [N]", first, M, 3e-6});
  checks.push_back({of + "moment after it, by the second moment of what is left [N]",
                    first * (R_f * R_f * R_f + inner * inner * inner) / (2.0 * R_f * R_f * R_f), -r.M, 3e-6});
}

std::vector<Check> bending() {
  std::vector<Check> checks;
  Interface<3> whole;
  checks.push_back({"moment over rotation of a whole interface (2/3) k R^3 [N]", k_f * I_f,
                    -whole.to(0.0, 0.0, 1e-6).M / 1e-6, 1e-12});
  bent<2>(checks), bent<3>(checks), bent<4>(checks);
  return checks;
}

/// M at the normal force P of an interface without bonds: closed over l = 2R sqrt(theta_0/theta), the stress
/// a triangle that acts l/3 from the closed edge.
std::vector<Check> opening() {
  std::vector<Check> checks;
  const double P = 20e3, theta_0 = P / (2.0 * k_f * R_f * R_f);
  for (const double turn : {0.5, 1.5, 3.0, 10.0, 100.0}) {
    Interface<3> i;
    i.s.bonds = 0.0;
    const double M = turn <= 1.0 ? k_f * I_f * turn * theta_0 : P * (R_f - A_f / std::sqrt(turn) / 3.0);
    checks.push_back({"moment at constant force, " + print_number(turn) + " times the turn that opens it [N]",
                      M, -i.hold(P, turn * theta_0).M, 1e-10});
  }
  return checks;
}

template <int N>
void breaks_of(std::vector<Check>& checks, std::initializer_list<double> expected) {
  Interface<N> i;
  const std::string of = "N = " + std::to_string(N) + ": ";
  double turn = 0.0;
  for (const double at : expected) {
    const int before = i.n_cracks;
    for (; i.n_cracks == before; turn += 1e-7) i.hold(0.0, turn);
    checks.push_back({of + "rotation at break " + std::to_string(i.n_cracks) + " [rad]",
                      at * sigma_c / (k_f * R_f), turn, 3e-4});
  }
  // The last element has its centre in the axis, where bending pulls at nothing.
  i.hold(0.0, 10.0 * turn);
  checks.push_back(
      {of + "elements that hold at ten times that", 1.0, static_cast<double>(N - i.n_cracks), 0.0});
}

/// Bent without normal force: n elements that hold turn about the middle of their length, and the outermost
/// centre is (n - 1) R/N from it. The last has its centre in the axis.
std::vector<Check> element_by_element() {
  std::vector<Check> checks;
  breaks_of<2>(checks, {2.0});
  breaks_of<3>(checks, {1.5, 3.0});
  breaks_of<4>(checks, {4.0 / 3.0, 2.0, 4.0});
  return checks;
}

std::vector<Check> what_is_left() {
  Interface<3> i;
  const auto left = [&](double bonds) {
    i.s.bonds = bonds;
    return laws::flat_joint::tangent<3, double>(i.p, i.s, {-1e-8, 0.0, 0.0, 0.0});
  };
  const laws::Tangent<double> t = left(6.0),
                              middle = left(2.0);  // without the first of three; without both ends
  return {{"normal stiffness (2/3) k 2R [N/m per m]", 2.0 / 3.0 * k_f * A_f, t.k_n, 1e-12},
          {"shear stiffness (2/3) k_s 2R [N/m per m]", 0.2 * k_f * A_f, t.k_s, 1e-12},
          {"coupling (2/3) k 2R R/3 [N/m]", 2.0 / 9.0 * k_f * A_f * R_f, t.k_nm, 1e-12},
          {"bending stiffness k (R^3 + (R/3)^3)/3 [N]", k_f * R_f * R_f * R_f * (28.0 / 81.0), t.k_m, 1e-12},
          {"of the middle one alone (2/3) k (R/3)^3 [N]", k_f * I_f / 27.0, middle.k_m, 1e-12}};
}

/// Friction of all elements together is mu P, however far the interface has opened.
std::vector<Check> residual_sliding() {
  std::vector<Check> checks;
  const double P = 20e3, theta_0 = P / (2.0 * k_f * R_f * R_f);
  for (const double turn : {0.0, 0.5, 2.0, 20.0}) {
    Interface<3> i;
    i.s.bonds = 0.0;
    i.hold(P, turn * theta_0);
    const laws::Reaction<double> r = i.to(i.at.closure, 1e-5, i.at.rotation);
    checks.push_back({"friction at " + print_number(turn) + " times the turn that opens it, mu P [N/m]",
                      mu * P, -r.F_s, 1e-9});
  }
  return checks;
}

/// Work along a path that breaks two elements and slides, less what is held, released and rubbed away, over
/// the sum of |dW|.
double imbalance(int steps) {
  Interface<3> i;
  double work = 0.0, spent = 0.0, turnover = 0.0;
  laws::Reaction<double> last{};
  for (int n = 1; n <= steps; ++n) {
    const double u = static_cast<double>(n) / steps, du = 1.0 / steps;
    const double slide = 4e-6 * (std::sin(5.0 * u) - std::sin(5.0 * (u - du)));
    const laws::Reaction<double> r =
        i.to(1e-7 * std::sin(7.0 * u) - 0.5e-7 * u, slide, 2.5e-3 * std::sin(4.0 * u));
    const double dW = 0.5 * ((last.F_n + r.F_n) * i.at.d_closure - (last.F_s + r.F_s) * slide -
                             (last.M + r.M) * i.at.d_rotation);
    work += dW, turnover += std::fabs(dW), spent += r.released + r.dissipated;
    last = r;
  }
  return (work - spent - laws::flat_joint::strain_energy<3, double>(i.p, i.s, i.at)) / turnover;
}

std::vector<Check> energy_of_a_path() {
  return {{"work not accounted for / sum of |dW|, 2,000 steps [-]", 0.0, imbalance(2000), 5e-8},
          {"20,000 steps [-]", 0.0, imbalance(20000), 5e-10},
          {"200,000 steps [-]", 0.0, imbalance(200000), 5e-12}};
}

}  // namespace

std::vector<VerificationCase> flat_joint_cases() {
  const char* const source = "derived by hand: docs/theory/flat_joint.md";
  const char* const driven = "driving steps of 1e-6 of the strength";
  return {
      {"V24", "FJ1. Flat joint pulled along its axis", source, driven, tension},
      {"V24", "FJ2. Flat joint sheared: Coulomb strength, and what friction leaves", source, driven, shear},
      {"V24", "FJ3. Flat joint bent until its first element breaks", source, driven, bending},
      {"V24", "FJ4. Flat joint without bonds: moment while it opens", source, "a root found by bisection",
       opening},
      {"V24", "FJ5. Flat joint: elements break one by one in bending", source, "driving steps of 1e-7 rad",
       element_by_element},
      {"V24", "FJ6. Flat joint: tangent of what is left", source, "rounding", what_is_left},
      {"V24", "FJ7. Flat joint without bonds: it slides at mu P, however far open", source,
       "a root found by bisection", residual_sliding},
      {"V24", "FJ8. Flat joint: energy along a path that breaks and slides", "first law",
       "second order in the step: a tenth of it, a hundredth of the error", energy_of_a_path}};
}

}  // namespace phy::verification
