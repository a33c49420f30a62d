// Closed forms over arrays: every argument may be a number or an array, broadcast as NumPy does.
#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "base/nan.hpp"
#include "python/module.hpp"
#include "theory/anisotropic_disc.hpp"
#include "theory/eq1_fit.hpp"
#include "theory/hondros.hpp"
#include "theory/jaeger_fit.hpp"
#include "theory/transverse_isotropy.hpp"

namespace phy::python {
namespace {

using py::literals::operator""_a;  // NOLINT(misc-unused-using-decls): clang-tidy 14 overlooks literals

const char* const goodman_source = R"(

Equivalent continuum of rock cut by one set of parallel joints (Duncan & Goodman 1968; R.E. Goodman, "Methods
of Geological Engineering in Discontinuous Rocks", West, 1976). docs/theory/goodman.md)";
const char* const jaeger_source = R"(

J.C. Jaeger, "Shear failure of anisotropic rocks", Geol. Mag. 97 (1960) 65-72. docs/theory/strength.md)";
const char* const amadei_source = R"(

Transversely isotropic rock, five constants: B. Amadei, "Importance of anisotropy when estimating and
measuring in situ stresses in rock", IJRMMS 33 (1996) 293-325. docs/theory/transverse-isotropy.md)";
const char* const hondros_source = R"(

G. Hondros, Aust. J. Appl. Sci. 10 (1959) 243-268. docs/theory/brazilian.md)";

void add_to_signature(std::string& names, const py::arg& a) {
  names += (names.empty() ? "" : ", ") + std::string(a.name);
}
void add_to_signature(std::string& names, const py::arg_v& a) {
  add_to_signature(names, static_cast<const py::arg&>(a));
  names += "=" + py::repr(a.value).cast<std::string>();
}
// The text, which is no argument.
void add_to_signature(std::string&, const char*) {}

const char* text_in(const char* text) { return text; }
template <class First, class... Rest>
const char* text_in(const First&, const Rest&... rest) {
  return text_in(rest...);
}

/// Adds a function whose text begins with its signature, as inspect.signature reads it. `extra`: arguments,
/// then the text.
template <class F, class... Extra>
void define(py::module_& m, const char* name, F&& f, const Extra&... extra) {
  std::string names;
  (add_to_signature(names, extra), ...);
  // This first line is what CPython cuts off as __text_signature__; editors complete by it.
  const std::string text = fmt::format("{}({})\n--\n\n{}", name, names, text_in(extra...));
  // pybind keeps the last text that it is given, so this one replaces the one among `extra`.
  m.def(name, std::forward<F>(f), extra..., text.c_str());
}

/// What a function is and where it comes from.
std::string doc(const char* what, const char* source) { return std::string(what) + source; }

void add_goodman(py::module_& m) {
  define(m, "goodman_E", py::vectorize([](double theta, double E, double K_n_delta, double K_s_delta) {
           // E(theta) does not depend on nu.
           return theory::goodman_E({E, K_n_delta, K_s_delta, 0.0}, theta);
         }),
         "theta"_a, "E"_a, "K_n_delta"_a, "K_s_delta"_a,
         doc(R"(Young's modulus [Pa] of jointed rock, load along y: Eq. 1.

theta: inclination of the planes [deg]; E: of the intact rock [Pa]; K_n_delta, K_s_delta: stiffness of the
joints times their spacing [Pa].)",
             goodman_source)
             .c_str());
  define(m, "goodman_nu",
         py::vectorize([](double theta, double E, double K_n_delta, double K_s_delta, double nu) {
           return theory::goodman_nu({E, K_n_delta, K_s_delta, nu}, theta);
         }),
         "theta"_a, "E"_a, "K_n_delta"_a, "K_s_delta"_a, "nu"_a,
         doc(R"(Apparent Poisson's ratio [1] of jointed rock in the plane of load and joint normal.

nu: of the intact rock; other arguments as of goodman_E.)",
             goodman_source)
             .c_str());
}

void add_amadei(py::module_& m) {
  define(m, "amadei_E",
         py::vectorize([](double theta, double E, double E_n, double nu, double nu_n, double G_n) {
           return theory::ti_E({E, E_n, nu, nu_n, G_n}, theta);
         }),
         "theta"_a, "E"_a, "E_n"_a, "nu"_a, "nu_n"_a, "G_n"_a,
         doc(R"(Young's modulus [Pa] of layered rock, load along y.

theta: inclination of the planes [deg]. E along and E_n normal to them [Pa]. nu in the plane, nu_n in the
plane under load normal to it [1]. G_n of planes normal to the bedding [Pa].)",
             amadei_source)
             .c_str());
  define(
      m, "amadei_nu",
      py::vectorize([](double theta, double E, double E_n, double nu, double nu_n, double G_n) {
        return theory::ti_nu({E, E_n, nu, nu_n, G_n}, theta);
      }),
      "theta"_a, "E"_a, "E_n"_a, "nu"_a, "nu_n"_a, "G_n"_a,
      doc("Apparent Poisson's ratio [1] of layered rock; arguments as of amadei_E.", amadei_source).c_str());
  define(m, "saint_venant_G", py::vectorize([](double E, double E_n, double nu_n) {
           return theory::saint_venant_G(E, E_n, nu_n);
         }),
         "E"_a, "E_n"_a, "nu_n"_a,
         "Saint-Venant's empirical shear modulus [Pa]: 1/G_n = 1/E + 1/E_n + 2 nu_n/E_n.");
}

