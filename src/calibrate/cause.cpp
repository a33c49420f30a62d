#include "calibrate/cause.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>

#include "base/check.hpp"
#include "base/nan.hpp"
#include "calibrate/margin.hpp"
#include "calibrate/toughness.hpp"

namespace phy::calibrate {
namespace {

constexpr double beyond_chance = 1.64;        // standard errors, 5 % to one side
constexpr double other_strength = 0.10;       // ratios of strengths that differ by as much differ
constexpr double worth_a_word = 0.15;         // share of the misfit
constexpr std::size_t fewest_of_a_whole = 3;  // angles
constexpr double widest_gap = 30.0;           // [deg] between angles of UCS

struct Cause {
  std::string text, next;
};

enum Part { moduli, compression, tension, initiation, toughness, n_parts };
constexpr std::array<Part, n_parts> all_parts = {moduli, compression, tension, initiation, toughness};

Part part_of(Property p) {
  return !is_strength(p)                     ? moduli
         : is_compressive(p)                 ? compression
         : is_read_before_ucs(p)             ? initiation
         : p == Property::fracture_toughness ? toughness
                                             : tension;
}

/// A miss in units of what passes without a word.
double scaled_error(const Comparison& c) { return miss_of(c) / margin(c); }

/// Standard errors of the logarithm of a mean: of the laboratory, of the model.
double of_laboratory(const Comparison& c) { return c.target.standard_error() / c.target.mean; }
double of_model(const Comparison& c) {
  return std::isfinite(c.sd) && c.n_packings > 0 ? c.sd / std::sqrt(c.n_packings) / c.mean : 0.0;
}

/// Every cell as it is judged: on unseen packings, else on those of the fit.
struct View {
  const Calibration& of;
  std::vector<Comparison> rows;
  std::array<double, n_parts> misfit = {};  ///< sums of squares

