// Rules of the strengths.
#include <algorithm>
#include <cmath>

#include "records/evidence.hpp"
#include "verdict/causes.hpp"
#include "verdict/cells.hpp"
#include "verdict/grain_size.hpp"

namespace phy::verdict {
namespace {

/// Nobody has compared flat joints where a matrix was asked for; they have no directions, and no sequence.
bool may_ask_for_flat_joints(const View& v) {
  return v.of.recipe.matrix.model == MatrixModel::parallel_bond && !v.of.model_chosen &&
         !of_parallel_bonds(v.of.layers) && v.of.method == CalibrationMethod::posterior;
}

/// Planes that somebody asked for may have a better rival, where the table can compare them. Else what helps
/// depends on whose chance the difference may be: the table's, that of the packings, nobody's.
Advice advice_on_ucs(const View& v, bool table_is_certain, bool model_is_certain) {
  if (!is_directed(v.of.layers) && !v.of.model_chosen && shows_layers(v.strengths()))
    return Advice::choose_layers;
  if (!table_is_certain) return Advice::more_specimens;
  if (!model_is_certain) return Advice::smaller_grains;
  if (v.meets_some(Property::ucs)) return Advice::take_where_met;
  const Finding* maps = first_of(v.of.verdict.findings, FindingKind::nearest_in_maps);
  const bool none_nearer = maps != nullptr && maps->advice == Advice::none;
  return v.of.model_chosen || none_nearer ? Advice::leave_out_ucs
         : of_parallel_bonds(v.of.layers) ? Advice::other_layers
                                          : Advice::other_layers_or_matrix;
}

/// By the table's means and by the model's, beyond the chance of either.
bool stronger(const Comparison& a, const Comparison& b, double errors = z_one_sided_95) {
  return std::log(a.target.mean / b.target.mean) >
         errors * std::hypot(error_of_laboratory(a), error_of_laboratory(b));
}
bool stronger_in_model(const Comparison& a, const Comparison& b, double errors = z_one_sided_95) {
  return std::log(a.mean / b.mean) > errors * std::hypot(error_of_model(a), error_of_model(b));
}

/// A plane is weakest at 45 degrees plus half of its friction angle and alike to both sides of it (Jaeger,
/// theory/jaeger.hpp): of angles a < 45 and one between 45 and 90 - a the second is never the stronger one.
bool no_plane(const std::vector<Comparison>& ucs, const Comparison& weakest) {
  return std::any_of(ucs.begin(), ucs.end(), [&](const Comparison& c) {
    return c.target.theta >= 45.0 && c.target.theta <= 90.0 - weakest.target.theta && stronger(c, weakest);
  });
}

/// Ratios of two values at the same angles, of table and model.
struct Ratios {
  std::vector<double> laboratory, model;
  double squares = 0.0;  ///< of the logarithms of their quotients
  /// Adds one and returns the logarithm of the table's over the model's.
  double add(double of_laboratory, double of_model) {
    laboratory.push_back(of_laboratory), model.push_back(of_model);
    const double off = std::log(of_laboratory / of_model);
    squares += off * off;
    return off;
  }
  bool differ() const {
    return !laboratory.empty() && std::sqrt(squares / static_cast<double>(model.size())) > least_change;
  }
  std::vector<NamedNumber> numbers() const {
    const auto [low, high] = std::minmax_element(laboratory.begin(), laboratory.end());
    const auto [model_low, model_high] = std::minmax_element(model.begin(), model.end());
    return {{"laboratory_low", *low},
            {"laboratory_high", *high},
            {"model_low", *model_low},
            {"model_high", *model_high}};
  }
};

/// UCS over a tension where no specimen of the model has that of the table, beyond its error: it says what
/// the model cannot have at once, not which of both is off.
struct RatioBeyond {
  const Comparison *tension, *ucs;
  const Finding* in_maps;
  double beyond;  ///< logarithm
};

std::optional<RatioBeyond> farthest_beyond(Property p, const View& v) {
  std::optional<RatioBeyond> worst;
  for (const JudgedCell& c : v.cells) {
    if (c.row.target.property != p || !c.row.answered()) continue;
    const Comparison* u = v.at(Property::ucs, c.row.target.theta);
    const Finding* in_maps = v.in_maps(FindingKind::map_ratio, c.row.target);
    if (u == nullptr || in_maps == nullptr) continue;
    const double ratio = in_maps->number("laboratory"),
                 off = std::log(std::max(ratio / in_maps->number("high"), in_maps->number("low") / ratio)),
                 error = std::hypot(error_of_laboratory(c.row), error_of_laboratory(*u));
    if (off > z_one_sided_95 * error && (!worst || off > worst->beyond)) worst = {&c.row, u, in_maps, off};
  }
  return worst;
}

std::optional<Finding> ratio_beyond(Property p, const View& v) {
  const auto worst = farthest_beyond(p, v);
  if (!worst) return {};
  const Finding& maps = *worst->in_maps;
  return Finding{FindingKind::tension_ratio,
                 {cell_of(worst->tension->target)},
                 {{"laboratory", maps.number("laboratory")},
                  {"low", maps.number("low")},
                  {"high", maps.number("high")},
                  {"ucs", worst->ucs->error()},
                  {"tension", worst->tension->error()}},
                 {},
                 maps.number("flat_joints") > 0.0 && may_ask_for_flat_joints(v) ? Advice::flat_joints
                                                                                : Advice::leave_out_tension};
}

}  // namespace

std::optional<Finding> weakest_angle(const View& v) {
  const std::vector<Comparison> ucs = v.answered(Property::ucs);
  if (ucs.size() < 3) return {};
  const Comparison& rock = *std::min_element(
      ucs.begin(), ucs.end(), [](const auto& a, const auto& b) { return a.target.mean < b.target.mean; });
  const Comparison& model =
      *std::min_element(ucs.begin(), ucs.end(), [](const auto& a, const auto& b) { return a.mean < b.mean; });
  if (!stronger(model, rock) || !stronger_in_model(rock, model)) return {};
  // of bonds with directions it is no reason
  const bool of_planes = v.of.layers == LayerModel::planes && no_plane(ucs, rock);
  return Finding{of_planes ? FindingKind::weakest_angle_no_plane : FindingKind::weakest_angle,
                 {cell_of(rock.target), cell_of(model.target)},
                 {},
                 {},
                 advice_on_ucs(v, stronger(model, rock, z_99), stronger_in_model(rock, model, z_99))};
}

std::optional<Finding> ucs_ratio(const View& v) {
  const auto ucs = v.end_ratio(Property::ucs);
  if (!ucs || ucs->difference() <= std::max(least_change, z_one_sided_95 * ucs->error())) return {};
  return Finding{FindingKind::ucs_ratio,
                 {{Property::ucs, 0.0}, {Property::ucs, 90.0}},
                 {{"laboratory", 1.0 / ucs->laboratory}, {"model", 1.0 / ucs->model}},
                 {},
                 advice_on_ucs(v, ucs->difference() > z_99 * ucs->error_of_laboratory,
                               ucs->difference() > z_99 * ucs->error_of_model)};
}

std::optional<Finding> tension_ratio(const View& v) {
  // Brazilian strength first: of the tests that a table holds it is the most frequent one
  for (const Property p : {Property::brazilian, Property::direct_tension, Property::point_load})
    if (const auto cause = ratio_beyond(p, v)) return cause;
  return {};
}

std::optional<Finding> expected_in_maps(const View& v, Part part) {
  const JudgedCell* worst = v.farthest(part);
  if (worst == nullptr) return {};
  const Comparison& row = worst->row;
  const Finding* maps = v.in_maps(FindingKind::map_expected, row.target);
  if (maps == nullptr || !is_strength(row.target.property)) return {};
  // half of the miss or more, to the same side, and more than the maps' quadratics are off by
  const double missed = std::log(row.mean / row.target.mean),
               expected = std::log(maps->number("model") / row.target.mean);
  if (expected / missed < 0.5 || std::fabs(expected) < maps->number("error")) return {};
  return Finding{FindingKind::expected_in_maps,
                 {cell_of(row.target)},
                 {{"model", row.mean},
                  {"laboratory", row.target.mean},
                  {"expected", maps->number("model")},
                  {"error", maps->number("error")}},
                 {},
                 is_tensile(row.target.property) ? Advice::leave_out_tension : advice_on_ucs(v, true, true)};
}

bool search_can_help(const View& v) {
  constexpr double times_nearer = 1.1;  // as other models are compared (maps/placing.hpp)
  if (!v.of.shortage.may_be_longer() || v.of.shortage.settled ||
      v.of.verdict.status == VerdictStatus::out_of_reach)
    return false;
  double missed = 0.0, expected = 0.0;
  bool beyond = false, mapped = false;
  for (const JudgedCell& c : v.cells) {
    const Property p = c.row.target.property;
    if (!is_strength(p)) continue;
    if (!c.row.answered()) return true;
    beyond = beyond || std::fabs(miss_of(c.row)) > tolerance(p);
    const Finding* maps = v.in_maps(FindingKind::map_expected, c.row.target);
    if (maps == nullptr) continue;
    mapped = true;
    missed += std::pow(miss_of(c.row) / tolerance(p), 2.0);
    expected += std::pow((maps->number("model") / c.row.target.mean - 1.0) / tolerance(p), 2.0);
  }
  return beyond && (!mapped || times_nearer * std::sqrt(expected) < std::sqrt(missed));
}

/// sigma_ci over UCS. Slits of flat joints lower it; so does a low tau_c, which other strengths decide.
std::optional<Finding> initiation_ratio(const View& v) {
  Ratios ratios;
  bool all_too_high = true;
  for (const Comparison& ci : v.answered(Property::crack_initiation)) {
    const Comparison* u = v.at(Property::ucs, ci.target.theta);
    if (u == nullptr) continue;
    const double off = ratios.add(ci.target.mean / u->target.mean, ci.mean / u->mean);
    all_too_high =
        all_too_high && -off > z_one_sided_95 * std::hypot(error_of_laboratory(ci), error_of_model(ci));
  }
  if (!ratios.differ()) return {};
  return Finding{FindingKind::initiation_ratio,
                 {},
                 ratios.numbers(),
                 {},
                 all_too_high && may_ask_for_flat_joints(v) ? Advice::slits : Advice::check_initiation};
}

/// K_Ic too high or too low by one factor, beyond the chance of its mean, where tension is met more nearly:
/// at the same strengths that is a matter of the size of the grains.
std::optional<Finding> grains_for_toughness(const View& v) {
  const std::vector<Comparison> rows = v.answered(Property::fracture_toughness);
  double sum = 0.0, squares = 0.0;
  for (const Comparison& c : rows) {
    sum += std::log(c.mean / c.target.mean);
    squares += std::pow(std::hypot(error_of_laboratory(c), error_of_model(c)), 2.0);
  }
  const auto n = static_cast<double>(rows.size());
  if (rows.empty() || v.share(Part::tension) > v.share(Part::toughness) ||
      std::fabs(sum / n) <= std::max(least_change, z_one_sided_95 * std::sqrt(squares) / n))
    return {};
  const double now = grain_size(v.of.recipe), wanted = grain_size_to_meet(rows, now);
  return Finding{FindingKind::grains_for_toughness,
                 {},
                 {{"factor", std::exp(sum / n)}, {"grain_size", now}, {"wanted", wanted}},
                 {},
                 can_hold(v.of.recipe, wanted) ? Advice::other_grains : Advice::leave_out_toughness};
}

}  // namespace phy::verdict