void add_strengths(py::module_& m) {
  define(m, "coulomb_sigma_1", py::vectorize([](double cohesion, double friction, double sigma_3) {
           return theory::coulomb_sigma_1({cohesion, friction}, sigma_3);
         }),
         "cohesion"_a, "friction"_a, "sigma_3"_a = 0.0,
         "Peak sigma_1 [Pa] of isotropic Coulomb rock; cohesion [Pa], friction angle [deg], sigma_3 [Pa].");
  define(m, "weak_plane_sigma_1",
         py::vectorize([](double theta, double cohesion, double friction, double sigma_3) {
           return theory::weak_plane_sigma_1({cohesion, friction}, theta, sigma_3);
         }),
         "theta"_a, "cohesion"_a, "friction"_a, "sigma_3"_a = 0.0,
         doc(R"(sigma_1 [Pa] at which a plane of weakness slips; inf where it cannot.

theta: its inclination [deg]; cohesion [Pa] and friction angle [deg] of the plane; sigma_3 [Pa].)",
             jaeger_source)
             .c_str());
  define(m, "jaeger_sigma_1",
         py::vectorize([](double theta, double cohesion, double friction, double matrix, double sigma_3) {
           return theory::jaeger_sigma_1({cohesion, friction}, matrix, theta, sigma_3);
         }),
         "theta"_a, "cohesion"_a, "friction"_a, "matrix"_a, "sigma_3"_a = 0.0,
         doc(R"(Peak sigma_1 [Pa] of rock with a plane of weakness: slip on it, or failure of the matrix.

matrix: strength of the matrix at the same sigma_3 [Pa]; other arguments as of weak_plane_sigma_1.)",
             jaeger_source)
             .c_str());
}

/// A component of the stress on a diameter.
template <auto Diameter, auto Component>
auto component() {
  return py::vectorize([](double rho, double P, double diameter, double alpha) {
    // Thickness 1, as P is a force per thickness.
    return Diameter({diameter, 1.0, alpha, P}, rho).*Component;
  });
}

template <auto Diameter>
py::tuple on_diameter(const py::object& rho, const py::object& P, const py::object& diameter,
                      const py::object& alpha) {
  using S = theory::DiameterStress;
  // py::vectorize returns one array, and a stress has two components: one pass for each.
  const py::cpp_function x(component<Diameter, &S::sigma_x>()), y(component<Diameter, &S::sigma_y>());
  return py::make_tuple(x(rho, P, diameter, alpha), y(rho, P, diameter, alpha));
}

using Places = py::array_t<double>;

py::tuple disc_stress(const Places& x, const Places& y, const theory::AnisotropicDisc& disc) {
  const auto of = [&](double theory::DiscStress::*component) {
    return py::vectorize(
        // By reference: the disc is solved once for all places.
        [&disc, component](double at_x, double at_y) { return disc.at(at_x, at_y).*component; })(x, y);
  };
  using S = theory::DiscStress;
  return py::make_tuple(of(&S::x), of(&S::y), of(&S::xy));
}

void add_brazilian(py::module_& m) {
  define(m, "hondros_loaded_diameter", &on_diameter<theory::hondros_loaded_diameter>, "rho"_a, "P"_a,
         "diameter"_a, "alpha"_a,
         doc(R"(Stresses across and along the load [Pa] on the loaded diameter of an isotropic Brazilian disc.

Compression positive. rho: distance from the centre over the radius, |rho| <= 1; P: force per thickness [N/m];
diameter [m]; alpha: half the loaded arc [deg].)",
             hondros_source)
             .c_str());
  define(m, "hondros_cross_diameter", &on_diameter<theory::hondros_cross_diameter>, "rho"_a, "P"_a,
         "diameter"_a, "alpha"_a,
         doc("As hondros_loaded_diameter [Pa], on the diameter across the load.", hondros_source).c_str());
  define(m, "brazilian_strength", py::vectorize([](double P, double diameter, double thickness) {
           return theory::brazilian_strength(P, diameter, thickness);
         }),
         "P"_a, "diameter"_a, "thickness"_a = 1.0,
         "Indirect tensile strength 2 P/(pi D t) [Pa]; P [N], diameter and thickness [m].");
  const auto amadei_disc = [](const Places& x, const Places& y, double P, double diameter, double alpha,
                              double theta, double E, double E_n, double nu, double nu_n, double G_n) {
    // A disc is thin: nothing presses on its faces.
    const auto body = theory::plane_compliance({E, E_n, nu, nu_n, G_n}, theory::PlaneState::stress);
    return disc_stress(x, y, theory::AnisotropicDisc({theory::rotated(body, theta), diameter, alpha, P}));
  };
  define(m, "amadei_disc", amadei_disc, "x"_a, "y"_a, "P"_a, "diameter"_a, "alpha"_a, "theta"_a, "E"_a,
         "E_n"_a, "nu"_a, "nu_n"_a, "G_n"_a,
         R"(Stresses x, y, xy [Pa, compression positive] in a thin layered disc pressed along y.

x, y: places from its centre [m]; P: force per thickness [N/m]; diameter [m]; alpha: half the loaded arc
[deg]; theta: inclination of the layers [deg]; constants as of amadei_E. For the Brazilian test B. Amadei,
IJRMMS 33 (1996) 293-325, after S.G. Lekhnitskii, "Anisotropic Plates", Gordon & Breach, 1968.)");
}

