// Histories whose numbers are known by construction.
#pragma once
#include <cmath>
#include <string>

#include "analysis/analyse.hpp"

namespace phy::analysis {

/// Straight line of modulus E and Poisson's ratio nu up to ucs in n rows, then down to half of it in n/2
/// rows. The gauge reads 0.9 of the platen strain.
inline History straight(double E, double nu, double ucs, int n) {
  History h;
  for (int i = 1; i <= n + n / 2; ++i) {
    HistoryRow r;
    r.axial_strain = ucs / E * i / n;
    r.axial_stress = i <= n ? E * r.axial_strain : ucs * (1.0 - static_cast<double>(i - n) / n);
    r.axial_strain_gauge = 0.9 * r.axial_strain;
    r.lateral_strain_gauge = -nu * r.axial_strain_gauge;
    r.stress_top = r.stress_bottom = r.axial_stress;
    r.boundary_work = i;
    r.strain_bond = 0.5 * i;
    h.rows.push_back(r);
  }
  return h;
}

/// Marble of the tests: E 50 GPa (platens), nu 0.25, ucs 100 MPa at a strain of 0.002 in row 199.
inline History marble() { return straight(50e9, 0.25, 100e6, 200); }

/// The same up to the largest stress: no peak.
inline History unfinished() {
  History h = marble();
  h.rows.resize(200);
  return h;
}

inline double value(const std::vector<Number>& numbers, const std::string& name) {
  const Number* n = find(numbers, name);
  return n != nullptr ? n->value : -1.0;
}
inline std::string note(const std::vector<Number>& numbers, const std::string& name) {
  const Number* n = find(numbers, name);
  return n != nullptr ? n->note : "no number " + name;
}

}  // namespace phy::analysis
