#include "survey/closed_forms.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "maps/layered_table.hpp"
#include "theory/jaeger_fit.hpp"

namespace phy::survey {
namespace {

using Findings = std::vector<Finding>;

constexpr double least_R2 = 0.3;  // of a plane that shows

std::size_t n_angles(const std::vector<Target>& targets) {
  std::set<double> angles;
  for (const Target& t : targets) angles.insert(t.theta);
  return angles.size();
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

/// Standard errors only where there are degrees of freedom.
Finding stiffnesses(const theory::Eq1Fit& fit, const Recipe& model) {
  const bool shoulder = fit.shape.type == theory::CurveType::shoulder;
  Finding f{shoulder ? FindingKind::eq1_shoulder : FindingKind::eq1_incremental};
  f.numbers = {{"E", fit.rock.E}, {"K_n_delta", fit.rock.K_n_delta}, {"K_s_delta", fit.rock.K_s_delta}};
  if (fit.degrees_of_freedom > 0)
    f.numbers.insert(f.numbers.end(), {{"se_E", fit.se_E},
                                       {"se_K_n_delta", fit.se_K_n_delta},
                                       {"se_K_s_delta", fit.se_K_s_delta},
                                       {"R2", fit.R2}});
  if (!model.bedding.empty()) f.numbers.push_back({"spacing", model.bedding.front().spacing});
  if (shoulder)
    f.numbers.insert(f.numbers.end(), {{"least_E", fit.shape.E_min}, {"theta", fit.shape.theta_star}});
  return f;
}

Finding plane_of(const theory::JaegerFit& fit, const std::vector<Target>& ucs) {
  double squares = 0.0;
  for (const Target& t : ucs)
    squares += std::pow(theory::jaeger_sigma_1(fit.plane, fit.matrix_ucs, t.theta, 0.0) / t.mean - 1.0, 2.0);
  const theory::StrengthMinimum weakest = theory::weak_plane_minimum(fit.plane, 0.0);
  return {FindingKind::jaeger_plane,
          {},
          {{"c_w", fit.plane.cohesion},
           {"phi_w", fit.plane.friction},
           {"theta", weakest.theta},
           {"least", weakest.sigma_1},
           {"shoulders", fit.matrix_ucs},
           {"R2", fit.R2},
           {"rms", std::sqrt(squares / static_cast<double>(ucs.size()))}}};
}

}  // namespace

Findings eq1_through_moduli(const Evidence& evidence) {
  const std::vector<Target> moduli = of_property(least_confined(evidence.moduli), Property::E);
  if (n_angles(moduli) < 3) return {};
  const theory::Eq1Fit fit = maps::eq1_through(evidence);
  if (!fit.ok()) return {{FindingKind::eq1_none, {}, {}, {fit.reason}}};
  Findings found = {stiffnesses(fit, evidence.rock.model)};
  const Target& softest = *ends_of(moduli).least;
  const bool dips =
      std::any_of(moduli.begin(), moduli.end(), [&](const Target& t) { return t.theta < softest.theta; });
  // an E that grows with theta throughout does not hold a table that dips
  if (found.front().kind == FindingKind::eq1_incremental && dips)
    found.push_back({FindingKind::table_dips, {cell_of(softest)}});
  return found;
}

Findings plane_through_strengths(const Evidence& evidence) {
  const std::vector<Target> ucs = of_property(evidence.targets, Property::ucs);
  if (n_angles(ucs) < 4) return {};
  std::vector<theory::StrengthReading> readings;
  for (const Target& t : ucs) readings.push_back({t.theta, t.mean, 0.0});
  const theory::JaegerFit fit = theory::fit_jaeger_and_matrix(readings);
  Findings found;
  const std::string why = fit.no_plane();
  if (why.empty())
    found = {plane_of(fit, ucs)};
  else
    found = {{FindingKind::jaeger_none, {}, {}, {why}}};
  const Target& weakest = *ends_of(ucs).least;
  if (fit.ok && fit.R2 < least_R2) found.push_back({FindingKind::no_plane_shows, {}, {{"R2", fit.R2}}});
  // no plane slips most easily below 45 degrees, whatever its friction
  else if (fit.ok && !why.empty() && weakest.theta > 0.0 &&
           weakest.theta < theory::weak_plane_minimum({}, 0.0).theta)
    found.push_back({FindingKind::weakest_off_plane, {cell_of(weakest)}});
  return found;
}

Findings anisotropy(const Evidence& evidence) {
  Finding f{FindingKind::anisotropy};  // two cells of each property: of the largest value and the least
  for (const Property p : {Property::E, Property::ucs, Property::direct_tension, Property::brazilian}) {
    const std::vector<Target> targets = of_property(least_confined(evidence.targets), p);
    if (n_angles(targets) < 2) continue;
    const auto [least, most] = ends_of(targets);
    f.cells.insert(f.cells.end(), {cell_of(*most), cell_of(*least)});
    f.numbers.push_back({"ratio", most->mean / least->mean});
  }
  return f.cells.empty() ? Findings() : Findings{f};
}

Findings closed_forms(const Evidence& evidence) {
  Findings found;
  if (!evidence.rock.bedded) return found;
  for (const Findings& some :
       {eq1_through_moduli(evidence), plane_through_strengths(evidence), anisotropy(evidence)})
    found.insert(found.end(), some.begin(), some.end());
  return found;
}

}  // namespace phy::survey
