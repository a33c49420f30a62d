#include "theory/contact_path.hpp"

#include <algorithm>
#include <cmath>

namespace phy::theory {
namespace {

/// Where a + b lambda reaches 0 from below, for lambda >= 0; 2 when it does not on this leg.
double root(double a, double b) {
  if (a >= 0.0) return 0.0;
  return b > 0.0 ? std::min(2.0, -a / b) : 2.0;
}

/// Where |x0 + x1 lambda| f + a + b lambda reaches 0 from below.
double root_with_size(double x0, double x1, double f, double a, double b) {
  return std::min(root(f * x0 + a, f * x1 + b), root(-f * x0 + a, -f * x1 + b));
}

}  // namespace

/// An open slider moves on until it touches or the leg ends; what is left of the leg.
double Slider::touch(double closure, double left) {
  F_s = 0.0;
  slips = 0;
  const double until = closure > 0.0 ? std::min(left, -gap_closed / closure) : left;
  gap_closed = until < left ? 0.0 : gap_closed + closure * left;
  return left - until;
}

/// A slipping slider moves on until it opens or the leg ends; what is left of the leg.
double Slider::open(double closure, double slip_rate, double left) {
  const double rate = closure + slip_rate * tan_psi;
  const double until = rate < 0.0 ? std::min(left, -gap_closed / rate) : left;
  gap_closed = until < left ? 0.0 : gap_closed + rate * left;
  // While it slips the force is the limit, whatever the path.
  F_s = -slips * mu * k_n * std::max(gap_closed, 0.0);
  return left - until;
}

void Slider::leg(double closure, double slide) {
  double left = 1.0;
  if (gap_closed < 0.0 || (gap_closed == 0.0 && closure <= 0.0)) left = touch(closure, left);
  if (left <= 0.0) return;
  const auto until_slip = [&](int q) {  // a limit from which the force moves away is not met
    const double rate = q * k_s * slide - mu * k_n * closure;
    return rate > 0.0 ? root(-mu * k_n * gap_closed - q * F_s, rate) : 2.0;
  };
  // The limit that is met first.
  const int q = until_slip(1) <= until_slip(-1) ? 1 : -1;
  const double stick = std::min(left, until_slip(q));
  gap_closed += closure * stick;
  F_s -= k_s * slide * stick;
  slips = 0;
  left -= stick;
  if (left <= 0.0) return;
  slips = q;
  // Rate of slip that keeps |F_s| at mu F_n although dilation raises F_n.
  left = open(closure, (k_s * q * slide - mu * k_n * closure) / (k_s + mu * k_n * tan_psi), left);
  if (left > 0.0) touch(closure, left);
}

Cement::Breakage Cement::leg(ContactPoint step, double& done) {
  const ContactForces f = forces();
  const double F_n_rate = k_n * step.closure;
  // Outer fibre: |M| arm - F_n = capacity, linear in the leg on either side of M = 0.
  const double tension = root_with_size(f.M, -k_m * step.rotation, arm, -f.F_n - capacity, -F_n_rate);
  const double shear =
      root_with_size(f.F_s, -k_s * step.slide, 1.0, -S_0 - tan_phi * f.F_n, -tan_phi * F_n_rate);
  done = std::min({1.0, tension, shear});
  at = at + done * step;
  if (tension > 1.0 && shear > 1.0) return Breakage::none;
  // Tension is tested first, as in the laws.
  return tension <= shear ? Breakage::tension : Breakage::shear;
}

ContactForces Cement::forces() const {
  if (!(capacity > 0.0)) return {};
  return {k_n * at.closure, -k_s * at.slide, -k_m * at.rotation};
}

void ExactLinear::leg(ContactPoint step, double seconds) {
  slider.leg(step.closure, step.slide);
  viscous = {};
  const double F_n = slider.forces().F_n;
  if (!(slider.gap_closed > 0.0) || seconds <= 0.0) return;
  viscous.F_n = c_n * step.closure / seconds;
  // Dashpot and spring together may not pull.
  if (no_tension) viscous.F_n = std::max(viscous.F_n, -F_n);
  if (!(cut_while_slipping && slider.slips != 0)) viscous.F_s = -c_s * step.slide / seconds;
}

ContactForces ExactLinear::forces() const {
  const ContactForces f = slider.forces();
  return {f.F_n + viscous.F_n, f.F_s + viscous.F_s, 0.0};
}

void ExactBond::leg(ContactPoint step, double) {
  double done = 0.0;
  if (cement.capacity > 0.0 && cement.leg(step, done) != Cement::Breakage::none) cement.capacity = 0.0;
}

void ExactJoint::leg(ContactPoint step, double) {
  double done = 0.0;
  if (cement.capacity > 0.0) {
    const Cement::Breakage how = cement.leg(step, done);
    if (how == Cement::Breakage::none) return;
    const ContactForces f = cement.forces();
    cement.capacity = 0.0;
    slider.gap_closed = cement.at.closure;
    // Broken in tension the faces part; in shear the force stays as far as friction bears it.
    slider.F_s = how == Cement::Breakage::shear && f.F_n > 0.0 ? f.F_s : 0.0;
    const double excess = std::fabs(slider.F_s) - slider.mu * f.F_n;
    if (excess > 0.0 && slider.F_s != 0.0) {
      // The drop of force at breakage is slip, which dilates.
      const double slip = excess / (slider.k_s + slider.mu * slider.k_n * slider.tan_psi);
      slider.gap_closed += slip * slider.tan_psi;
      slider.F_s = std::copysign(slider.mu * slider.k_n * slider.gap_closed, slider.F_s);
    }
  }
  slider.leg((1.0 - done) * step.closure, (1.0 - done) * step.slide);
}

}  // namespace phy::theory
