// Rules of E and nu.
#include <algorithm>
#include <cmath>

#include "base/nan.hpp"
#include "verdict/causes.hpp"
#include "verdict/cells.hpp"

namespace phy::verdict {
namespace {

constexpr std::size_t fewest_of_a_whole = 3;  // angles

/// Logarithms of E under the largest over E under the least confining stress, in the mean over the angles
/// that have both.
struct Stiffening {
  double table = 0.0, model = 0.0, variance = 0.0;
  int n = 0;
  void add(const Comparison& low, const Comparison& high) {
    table += std::log(high.target.mean / low.target.mean), model += std::log(high.mean / low.mean), ++n;
    for (const Comparison* c : {&low, &high})
      variance += std::pow(error_of_laboratory(*c), 2.0) + std::pow(error_of_model(*c), 2.0);
  }
  double difference() const { return (table - model) / n; }
  double error() const { return std::sqrt(variance) / n; }
  double change(double sum_of_logs) const { return std::exp(sum_of_logs / n) - 1.0; }
};

}  // namespace

/// Across and along the layers the compliance that nu/E stands for is one and the same.
std::optional<Finding> nu_of_no_body(const View& v) {
  const auto E = v.end_ratio(Property::E), nu = v.end_ratio(Property::nu);
  if (!E || !nu) return {};
  const double off = std::fabs(std::log(nu->laboratory / E->laboratory));
  if (off <= z_99 * std::hypot(E->error_of_laboratory, nu->error_of_laboratory)) return {};
  if (!v.misses_some(Property::nu)) return {};
  return Finding{
      FindingKind::nu_of_no_body, {}, {{"nu", nu->laboratory}, {"E", E->laboratory}}, {}, Advice::check_nu};
}

/// The closed form of a layered body has said it of the table, before any model.
std::optional<Finding> of_no_body(const View& v) {
  const Finding* found = first_of(v.of.verdict.findings, FindingKind::no_layered_body);
  if (found == nullptr) found = first_of(v.of.verdict.findings, FindingKind::one_cell_of_no_body);
  if (found == nullptr) return {};
  Finding cause = *found;
  if (cause.advice == Advice::none) cause.advice = Advice::check_value;
  return cause;
}

/// What was tried: nu on grains half as large (calibrate/finer_grains.hpp).
std::optional<Finding> finer_grains(const View& v) {
  const Finding* found = first_of(v.of.reach, FindingKind::grains_for_nu);
  return found != nullptr ? std::optional(*found) : std::nullopt;
}

/// What confinement makes of E: in rock it closes cracks as well; bonds are as stiff under any stress.
std::optional<Finding> stiffening(const View& v) {
  Stiffening s;
  const std::vector<Comparison> E = v.answered(Property::E);  // by angle, then by stress
  for (std::size_t from = 0, to = 0; from < E.size(); from = to) {
    while (to < E.size() && E[to].target.theta == E[from].target.theta) ++to;
    if (to > from + 1) s.add(E[from], E[to - 1]);
  }
  // a model that stiffens more than the rock lacks no cracks
  if (s.n == 0 || s.difference() <= std::max(2.0 * tolerance(Property::E), z_99 * s.error())) return {};
  return Finding{FindingKind::stiffening,
                 {},
                 {{"laboratory", s.change(s.table)}, {"model", s.change(s.model)}},
                 {},
                 Advice::one_confinement};
}

/// E too high or too low by one factor at all angles, beyond the chance of its mean. Specimens scatter each
/// for itself; packings are the same at every angle, so that their chance does not average out.
std::optional<Finding> moduli_scaled(const View& v) {
  const std::vector<Comparison> E = v.answered(Property::E);
  if (E.size() < fewest_of_a_whole) return {};
  double sum = 0.0, specimens = 0.0, packings = 0.0;
  for (const Comparison& c : E) {
    sum += std::log(c.mean / c.target.mean);
    specimens += error_of_laboratory(c) * error_of_laboratory(c), packings += error_of_model(c);
  }
  const auto n = static_cast<double>(E.size());
  const double error = std::hypot(std::sqrt(specimens), packings) / n;
  if (std::fabs(sum / n) <= std::max(2.0 * tolerance(Property::E), z_99 * error)) return {};
  return Finding{FindingKind::moduli_scaled,
                 {},
                 {{"factor", std::exp(sum / n)}},
                 {},
                 v.of.method == CalibrationMethod::sequence ? Advice::without_sequence : Advice::check_E_is};
}

std::optional<Finding> modulus_ratio(const View& v) {
  const auto E = v.end_ratio(Property::E);
  if (!E || E->difference() <= std::max(2.0 * tolerance(Property::E), z_one_sided_95 * E->error())) return {};
  return Finding{FindingKind::modulus_ratio,
                 {},
                 {{"laboratory", E->laboratory}, {"model", E->model}},
                 {},
                 Advice::check_angles};
}

}  // namespace phy::verdict