py::dict fit_goodman(const std::vector<double>& theta, const std::vector<double>& moduli,
                     std::optional<double> E) {
  // The shorter list would be read beyond its end.
  if (theta.size() != moduli.size())
    throw InputError(Problem{"fit_goodman", "moduli", std::to_string(moduli.size()) + " values",
                             "one per inclination, " + std::to_string(theta.size()), ""});
  std::vector<theory::ModulusReading> readings;
  for (std::size_t i = 0; i < theta.size(); ++i) readings.push_back({theta[i], moduli[i]});
  theory::Eq1Options options;
  options.reference = E ? theory::Eq1Reference::given : theory::Eq1Reference::free;
  options.E = E.value_or(nan);
  const theory::Eq1Fit fit = theory::fit_eq1(readings, options);
  // NaN beside `ok` and `reason`: a fit that failed in a loop over rocks should not end the loop.
  const auto number = [&](double v) { return fit.ok() ? v : std::nan(""); };
  return py::dict("E"_a = number(fit.rock.E), "K_n_delta"_a = number(fit.rock.K_n_delta),
                  "K_s_delta"_a = number(fit.rock.K_s_delta), "R2"_a = number(fit.R2), "ok"_a = fit.ok(),
                  "reason"_a = fit.reason);
}

py::dict fit_jaeger(const std::vector<double>& theta, const std::vector<double>& ucs,
                    std::optional<double> matrix) {
  if (theta.size() != ucs.size())
    throw InputError(Problem{"fit_jaeger", "ucs", std::to_string(ucs.size()) + " values",
                             "one per inclination, " + std::to_string(theta.size()), ""});
  std::vector<theory::StrengthReading> readings;
  for (std::size_t i = 0; i < theta.size(); ++i) readings.push_back({theta[i], ucs[i]});
  const theory::JaegerFit fit =
      matrix ? theory::fit_jaeger(readings, *matrix) : theory::fit_jaeger_and_matrix(readings);
  const auto number = [&](double v) { return fit.ok ? v : std::nan(""); };
  return py::dict("cohesion"_a = number(fit.plane.cohesion), "friction"_a = number(fit.plane.friction),
                  "matrix"_a = number(fit.matrix_ucs), "R2"_a = number(fit.R2), "ok"_a = fit.ok,
                  "reason"_a = fit.reason);
}

}  // namespace

void add_theory(py::module_& m) {
  py::options own_signatures;
  // pybind's own line names C++ types, and hides the signature that define() writes.
  own_signatures.disable_function_signatures();
  m.doc() = R"(Closed forms, the independent witness.

Arguments are numbers or arrays, broadcast as NumPy does. theta is the inclination of the planes [deg], load
along y: 0 planes across the load, 90 along it. Papers with the angle between load and planes have
beta = 90 - theta.)";
  add_goodman(m), add_amadei(m), add_strengths(m), add_brazilian(m);
  define(m, "fit_goodman", &fit_goodman, "theta"_a, "moduli"_a, "E"_a = py::none(),
         doc(R"(Least squares of Eq. 1, in compliance, through moduli [Pa] at inclinations theta [deg].

E: of the intact rock [Pa]; left out: fitted too. A dict with E, K_n_delta, K_s_delta [Pa], R2, ok, reason.)",
             goodman_source)
             .c_str());
  define(
      m, "fit_jaeger", &fit_jaeger, "theta"_a, "ucs"_a, "matrix"_a = py::none(),
      doc(R"(Least squares of Jaeger's plane of weakness through strengths [Pa] at inclinations theta [deg].

matrix: strength of the matrix [Pa]; left out: fitted too. A dict with cohesion [Pa], friction [deg], matrix
[Pa], R2, ok, reason.)",
          jaeger_source)
          .c_str());
}

}  // namespace phy::python
