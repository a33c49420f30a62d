#include "calibrate/search_plan.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "calibrate/strength_tests.hpp"

namespace phy::calibrate {
namespace {

/// Points of a whole search: the more is sought, the more of them.
std::int64_t most_points(std::size_t n_ratios, const Effort& effort, Course course) {
  // Six points for each ratio, no fewer than for six of them. Seven ninths: without the batch of 8, 28 of 36
  // are left.
  constexpr double usual = 36.0, per_ratio = 6.0, without_a_batch = 7.0 / 9.0;
  return std::llround(effort.points * std::max(usual, per_ratio * static_cast<double>(n_ratios)) *
                      (course == Course::coarse_then_estimate ? without_a_batch : 1.0));
}

/// A third of the points and two ninths over the draws, on coarse grains where there are any, and the rest in
/// rounds at the estimate, which each of them moves; of 36: 12, 8 and 16. With a batch on the recipe's own
/// grains 12, 8, 8 and 8; from coarse grains to the estimate at once, of 28: 12, 8 and 8.
std::vector<Batch> batches_of(std::int64_t points, Course course) {
  const Grains first = course == Course::own ? Grains::own : Grains::coarse;
  const std::int64_t n_alike = course == Course::coarse_then_estimate ? 2 : 3,  // parts behind the first
      last = std::max<std::int64_t>(1, points * 2 / (2 * n_alike + 3));
  const auto n_last = static_cast<std::size_t>(last),
             n_first = static_cast<std::size_t>(points - n_alike * last);
  std::vector<Batch> batches = {{first, false, n_first}, {first, false, n_last}};
  if (course == Course::coarse_then_own) batches.push_back({Grains::own, false, n_last});
  for (std::size_t left = course == Course::own ? 2 * n_last : n_last; left > 0;) {
    // A rest joins the last round: fewer packings than a round has would hardly move the estimate.
    const std::size_t n = left < 2 * packings_per_round ? left : packings_per_round;
    batches.push_back({Grains::own, true, n});
    left -= n;
  }
  return batches;
}

/// Rounds that may follow, while the estimate has not settled. Of specimens so large that coarse grains are
/// taken a third as many where the plan was short, else none: a round of them costs more than all tests on
/// coarse grains.
std::size_t further_rounds(const Effort& effort, Course course) {
  if (course == Course::own) return effort.further;
  return course == Course::coarse_then_estimate ? effort.further / 3 : 0;
}

}  // namespace

/// What coarse grains leave to be learnt is by how much the recipe's own differ. For UCS alone that counts at
/// the estimate; strengths of other tests tell parameters that UCS leaves open (friction, slits), and how
/// they change beside the estimate is best asked of the recipe's own grains (docs/decisions/0006).
Course course_of(const Recipe& recipe, const std::vector<Target>& targets) {
  if (!has_coarse(recipe)) return Course::own;
  const bool ucs_alone = std::all_of(targets.begin(), targets.end(),
                                     [](const Target& t) { return t.property == Property::ucs; });
  return ucs_alone ? Course::coarse_then_estimate : Course::coarse_then_own;
}

SearchPlan plan_search(const Budget& budget, std::size_t n_ratios, std::int64_t n_compressive,
                       Course course) {
  const Effort& effort = budget.effort;
  const std::int64_t most = most_points(n_ratios, effort, course),
                     usual = most_points(n_ratios, normal_effort, course),
                     paid = budget.max_tests / n_compressive;
  SearchPlan plan;
  plan.batches = batches_of(std::clamp(paid, least_points, most), course);
  plan.most_batches = plan.batches.size() + further_rounds(effort, course);
  plan.shortage = {
      .of_effort = effort.points < normal_effort.points,
      .of_tests = budget.max_tests < usual * n_compressive,
      .foreseen = effort.foreseen,
      .below_most = effort.points < efforts.back().points,
      .tests = std::max<std::int64_t>(0, usual - std::clamp(paid, least_points, most)) * n_compressive};
  if (effort.points > normal_effort.points && paid < most && !plan.shortage.any())
    plan.cut = Finding{FindingKind::search_cut,
                       {},
                       {{"points", static_cast<double>(most)}, {"paid", static_cast<double>(paid)}},
                       {std::string(effort.name)}};
  return plan;
}

std::vector<std::size_t> PackingDealer::deal(const Batch& batch) {
  constexpr std::size_t points_per_packing = 2;
  std::vector<std::size_t> dealt;
  for (std::size_t p = 0; p < batch.n_points; ++p) {
    if (p > 0 && (batch.at_estimate || p % points_per_packing == 0)) ++next_;
    dealt.push_back(next_ % n_);
  }
  // A batch begins on a packing of its own, also where the last one had a single point.
  ++next_;
  return dealt;
}

std::size_t PackingDealer::dealt() const { return std::min(n_, next_); }

}  // namespace phy::calibrate
