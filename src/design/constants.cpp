#include "design/constants.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace phy::design {
namespace {

using C = Constant;
using S = Scale;

constexpr std::array<ConstantInfo, n_constants> list = {{
    {C::E, "E", "E", "Pa", "Young's modulus along the planes of isotropy", S::logarithmic, 1e-9, "GPa", 2},
    {C::E_n, "E_n", "E'", "Pa", "Young's modulus normal to the planes", S::logarithmic, 1e-9, "GPa", 2},
    {C::nu, "nu", "nu", "1", "Poisson's ratio in the planes, under load in the planes", S::linear, 1.0, "",
     3},
    {C::nu_n, "nu_n", "nu'", "1", "strain along the planes over that across them, under load across them",
     S::linear, 1.0, "", 3},
    {C::G_n, "G_n", "G'", "Pa", "shear modulus of sections normal to the planes", S::logarithmic, 1e-9, "GPa",
     2},
    {C::c_j, "c_j", "c_j", "Pa", "cohesion of the planes", S::logarithmic, 1e-6, "MPa", 2},
    {C::phi_j, "phi_j", "phi_j", "deg", "friction angle of the planes", S::angle, 1.0, "deg", 1},
    {C::c, "c", "c", "Pa", "cohesion of the rock between the planes", S::logarithmic, 1e-6, "MPa", 2},
    {C::phi, "phi", "phi", "deg", "friction angle of the rock between the planes", S::angle, 1.0, "deg", 1},
    {C::sigma_tj, "sigma_tj", "sigma_tj", "Pa", "direct tensile strength across the planes", S::logarithmic,
     1e-6, "MPa", 2},
    {C::sigma_t, "sigma_t", "sigma_t", "Pa", "direct tensile strength along the planes", S::logarithmic, 1e-6,
     "MPa", 2},
    {C::sigma_ci, "sigma_ci", "sigma_ci", "Pa", "Hoek-Brown, strength without confinement", S::logarithmic,
     1e-6, "MPa", 1},
    {C::m, "m", "m", "1", "Hoek-Brown, m = k_beta m_i", S::logarithmic, 1.0, "", 2},
    {C::k_beta, "k_beta", "k_beta", "1", "m over m_i of planes across the load", S::logarithmic, 1.0, "", 3},
    {C::c_0, "c_0", "c_0", "Pa", "cohesion, mean over directions of the fabric", S::logarithmic, 1e-6, "MPa",
     2},
    {C::phi_0, "phi_0", "phi_0", "deg", "friction angle in all directions", S::angle, 1.0, "deg", 1},
    {C::omega, "omega", "Omega", "1", "fabric: first coefficient of the cohesion", S::linear, 1.0, "", 3},
    {C::omega_2, "omega_2", "Omega_2", "1", "fabric: second coefficient of the cohesion", S::linear, 1.0, "",
     3},
}};

}  // namespace

std::span<const ConstantInfo> constants() { return list; }
const ConstantInfo& info(Constant constant) { return list[static_cast<std::size_t>(constant)]; }

double inner(Constant constant, double value) {
  return info(constant).scale == Scale::logarithmic ? std::log(value) : value;
}
double outer(Constant constant, double x) {
  return info(constant).scale == Scale::logarithmic ? std::exp(x) : x;
}
double outer_end(Constant constant, double x) {
  return info(constant).scale == Scale::angle ? std::clamp(x, 0.0, 90.0) : outer(constant, x);
}
double outer_slope(Constant constant, double x) {
  return info(constant).scale == Scale::logarithmic ? std::exp(x) : 1.0;
}

}  // namespace phy::design
