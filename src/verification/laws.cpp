// Contact laws against closed forms, driven step by step like in the engine.
#include <cmath>
#include <string>

#include "base/exact_math.hpp"
#include "base/units.hpp"
#include "laws/laws.hpp"
#include "verification/cases.hpp"

namespace phy::verification {
namespace {

constexpr double huge = 1e30;

laws::smooth_joint::Parameters<double> joint(double psi) {
  return {3360e9 * 6e-4, 960e9 * 6e-4, 0.4, huge, 0.0, tan_degrees(psi), 0.0};
}

std::vector<Check> joint_friction() {
  const double N0 = 5e3;
  std::vector<Check> checks;
  for (const double psi : {0.0, 10.0}) {
    const auto p = joint(psi);
    laws::smooth_joint::State<double> s{0.0, N0 / p.k_n, 0.0, 0.0};
    // Steps far below the slide at which it slips: what is found lags by one of them.
    const double du = 1e-9, u_slip = p.mu * N0 / p.k_s;
    double u = 0.0, opened = 0.0, onset = 0.0;
    laws::Reaction<double> r{};
    for (int i = 0; i < 20000; ++i) {  // constant normal load: the joint opens by what it dilates
      const double lift = s.dilation - opened;
      opened = s.dilation;
      r = laws::smooth_joint::respond(p, s, laws::Motion<double>{0.0, -lift, du, 0.0});
      u += du;
      if (onset == 0.0 && r.dissipated > 0.0) onset = u;
    }
    const std::string with = "psi = " + std::to_string(static_cast<int>(psi)) + " deg: ";
    checks.push_back({with + "slip starts at u_s = mu N0/(k_s A) [m]", u_slip, onset, du / u_slip});
    checks.push_back({with + "dilation under constant load (u_s - u_slip) tan psi [m]",
                      (u - u_slip) * p.tan_psi, s.dilation, 1e-3});
    checks.push_back({with + "shear force mu N0 [N/m]", p.mu * N0, -r.F_s, 1e-3});
  }
  return checks;
}

std::vector<Check> joint_constant_stiffness() {
  std::vector<Check> checks;
  for (const double mu_ks :
       {0.4, 0.9}) {  // the second alternates in the explicit form: mu (k_n/k_s) tan psi > 1
    auto p = joint(35.0);
    p.mu = mu_ks;
    // The law asks for tan psi <= mu.
    if (mu_ks < p.tan_psi) p.tan_psi = tan_degrees(10.0);
    laws::smooth_joint::State<double> s{0.0, 5e3 / p.k_n, 0.0, 0.0};
    const double du = 1e-9;
    double F1 = 0.0, F2 = 0.0;
    for (int i = 0; i < 20000; ++i) {
      const auto r = laws::smooth_joint::respond(p, s, laws::Motion<double>{0.0, 0.0, du, 0.0});
      // Between two steps in the middle of slipping, long after its onset.
      if (i == 14999) F1 = r.F_n;
      if (i == 19999) F2 = r.F_n;
    }
    const double k = p.k_n / p.k_s * p.tan_psi;
    checks.push_back(
        {"dF_n/du_s at fixed closure, mu (k_n/k_s) tan psi = " + std::to_string(p.mu * k) + " [N/m per m]",
         p.k_n * p.tan_psi / (1.0 + p.mu * k), (F2 - F1) / (5000 * du), 1e-9});
  }
  return checks;
}

std::vector<Check> joint_strength() {
  const double A = 6e-4, sigma_n = 10e6, c = 30e6, phi = 20.0;
  laws::smooth_joint::Parameters<double> p{3360e9 * A, 960e9 * A, 0.4, c * A, tan_degrees(phi), 0.0, 0.0};
  laws::smooth_joint::State<double> s{0.0, 0.0, sigma_n * A, 0.0};
  double opening = 0.0, peak = 0.0;
  const double du = 1e-12;
  while (s.capacity > 0.0)
    laws::smooth_joint::respond(p, s, laws::Motion<double>{0.0, -du, 0.0, 0.0}), opening += du;
  // Pressed shut, and sheared at this force: Coulomb's line at one point.
  const double N = 8e3;
  s = {0.0, N / p.k_n, sigma_n * A, 0.0};
  laws::Reaction<double> r{};
  while (s.capacity > 0.0) {
    peak = -s.F_s;
    r = laws::smooth_joint::respond(p, s, laws::Motion<double>{0.0, 0.0, 1e-11, 0.0});
  }
  r = laws::smooth_joint::respond(p, s, laws::Motion<double>{0.0, 0.0, 1e-11, 0.0});
  return {{"opening at tensile break sigma_n/k_n [m]", sigma_n / 3360e9, opening, 1e-6},
          {"shear force at break (c + p tan phi) A [N/m]", c * A + N * tan_degrees(phi), peak, 1e-6},
          {"residual shear force mu p A [N/m]", p.mu * N, -r.F_s, 1e-12}};
}

laws::parallel_bond::Parameters<double> bond(double r1, double r2, double tau, double beta_bar) {
  // The geometry of the law itself: what is checked is strength, not stiffness.
  const auto g = laws::parallel_bond::geometry(1.0, r1, r2);
  const double kb = 38e9 / g.L;
  return {kb * g.A, 0.3 * kb * g.A, kb * g.I, 3.0 * beta_bar / g.R_bar, tau * g.A, 0.0, 0.0};
}

/// Drives a fresh bond along `d` (closure, slide, rotation per step) until it breaks; the motion of the last
/// step.
laws::Motion<double> until_broken(const laws::parallel_bond::Parameters<double>& p, double capacity,
                                  laws::Motion<double> d) {
  laws::parallel_bond::State<double> s{0.0, capacity};
  // Closure and rotation are totals, slide is an increment.
  laws::Motion<double> m{0.0, d.closure, d.d_slide, 0.0};
  double slide = 0.0;
  while (s.capacity > 0.0) {
    m.closure += d.closure, m.rotation += d.rotation, slide += d.d_slide;
    laws::parallel_bond::respond(p, s, m);
  }
  return {m.closure, d.closure, slide, m.rotation};
}

std::vector<Check> bond_strength() {
  const double r1 = 3e-4, r2 = 4e-4, sigma = 65e6, tau = 50e6, beta_bar = 0.7;
  const auto p = bond(r1, r2, tau, beta_bar);
  const double A = 2.0 * r1, L = r1 + r2, kb = 38e9 / L, I = 2.0 / 3.0 * r1 * r1 * r1;
  const auto pull = until_broken(p, sigma * A, {-1e-13, 0.0, 0.0, 0.0});
  const auto slide = until_broken(p, sigma * A, {0.0, 0.0, 1e-13 * 5, 0.0});
  const auto bend = until_broken(p, sigma * A, {0.0, 0.0, 0.0, 1e-9});
  // Tension and bending meet in the outer fibre, and only there.
  const auto both = until_broken(p, sigma * A, {-1e-13, 0.0, 0.0, 1e-9});
  const double N = -p.k_n * both.closure, M = p.k_m * both.rotation;
  return {{"elongation at tensile break sigma_c/kb_n [m]", sigma / kb, -pull.closure, 1e-6},
          {"shear force at break tau_c A [N/m]", tau * A, p.k_s * slide.d_slide, 1e-5},
          {"moment at break sigma_c I/(beta_bar R_bar) [N]", sigma * I / (beta_bar * r1),
           p.k_m * bend.rotation, 1e-5},
          {"N/A + beta_bar |M| R_bar/I at combined break [Pa]", sigma, N / A + beta_bar * M * r1 / I, 1e-5}};
}

/// Speed with which a mass leaves a contact over the speed with which it came, by the leap-frog of the
/// engine: speeds half a step behind positions. Normal: a central impact. Shear: half an oscillation on a
/// contact that is pressed shut.
double rebound(double xi, int mode, bool shear) {
  const double k = 38e9, m_c = 4e-4, omega = std::sqrt(k / m_c), dt = 5e-7 / omega, v0 = 0.1;
  const double c = laws::dashpot::coefficient(xi, m_c, k);
  const laws::dashpot::Parameters<double> p{{k, k, 1.0 / k, huge}, c, c, 1.0 / dt, mode};
  laws::dashpot::State<double> s{0.0};
  double x = 0.0, v = v0;
  while (true) {
    x += v * dt;
    // It has left the contact, or come back to the middle of its swing.
    if (x <= 0.0) return -v / v0;
    const laws::Motion<double> m =
        shear ? laws::Motion<double>{1e-6, 0.0, v * dt, 0.0} : laws::Motion<double>{x, v * dt, 0.0, 0.0};
    const laws::Reaction<double> r = laws::dashpot::respond(p, s, m);
    v -= (shear ? -r.F_s : r.F_n) / m_c * dt;
  }
}

std::vector<Check> restitution() {
  std::vector<Check> checks;
  for (const double xi : {0.05, 0.3}) {
    const double root = std::sqrt(1.0 - xi * xi);
    const double full = std::exp(-pi * xi / root);
    const double until_force_ends = pi - std::atan2(2.0 * xi * root, 1.0 - 2.0 * xi * xi);
    const std::string with = "xi = " + print_number(xi) + ": ";
    checks.push_back({with + "restitution, mode 0, exp(-pi xi/s) [-]", full, rebound(xi, 0, false), 1e-6});
    checks.push_back({with + "restitution, mode 1, contact ends at zero force [-]",
                      std::exp(-xi / root * until_force_ends), rebound(xi, 1, false), 1e-6});
    checks.push_back({with + "speed after half a shear oscillation [-]", full, rebound(xi, 0, true), 1e-6});
  }
  return checks;
}

}  // namespace

std::vector<VerificationCase> law_cases() {
  return {
      {"V9", "Dashpots: restitution of two grains, normal and shear",
       "damped oscillator m x'' + c x' + k x = 0; modes of PFC's dp_mode",
       "the leap-frog takes the force of a dashpot half a step late, an error of 1e-7 at 3e7 steps per "
       "contact",
       restitution},
      {"V10", "Smooth joint: slip, dilation under constant load", "Mas Ivars et al. 2011, closed form",
       "the driven path lags one step of 1e-9 m behind", joint_friction},
      {"V10", "Smooth joint: dilation at constant normal stiffness, also where the explicit form alternates",
       "closed form of the implicit update", "the implicit update is exact", joint_constant_stiffness},
      {"V11", "Smooth joint: bonded strengths and residual friction", "Mas Ivars et al. 2011",
       "one driving step of 1e-12 m", joint_strength},
      {"V12", "Parallel bond: strength in tension, shear, bending and together", "Potyondy & Cundall 2004",
       "one driving step", bond_strength},
  };
}

}  // namespace phy::verification