  explicit View(const Calibration& c) : of(c) {
    for (const Comparison& fit : c.fitted) {
      const Comparison* unseen = row_of(c.verification, fit.target);
      rows.push_back(unseen != nullptr && unseen->answered() ? *unseen : fit);
      if (rows.back().answered())
        misfit[part_of(fit.target.property)] += std::pow(scaled_error(rows.back()), 2.0);
    }
  }
  /// With an answer, by angle as they come.
  std::vector<Comparison> answered(Property p) const {
    std::vector<Comparison> some;
    for (const Comparison& c : rows)
      if (c.target.property == p && c.answered()) some.push_back(c);
    return some;
  }
  bool moduli_alone() const {
    return std::none_of(rows.begin(), rows.end(),
                        [](const Comparison& c) { return is_strength(c.target.property); });
  }
  const Comparison* at(Property p, double theta) const {
    for (const Comparison& c : rows)
      if (c.target.property == p && c.target.theta == theta && c.answered()) return &c;
    return nullptr;
  }
  double share(Part part) const {
    const double all = std::accumulate(misfit.begin(), misfit.end(), 0.0);
    return all > 0.0 ? misfit[part] / all : 0.0;
  }
};
using CauseRule = std::optional<Cause>(const View&);

constexpr const char* strengths_of_recipe = "the model's strengths are those of the recipe, not of the rock";

/// Planes that somebody asked for may have a better rival; else what the table could tell.
std::string other_layers(const View& v, const std::string& otherwise) {
  return !is_directed(v.of.layers) && !v.of.model_chosen
             ? "layers = \"choose\" in a rock file whose recipe has no layers: rivals have no plane, bridges "
               "between joints, or more than planes"
             : otherwise;
}

/// Nobody has compared flat joints where a matrix was asked for; they have no directions, and no sequence.
bool may_ask_for_flat_joints(const View& v) {
  return v.of.recipe.matrix.model == MatrixModel::parallel_bond && !v.of.model_chosen &&
         !of_parallel_bonds(v.of.layers) && v.of.method == CalibrationMethod::posterior;
}

// What is left where this model does not meet a strength.
constexpr const char* only_where_met = "take the model only at angles where it meets the table";
constexpr const char* without_ucs = "take UCS from the table: the models that were compared do not meet it";
constexpr const char* without_tension = "leave the tensile strengths out if compression is what matters";
bool gives_up(const std::string& next) {
  return next == only_where_met || next == without_ucs || next == without_tension;
}

/// What helps depends on whose chance the difference may be: the table's, that of the packings, nobody's.
std::string next_of(const View& v, bool table_is_certain, bool model_is_certain,
                    const std::string& more_specimens) {
  if (!table_is_certain) return more_specimens;
  if (!model_is_certain) return "smaller grains in the rock's recipe: the packings of these leave it open";
  const std::vector<Comparison> ucs = v.answered(Property::ucs);
  if (!std::all_of(ucs.begin(), ucs.end(), misses)) return only_where_met;
  return v.of.model_chosen                ? without_ucs
         : of_parallel_bonds(v.of.layers) ? "another model (layers)"
                                          : "another model (layers, --matrix)";
}

std::string weaker_in_tension(const View& v) {
  return may_ask_for_flat_joints(v) ? "--matrix flat_joint: flat joints break in tension at less of UCS"
                                    : without_tension;
}

/// A value at 90 over that at 0 degrees, of table and model, with the standard error of their logarithms.
struct EndRatio {
  double laboratory, model, noise_of_table, noise_of_model;
  double noise() const { return std::hypot(noise_of_table, noise_of_model); }
  double difference() const { return std::fabs(std::log(laboratory / model)); }
};
std::optional<EndRatio> end_ratio(const View& v, Property p) {
  const Comparison *a = nullptr, *b = nullptr;  // under one stress
  for (const Comparison& c : v.rows)
    if (const Comparison* across = v.at(p, 0.0); across != nullptr && a == nullptr && c.answered() &&
                                                 c.target.theta == 90.0 &&
                                                 same_test(c.target, across->target))
      a = &c, b = across;
  if (a == nullptr || b == nullptr || a->mean / b->mean <= 0.0 || a->target.mean / b->target.mean <= 0.0)
    return {};
  return EndRatio{a->target.mean / b->target.mean, a->mean / b->mean,
                  std::hypot(of_laboratory(*a), of_laboratory(*b)), std::hypot(of_model(*a), of_model(*b))};
}

/// Across and along the layers the compliance that nu/E stands for is one and the same.
std::optional<Cause> nu_of_no_body(const View& v) {
  const auto E = end_ratio(v, Property::E), nu = end_ratio(v, Property::nu);
  if (!E || !nu) return {};
  const double off = std::fabs(std::log(nu->laboratory / E->laboratory));
  if (off <= surely * std::hypot(E->noise_of_table, nu->noise_of_table)) return {};
  const bool nu_missed = std::any_of(v.rows.begin(), v.rows.end(), [](const Comparison& c) {
    return c.target.property == Property::nu && c.answered() && misses(c);
  });
  if (!nu_missed) return {};
  return Cause{fmt::format("nu(90)/nu(0) is {:.2f} in the table, where a layered elastic body has "
                           "E(90)/E(0) = {:.2f}",
                           nu->laboratory, E->laboratory),
               "check how nu was measured (it counts in the plane of load and dip), or leave it out"};
}

/// E too high or too low by one factor at all angles, beyond the chance of its mean. Specimens scatter each
/// for itself; packings are the same at every angle, so that their chance does not average out.
std::optional<Cause> moduli_as_a_whole(const View& v) {
  const std::vector<Comparison> E = v.answered(Property::E);
  if (E.size() < fewest_of_a_whole) return {};
  double sum = 0.0, specimens = 0.0, packings = 0.0;
  for (const Comparison& c : E) {
    sum += std::log(c.mean / c.target.mean);
    specimens += of_laboratory(c) * of_laboratory(c), packings += of_model(c);
  }
  const auto n = static_cast<double>(E.size());
  const double factor = std::exp(sum / n), noise = std::hypot(std::sqrt(specimens), packings) / n;
  if (std::fabs(sum / n) <= std::max(2.0 * tolerance(Property::E), surely * noise)) return {};
  return Cause{fmt::format("E as a whole is {:.2f} times that of the table", factor),
               v.of.method == CalibrationMethod::sequence
                   ? "the same table without --method sequence, which fits all moduli together"
                   : "check E_is, the part of the curve that the table's E is read from"};
}

/// Logarithms of E under the largest over E under the least confining stress, in the mean over the angles
/// that have both.
struct Stiffening {
  double table = 0.0, model = 0.0, variance = 0.0;
  double least = infinity, most = 0.0;  // [Pa]
  int n = 0;
  void add(const Comparison& low, const Comparison& high) {
    table += std::log(high.target.mean / low.target.mean), model += std::log(high.mean / low.mean), ++n;
    for (const Comparison* c : {&low, &high})
      variance += std::pow(of_laboratory(*c), 2.0) + std::pow(of_model(*c), 2.0);
    least = std::min(least, low.target.confining), most = std::max(most, high.target.confining);
  }
  double difference() const { return (table - model) / n; }
  double noise() const { return std::sqrt(variance) / n; }
  static std::string percent(double sum_of_logs, int n) {
    return fmt::format("{:+.0f} %", 100.0 * (std::exp(sum_of_logs / n) - 1.0));
  }
};

/// What confinement makes of E: in rock it closes cracks as well; bonds are as stiff under any stress.
std::optional<Cause> stiffening(const View& v) {
  Stiffening s;
  const std::vector<Comparison> E = v.answered(Property::E);  // by angle, then by stress
  for (std::size_t from = 0, to = 0; from < E.size(); from = to) {
    while (to < E.size() && E[to].target.theta == E[from].target.theta) ++to;
    if (to > from + 1) s.add(E[from], E[to - 1]);
  }
  if (s.n == 0 || std::fabs(s.difference()) <= std::max(2.0 * tolerance(Property::E), surely * s.noise()))
    return {};
  return Cause{
      fmt::format("from {:.3g} to {:.3g} MPa of confining stress E changes by {} in the table, by "
                  "{} in the model (its bonds are as stiff under any, only what opens or slips is not)",
                  s.least * 1e-6, s.most * 1e-6, Stiffening::percent(s.table, s.n),
                  Stiffening::percent(s.model, s.n)),
      "in the rock file `confining` with the stress that matters: E and nu under others are left "
      "out then"};
}

std::optional<Cause> modulus_ratio(const View& v) {
  const auto E = end_ratio(v, Property::E);
  if (!E || E->difference() <= std::max(2.0 * tolerance(Property::E), beyond_chance * E->noise())) return {};
  return Cause{fmt::format("E(90)/E(0) is {:.2f} in the table, {:.2f} in the model", E->laboratory, E->model),
               "check the angles of the table and E_is, the part of the curve that its E is read from"};
}

/// By the table's means and by the model's, beyond the chance of either.
bool stronger(const Comparison& a, const Comparison& b, double errors = beyond_chance) {
  return std::log(a.target.mean / b.target.mean) > errors * std::hypot(of_laboratory(a), of_laboratory(b));
}
bool stronger_in_model(const Comparison& a, const Comparison& b, double errors = beyond_chance) {
  return std::log(a.mean / b.mean) > errors * std::hypot(of_model(a), of_model(b));
}

/// A plane is weakest at 45 degrees plus half of its friction angle and alike to both sides of it (Jaeger,
/// theory/jaeger.hpp): of angles a < 45 and one between 45 and 90 - a the second is never the stronger one.
bool no_plane(const std::vector<Comparison>& ucs, const Comparison& weakest) {
  return std::any_of(ucs.begin(), ucs.end(), [&](const Comparison& c) {
    return c.target.theta >= 45.0 && c.target.theta <= 90.0 - weakest.target.theta && stronger(c, weakest);
  });
}

std::optional<Cause> weakest_angle(const View& v) {
  const std::vector<Comparison> ucs = v.answered(Property::ucs);
  if (ucs.size() < 3) return {};
  const Comparison& rock = *std::min_element(
      ucs.begin(), ucs.end(), [](const auto& a, const auto& b) { return a.target.mean < b.target.mean; });
  const Comparison& model =
      *std::min_element(ucs.begin(), ucs.end(), [](const auto& a, const auto& b) { return a.mean < b.mean; });
  if (!stronger(model, rock) || !stronger_in_model(rock, model)) return {};
  // of bonds with directions it is no reason
  const bool of_planes = v.of.layers == LayerModel::planes && no_plane(ucs, rock);
  return Cause{
      fmt::format("the model is weakest at {:g} degrees, the rock at {:g}{}", model.target.theta,
                  rock.target.theta, of_planes ? ": no single weak plane does that" : ""),
      other_layers(v, next_of(v, stronger(model, rock, surely), stronger_in_model(rock, model, surely),
                              fmt::format("more specimens at {:g} and {:g} degrees", rock.target.theta,
                                          model.target.theta)))};
}

std::optional<Cause> strength_ratio(const View& v) {
  const auto ucs = end_ratio(v, Property::ucs);
  if (!ucs || ucs->difference() <= std::max(other_strength, beyond_chance * ucs->noise())) return {};
  return Cause{fmt::format("UCS(0)/UCS(90) is {:.2f} in the table, {:.2f} in the model",
                           1.0 / ucs->laboratory, 1.0 / ucs->model),
               other_layers(v, next_of(v, ucs->difference() > surely * ucs->noise_of_table,
                                       ucs->difference() > surely * ucs->noise_of_model,
                                       "more specimens at 0 and 90 degrees"))};
}

std::string range(const std::vector<double>& some, const char* format = "{:.1f}") {
  const auto [low, high] = std::minmax_element(some.begin(), some.end());
  const std::string a = fmt::format(fmt::runtime(format), *low), b = fmt::format(fmt::runtime(format), *high);
  return a == b ? a : a + " ... " + b;
}

std::optional<Cause> ratio_to_tension(const View& v) {
  for (const Property p : {Property::brazilian, Property::direct_tension}) {
    std::vector<double> table, model;
    double squares = 0.0, farthest = 0.0, theta = 0.0;
    bool all_too_low = true, certain = false;  // certain: more specimens would not bring the farthest nearer
    for (const Comparison& t : v.answered(p)) {
      const Comparison* u = v.at(Property::ucs, t.target.theta);
      if (u == nullptr) continue;
      table.push_back(u->target.mean / t.target.mean), model.push_back(u->mean / t.mean);
      const double off = std::log(table.back() / model.back());
      const double noise =
          std::hypot(std::hypot(of_laboratory(t), of_laboratory(*u)), std::hypot(of_model(t), of_model(*u)));
      if (std::fabs(off) > farthest)
        farthest = std::fabs(off), theta = t.target.theta, certain = farthest > surely * noise;
      all_too_low = all_too_low && off > std::max(other_strength, beyond_chance * noise);
      squares += off * off;
    }
    if (table.empty() || std::sqrt(squares / static_cast<double>(table.size())) <= other_strength) continue;
    return Cause{fmt::format("UCS/{} is {} in the table, {} in the model{}", to_string(p), range(table),
                             range(model), all_too_low ? " (bonded discs are strong in tension)" : ""),
                 all_too_low ? weaker_in_tension(v)
                 : certain   ? without_tension
                             : fmt::format("more specimens of {} at {:g} degrees", to_string(p), theta)};
  }
  return {};
}

/// sigma_ci over UCS. Slits of flat joints lower it; so does a low tau_c, which other strengths decide.
std::optional<Cause> cracks_begin(const View& v) {
  std::vector<double> table, model;
  double squares = 0.0;
  bool all_too_high = true;
  for (const Comparison& ci : v.answered(Property::crack_initiation)) {
    const Comparison* u = v.at(Property::ucs, ci.target.theta);
    if (u == nullptr) continue;
    table.push_back(ci.target.mean / u->target.mean), model.push_back(ci.mean / u->mean);
    const double off = std::log(model.back() / table.back());
    all_too_high = all_too_high && off > beyond_chance * std::hypot(of_laboratory(ci), of_model(ci));
    squares += off * off;
  }
  if (table.empty() || std::sqrt(squares / static_cast<double>(table.size())) <= other_strength) return {};
  return Cause{fmt::format("sigma_ci/UCS is {} in the table, {} in the model", range(table, "{:.2f}"),
                           range(model, "{:.2f}")),
               all_too_high && may_ask_for_flat_joints(v)
                   ? "--matrix flat_joint: slits let cracks begin early"
                   : "check how sigma_ci was read (by crack volumetric strain here), or leave it out"};
}

/// K_Ic too high or too low by one factor, beyond the chance of its mean, where tension is met more nearly:
/// at the same strengths that is a matter of the size of the grains.
std::optional<Cause> toughness_of_grains(const View& v) {
  const std::vector<Comparison> rows = v.answered(Property::fracture_toughness);
  double sum = 0.0, squares = 0.0;
  for (const Comparison& c : rows) {
    sum += std::log(c.mean / c.target.mean);
    squares += std::pow(std::hypot(of_laboratory(c), of_model(c)), 2.0);
  }
  const auto n = static_cast<double>(rows.size());
  if (rows.empty() || v.share(tension) > v.share(toughness) ||
      std::fabs(sum / n) <= std::max(other_strength, beyond_chance * std::sqrt(squares) / n))
    return {};
  const double now = grain_size(v.of.recipe), other = grain_size_to_meet(rows, now);
  const std::string why = "(K_Ic grows with the root of their size at the same strengths)";
  return Cause{
      fmt::format("K_Ic as a whole is {:.2f} times that of the table", std::exp(sum / n)),
      can_hold(v.of.recipe, other)
          ? fmt::format("grains of {:.2g} mm in place of {:.2g} {}", other * 1e3, now * 1e3, why)
          : fmt::format("leave K_Ic out: it asks for grains of {:.2g} mm, which this specimen cannot hold {}",
                        other * 1e3, why)};
}

/// Packings that differ by more than passes without a word, and by half of what is missed or more. A value
/// that is farther off than two means over as many packings may lie apart is missed for another reason, and
/// so is nu where E is met: what packings differ by is told of E.
std::optional<Cause> scattered_packings(const View& v, Part part) {
  const double unit = tolerance(part == moduli        ? Property::E
                                : part == compression ? Property::ucs
                                : part == tension     ? Property::brazilian
                                : part == initiation  ? Property::crack_initiation
                                                      : Property::fracture_toughness);
  double squares = 0.0, missed = 0.0, missed_by_nu = 0.0;
  int n = 0;
  bool nu_missed = false, others_missed = false;
  for (const Comparison& c : v.rows) {
    if (part_of(c.target.property) != part || !c.answered() || !std::isfinite(c.sd)) continue;
    (c.target.property == Property::nu ? nu_missed : others_missed) |= misses(c);
    if (c.target.property == Property::nu) {
      missed_by_nu += std::pow(miss_of(c) / tolerance(Property::nu), 2.0);
      continue;
    }
    const double of_mean = c.sd / c.mean / std::sqrt(std::max(1, c.n_packings));
    if (std::fabs(c.error()) > surely * std::sqrt(2.0) * of_mean) return {};
    squares += std::pow(c.sd / c.mean / unit, 2.0), missed += std::pow(c.error() / unit, 2.0), ++n;
  }
  if (n == 0 || squares <= n || squares < 0.25 * missed || missed_by_nu > missed) return {};
  if (nu_missed && !others_missed) return {};
  return Cause{fmt::format("packings of this grain size differ by {:.0f} % from each other, the model from "
                           "the table by {:.0f} %",
                           100.0 * unit * std::sqrt(squares / n), 100.0 * unit * std::sqrt(missed / n)),
               "smaller grains in the rock's recipe (packing.radius_min, packing.radius_max)"};
}

std::string shown(const Target& t, double value) {
  const ShownUnit unit = shown_unit(t.property);
  if (t.property == Property::nu) return fmt::format("{:.3f}", value);
  return fmt::format("{:.{}f} {}", value * unit.factor, t.property == Property::fracture_toughness ? 2 : 1,
                     unit.name);
}

Cause farthest_cell(const View& v, Part part) {
  const Comparison* worst = nullptr;
  for (const Comparison& c : v.rows)
    if (part_of(c.target.property) == part && c.answered() &&
        (worst == nullptr || std::fabs(scaled_error(c)) > std::fabs(scaled_error(*worst))))
      worst = &c;
  PHY_CHECK(worst != nullptr, "a part that misses has a value that was answered");
  const Target& t = worst->target;
  return {fmt::format("farthest off is {}, {} instead of {}", cell_name(t), shown(t, worst->mean),
                      shown(t, t.mean)),
          fmt::format("check {} in the table, or test more specimens there", cell_name(t))};
}

Cause cause_of(const View& v, Part part) {
  const std::array<std::vector<CauseRule*>, n_parts> rules = {
      {{nu_of_no_body, stiffening, moduli_as_a_whole, modulus_ratio},
       {weakest_angle, strength_ratio},
       {ratio_to_tension},
       {cracks_begin},
       {toughness_of_grains}}};
  for (CauseRule* rule : rules[part])
    if (const auto cause = rule(v)) return *cause;
  if (const auto cause = scattered_packings(v, part)) return *cause;
  return farthest_cell(v, part);
}

/// Parts with a share worth a word, the largest first.
std::vector<Part> ranked(const View& v) {
  std::vector<Part> parts;
  for (const Part p : all_parts)
    if (v.share(p) >= worth_a_word) parts.push_back(p);
  std::stable_sort(parts.begin(), parts.end(), [&](Part a, Part b) { return v.misfit[a] > v.misfit[b]; });
  return parts;
}

std::string name_of(const View& v, Part part) {
  std::vector<std::string> names;
  for (const Comparison& c : v.rows)
    if (const std::string name = to_string(c.target.property);
        part_of(c.target.property) == part && std::find(names.begin(), names.end(), name) == names.end())
      names.push_back(name);
  return fmt::format("{}", fmt::join(names, " and "));
}

/// Values without any answer of the model.
std::string unanswered(const View& v) {
  std::vector<std::string> cells;
  for (const Comparison& c : v.of.fitted) {
    const Comparison* unseen = row_of(v.of.verification, c.target);
    if (!c.answered() || (unseen != nullptr && !unseen->answered())) cells.push_back(cell_name(c.target));
  }
  return fmt::format("{}", fmt::join(cells, ", "));
}

/// Neighbours in theta with UCS that nothing lies between for far.
std::string gap_of(const View& v) {
  std::vector<double> angles;
  for (const Comparison& c : v.answered(Property::ucs)) angles.push_back(c.target.theta);
  std::sort(angles.begin(), angles.end());
  for (std::size_t i = 1; i < angles.size(); ++i)
    if (angles[i] - angles[i - 1] > widest_gap)
      return fmt::format("no UCS between {:g} and {:g} degrees", angles[i - 1], angles[i]);
  return "";
}

/// "E within 1.7 %, UCS within 3.7 %".
std::string misses_text(const View& v) {
  std::vector<std::string> list;
  for (int i = 0; i < n_properties; ++i) {
    const auto p = static_cast<Property>(i);
    double most = -1.0;
    for (const Comparison& c : v.answered(p))
      most = std::max(most, std::fabs(p == Property::nu ? c.mean - c.target.mean : 100.0 * c.error()));
    if (most >= 0.0)
      list.push_back(p == Property::nu ? fmt::format("nu within {:.3f}", most)
                                       : fmt::format("{} within {:.1f} %", to_string(p), most));
  }
  return fmt::format("{}", fmt::join(list, ", "));
}

/// Of a search without all points of a usual one; else empty.
std::string short_search(const Calibration& c) {
  if (c.longer_by.empty()) return "";
  return fmt::format(
      "the search was short ({} tests in compression in all{}; longer with {} in a new folder)",
      c.n_strength_tests - c.n_tension_tests,
      c.discarded.empty() ? "" : fmt::format(" by {} models", c.discarded.size() + 1), c.longer_by);
}

/// What remains open of a model that meets its table, and which test would close most of it.
std::string good_news(const View& v) {
  const Calibration& c = v.of;
  std::string text = fmt::format("{} of the table{}", misses_text(v),
                                 c.verification.empty() ? "" : " on packings the fit has not seen");
  std::vector<std::string> open, next;
  for (const ParameterEstimate& e : c.parameters) {
    if (!e.open()) continue;
    open.push_back(e.symbol);
    if (e.next.remedy != Remedy::none) next.push_back(text_of(e.next));
  }
  const std::string gap = gap_of(v);
  if (v.moduli_alone()) text += std::string("; ") + strengths_of_recipe;
  text += c.method == CalibrationMethod::sequence ? "; a sequence does not tell what its data leave open"
          : open.empty()                          ? "; the data determine every parameter"
                         : fmt::format("; its data leave {} open", fmt::join(open, ", "));
  if (!gap.empty()) text += "; " + gap;
  if (!c.longer_by.empty()) text += "; " + short_search(c);
  if (!next.empty()) return text + "; next: " + next.front();
  return text + (v.moduli_alone() ? "; next: a calibration with strengths"
                 : gap.empty()    ? "; next: run it (calibrated.toml)"
                                  : "; next: specimens in that gap");
}

bool is_coarse(const Comparison& c) { return c.answered() && !misses(c) && unresolved(c); }

/// A table that is met where misses that matter would pass for chance.
std::string coarse_news(const View& v) {
  std::vector<std::string> cells;
  bool specimens_help = true;
  for (const Comparison& c : v.rows)
    if (is_coarse(c)) {
      cells.push_back(cell_name(c.target));
      specimens_help = specimens_help && specimens_missing(c).has_value();
    }
  const std::string cut = short_search(v.of);
  return fmt::format(
      "{} of the table, but at {} a miss that matters could not be told from chance{}{}{}; next: {}",
      misses_text(v), fmt::join(cells, ", "), v.moduli_alone() ? std::string("; ") + strengths_of_recipe : "",
      cut.empty() ? "" : "; ", cut,
      specimens_help ? "more specimens there (the findings say how many)"
                     : "smaller grains in the rock's recipe, since packings differ too much");
}

/// What most of the misfit is about.
std::string bad_news(const View& v) {
  std::vector<std::string> clauses;
  std::string next;
  if (const std::string cells = unanswered(v); !cells.empty())
    clauses.push_back("the model has no answer for " + cells), next = "the findings say why";
  for (const Part part : ranked(v)) {
    if (clauses.size() == 2) break;
    const Cause cause = cause_of(v, part);
    const std::string share = v.share(part) == 1.0 ? "the misfit is"
                                                   : fmt::format("{:.0f} %{}", 100.0 * v.share(part),
                                                                 next.empty() ? " of the misfit is" : "");
    clauses.push_back(fmt::format("{} in {}: {}", share, name_of(v, part), cause.text));
    if (next.empty()) next = cause.next;
  }
  if (v.of.verdict.status == VerdictStatus::out_of_reach && !v.of.rival.empty() && gives_up(next))
    next = v.of.rival;
  if (!v.of.longer_by.empty()) {
    clauses.push_back(short_search(v.of));
    const std::vector<Part> parts = ranked(v);
    if (parts.empty() || parts.front() != moduli) next = "a new folder with " + v.of.longer_by;
  }
  if (const auto n = std::count_if(v.rows.begin(), v.rows.end(), is_coarse);
      n > 0 && v.of.verdict.status != VerdictStatus::out_of_reach)
    clauses.push_back(fmt::format("{} of {} values are not resolved", n, v.rows.size()));
  if (clauses.empty()) clauses = v.of.verdict.findings;
  if (v.moduli_alone()) clauses.emplace_back(strengths_of_recipe);
  return fmt::format("{}; next: {}", fmt::join(clauses, "; "), next.empty() ? "see the findings" : next);
}

}  // namespace

std::string verdict_sentence(const Calibration& c) {
  const std::string status = to_string(c.verdict.status);
  if (c.verdict.status == VerdictStatus::interrupted)
    return status + ": finished tests are in the store; next: the same command with --resume";
  const View view(c);
  if (c.verdict.status == VerdictStatus::calibrated) return status + ": " + good_news(view);
  if (c.verdict.status == VerdictStatus::not_resolved) return status + ": " + coarse_news(view);
  return status + ": " + bad_news(view);
}

}  // namespace phy::calibrate
