#include "maps/model_choice.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <utility>

#include "verdict/cells.hpp"

namespace phy::maps {
namespace {

using verdict::modulus_limit;

// Of the error of the others, from where on flat joints are taken. Most tables do not tell the two apart: of
// eight rocks of parallel bonds by planes three, by a little, are predicted better by flat joints, and of
// eight of flat joints five by parallel bonds, which know more models of the layers and cost half as much.
constexpr double flat_joint_gain = 0.75;
// Of the error of planes alone, from where on directions between planes, or bridges, are taken, which contain
// them: what has more to fit with is often a little better by chance.
constexpr double nested_gain = 0.9;
// Of the error of the best share, up to where another may be that of the rock (docs/calibration.md, "Which
// model of the layers").
constexpr double share_tolerance = 1.2;
// Likewise, up to where a model of another kind is worth a calibration of its own.
constexpr double rival_tolerance = 1.25;

/// Does a model that contains another, and has E as that has or misses it, miss hardly less?
bool is_barred(const Rival& one, const std::vector<Rival>& rivals) {
  const auto inner = std::find_if(rivals.begin(), rivals.end(),
                                  [&](const Rival& r) { return one.model().contains == &r.model(); });
  return inner != rivals.end() && inner->has_modulus() == one.has_modulus() &&
         one.error >= nested_gain * inner->error;
}

/// Flat joints, which stand last, have to meet what no other does, or to be better by flat_joint_gain where
/// nothing does.
bool replaces(const Rival& one, const ModelChoice& so_far, const ForecastMet& meets) {
  const Rival& best = so_far.rivals[so_far.best];
  // a model that cannot have E ends out of reach, however well it predicts strengths
  if (one.has_modulus() != best.has_modulus()) return one.has_modulus();
  if (one.model().matrix == MatrixModel::parallel_bond)
    return !is_barred(one, so_far.rivals) && one.error < best.error;
  if (std::any_of(so_far.rivals.begin(), so_far.rivals.end(), [&](const Rival& r) { return meets(r.rock); }))
    return false;
  return meets(one.rock) || one.error < flat_joint_gain * best.error;
}

}  // namespace

void ModelChoice::add(Rival rival, const ForecastMet& meets) {
  if (rivals.empty() || replaces(rival, *this, meets)) best = rivals.size();
  rivals.push_back(std::move(rival));
}

bool Rival::has_modulus() const { return modulus_error <= modulus_limit; }

std::vector<Finding> ModelChoice::findings() const {
  std::vector<Finding> all = {{FindingKind::model_taken, {}, {}, {model_in_words(rock())}}};
  for (const Rival& r : rivals) {
    Finding expected{FindingKind::model_expected, {}, {}, {model_in_words(r.rock)}};
    // 0: the table has none
    if (r.modulus_error > 0.0) expected.numbers.push_back({"E", r.modulus_error});
    if (r.strength_error > 0.0) expected.numbers.push_back({"strengths", r.strength_error});
    all.push_back(std::move(expected));
  }
  if (rivals[best].has_modulus() &&
      !std::all_of(rivals.begin(), rivals.end(), std::mem_fn(&Rival::has_modulus)))
    all.push_back({FindingKind::models_miss_modulus, {}, {{"limit", modulus_limit}}});
  const auto stays_behind = [&](const Rival& r) {
    return r.has_modulus() && r.error < rivals[best].error && is_barred(r, rivals);
  };
  if (std::any_of(rivals.begin(), rivals.end(), stays_behind))
    all.push_back({FindingKind::nested_models_stay, {}, {{"gain", nested_gain}}});
  if (rivals.back().model().matrix == MatrixModel::flat_joint)
    all.push_back({FindingKind::flat_joints_rule, {}, {{"gain", flat_joint_gain}}});
  return all;
}

std::vector<const Rival*> ModelChoice::near_ones() const {
  const Rival& taken = rivals[best];
  // shares of the planes are one kind: another share needs no folder of its own
  std::map<const RockModel*, const Rival*> best_of_kind;
  for (const Rival& r : rivals) {
    if (&r.model() == &taken.model() || (!r.has_modulus() && taken.has_modulus()) ||
        r.error > rival_tolerance * taken.error)
      continue;
    const auto [it, fresh] = best_of_kind.try_emplace(&r.model(), &r);
    if (!fresh && r.error < it->second->error) it->second = &r;
  }
  std::vector<const Rival*> near;
  for (const auto& [of, rival] : best_of_kind) near.push_back(rival);
  std::sort(near.begin(), near.end(), [](const Rival* a, const Rival* b) { return a->error < b->error; });
  return near;
}

Finding ModelChoice::asked_for(const Rival& rival) const {
  const Rival& taken = rivals[best];
  const bool several_matrices = std::any_of(
      rivals.begin(), rivals.end(), [&](const Rival& r) { return r.model().matrix != taken.model().matrix; });
  const char* const matrix = rival.model().matrix == MatrixModel::flat_joint ? "flat_joint" : "parallel_bond";
  return {FindingKind::rival_model,
          {},
          {{"error", rival.error}, {"taken_error", taken.error}},
          {model_in_words(rival.rock), model_in_words(taken.rock),
           rival.rock.bedded ? to_string(rival.rock.layers) : "", several_matrices ? matrix : ""},
          Advice::try_rival};
}

std::optional<ParameterEstimate> ModelChoice::share(const Rival& taken) const {
  if (!has_bridges(taken.rock.model)) return std::nullopt;
  std::map<double, bool> possible;  // by share, that of whole planes among them
  for (const Rival& r : rivals)
    if (&r.model() == &taken.model() || &r.model() == taken.model().contains)
      possible[jointed_share(r.rock.model)] =
          (r.has_modulus() || !taken.has_modulus()) && r.error <= share_tolerance * taken.error;
  if (possible.size() < 2)
    return std::nullopt;  // no other share was compared, and an interval would be made up
  ParameterEstimate e;
  e.key = "bedding[0].persistence", e.symbol = "persistence", e.unit = "1",
  e.value = jointed_share(taken.rock.model);
  e.number = [](const Recipe& r) -> const double& { return r.bedding.front().persistence; };
  e.box_low = possible.begin()->first, e.box_high = 1.0;
  const auto is_possible = [](const auto& of) { return of.second; };
  const auto first = std::find_if(possible.begin(), possible.end(), is_possible);
  const auto last = std::find_if(possible.rbegin(), possible.rend(), is_possible);
  // up to the next shares that were refused: in between nothing was tried
  e.low = first == possible.begin() ? e.box_low : std::prev(first)->first;
  e.high = last == possible.rbegin() ? e.box_high : std::prev(last)->first;
  e.determined = std::log(e.high / e.low) < 0.5 * std::log(e.box_high / e.box_low);
  e.rests_on.basis = Basis::values_left_out;
  if (!e.determined) e.next.remedy = Remedy::map_persistence;
  return e;
}

Finding share_interval(const ParameterEstimate& share) {
  return {FindingKind::share_interval,
          {},
          {{"share", share.value}, {"low", share.low}, {"high", share.high}, {"factor", share_tolerance}}};
}

}  // namespace phy::maps
