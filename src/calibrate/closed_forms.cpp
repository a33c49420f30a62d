#include "calibrate/closed_forms.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "theory/jaeger_fit.hpp"

namespace phy::calibrate {
namespace {

constexpr double least_R2 = 0.3;  // of a plane that shows

std::size_t n_angles(const std::vector<Target>& targets) {
  std::set<double> angles;
  for (const Target& t : targets) angles.insert(t.theta);
  return angles.size();
}

std::string in_GPa(double value, double error) {
  return fmt::format("{:.3g}{} GPa", value * 1e-9,
                     std::isfinite(error) ? fmt::format(" +- {:.2g}", error * 1e-9) : "");
}

/// The two ends of a property's course.
struct Ends {
  const Target *least, *most;
};
Ends ends_of(const std::vector<Target>& targets) {
  const auto [least, most] = std::minmax_element(
      targets.begin(), targets.end(), [](const Target& a, const Target& b) { return a.mean < b.mean; });
  return {&*least, &*most};
}

}  // namespace

std::string eq1_line(const Evidence& evidence) {
  const std::vector<Target> moduli = of_property(least_confined(evidence.moduli), Property::E);
  if (n_angles(moduli) < 3) return "";
  const theory::Eq1Fit fit = eq1_through(evidence);
  if (!fit.ok()) return "Eq. 1 through E: none, " + fit.reason;
  std::string text =
      fmt::format("Eq. 1 through E: E = {}, K_n delta = {}, K_s delta = {}", in_GPa(fit.rock.E, fit.se_E),
                  in_GPa(fit.rock.K_n_delta, fit.se_K_n_delta), in_GPa(fit.rock.K_s_delta, fit.se_K_s_delta));
  if (const auto& bedding = evidence.rock.model.bedding; !bedding.empty()) {
    const double delta = bedding.front().spacing;
    text += fmt::format(" (K_n = {:.0f}, K_s = {:.0f} GPa/m every {:.3g} mm)",
                        fit.rock.K_n_delta / delta * 1e-9, fit.rock.K_s_delta / delta * 1e-9, delta * 1e3);
  }
  text += fit.degrees_of_freedom > 0 ? fmt::format(", R2 = {:.3f}", fit.R2)
                                     : ", through three angles exactly: R2 tells nothing";
  if (fit.shape.type == theory::CurveType::shoulder)
    return text + fmt::format("; shoulder type, least E {:.3g} GPa at {:.0f} degrees", fit.shape.E_min * 1e-9,
                              fit.shape.theta_star);
  text += "; incremental type, E by it grows from 0 to 90 degrees";
  const double weakest = ends_of(moduli).least->theta;
  const bool dips =
      std::any_of(moduli.begin(), moduli.end(), [&](const Target& t) { return t.theta < weakest; });
  return dips ? text + fmt::format(", while that of the table is least at {:.0f} degrees", weakest) : text;
}

std::string jaeger_line(const Evidence& evidence) {
  const std::vector<Target> ucs = of_property(evidence.targets, Property::ucs);
  if (n_angles(ucs) < 4) return "";
  std::vector<theory::StrengthReading> readings;
  for (const Target& t : ucs) readings.push_back({t.theta, t.mean, 0.0});
  const theory::JaegerFit fit = theory::fit_jaeger_and_matrix(readings);
  if (const std::string why = fit.no_plane(); !why.empty()) {
    const std::string none = "Jaeger's plane of weakness through UCS: none, " + why;
    const double at = ends_of(ucs).least->theta;
    if (fit.ok && fit.R2 < least_R2) return none + ": no plane shows";
    const bool below = at > 0.0 && at < theory::weak_plane_minimum({}, 0.0).theta;
    return fit.ok && below
               ? none + fmt::format("; the table is weakest at {:g} degrees, which no such plane is", at)
               : none;
  }
  double squares = 0.0;
  for (const Target& t : ucs)
    squares += std::pow(theory::jaeger_sigma_1(fit.plane, fit.matrix_ucs, t.theta, 0.0) / t.mean - 1.0, 2.0);
  const theory::StrengthMinimum weakest = theory::weak_plane_minimum(fit.plane, 0.0);
  const std::string text = fmt::format(
      "Jaeger's plane of weakness through UCS: c_w = {:.3g} MPa, phi_w = {:.0f} degrees, weakest at {:.0f} "
      "degrees with {:.3g} MPa, shoulders {:.3g} MPa, R2 = {:.2f}, misses {:.0f} % (root mean square)",
      fit.plane.cohesion * 1e-6, fit.plane.friction, weakest.theta, weakest.sigma_1 * 1e-6,
      fit.matrix_ucs * 1e-6, fit.R2, 100.0 * std::sqrt(squares / static_cast<double>(ucs.size())));
  return fit.R2 < least_R2 ? text + ": no plane shows" : text;
}

std::string anisotropy_line(const Evidence& evidence) {
  std::string text;
  for (const Property p : {Property::E, Property::ucs, Property::direct_tension, Property::brazilian}) {
    const std::vector<Target> targets = of_property(least_confined(evidence.targets), p);
    if (n_angles(targets) < 2) continue;
    const auto [least, most] = ends_of(targets);
    text += fmt::format("{}{} {:.2f} ({:g} over {:g} degrees)", text.empty() ? "largest over least: " : ", ",
                        to_string(p), most->mean / least->mean, most->theta, least->theta);
  }
  return text;
}

std::vector<std::string> closed_forms(const Evidence& evidence) {
  std::vector<std::string> lines;
  if (!evidence.rock.bedded) return lines;
  for (const auto& line : {eq1_line(evidence), jaeger_line(evidence), anisotropy_line(evidence)})
    if (!line.empty()) lines.push_back(line);
  return lines;
}

}  // namespace phy::calibrate
