#include "study/chunks.hpp"

#include <algorithm>
#include <numeric>

namespace phy::study {
namespace {

/// Until all tests are done, each alone, by workers who take the longest that waits.
double time_one_by_one(const std::vector<double>& cost, std::size_t n_workers) {
  std::vector<double> busy(n_workers, 0.0);
  for (const double c : cost) *std::min_element(busy.begin(), busy.end()) += c;
  return *std::max_element(busy.begin(), busy.end());
}

}  // namespace

LaneBatchOptions lane_batch_options(std::size_t n_specimens, bool alike, const Recipe& recipe,
                                    const MachineOptions& machine) {
  engine::GroupOptions group;
  group.isa = machine.isa;
  group.precision = recipe.engine.precision;
  // A register full of specimens is the best speed per specimen.
  group.lanes = engine::native_lanes(group.precision, machine.isa);
  group.lanes = machine.lanes > 0 ? machine.lanes : fitting_lanes(n_specimens, alike, group);
  group.skew = machine.skew;
  group.interval = static_cast<int>(recipe.test.history_interval);
  group.inertia = recipe.engine.grain_inertia;
  group.contacts = &engine::physics_of(recipe.matrix, recipe.bedding);
  return {group, machine.lanes > 0};
}

std::vector<std::size_t> first_chunks(const std::vector<double>& cost, bool alike, std::size_t n_workers,
                                      const LaneBatchOptions& widest) {
  const auto most = static_cast<std::size_t>(widest.group.lanes);
  if (widest.fixed) {
    std::vector<std::size_t> chunks;
    for (std::size_t i = 0; i < cost.size() && chunks.size() < n_workers; i += chunks.back())
      chunks.push_back(std::min(most, cost.size() - i));
    return chunks;
  }
  const auto lanes = [&](std::size_t n) { return fitting_lanes(n, alike, widest.group); };
  const auto slow = [&](std::size_t n) {
    return slowness(lanes(n), alike, widest.group.precision, widest.group.isa);
  };
  // Greedy: fills chunk after chunk, longest tests first, as far as a chunk stays within `time`. Cost falls,
  // so the first test of a chunk is its longest and decides how long the chunk takes. Chunks that would be
  // done one after the other are not made: such tests wait for whoever comes first.
  const auto chunks_within = [&](double time) {
    std::vector<std::size_t> chunks;
    for (std::size_t i = 0; i < cost.size() && chunks.size() < n_workers; i += chunks.back()) {
      std::size_t n = 1;
      for (std::size_t more = 2; more <= most && i + more <= cost.size(); ++more)
        if (lanes(more) > 1 && cost[i] * slow(more) <= time) n = more;
      chunks.push_back(n);
    }
    return chunks;
  };
  std::vector<double> times;  // one of them is the answer
  for (const double c : cost)
    for (std::size_t n = 1; n <= most; n *= 2) times.push_back(c * slow(n));
  std::sort(times.begin(), times.end());
  // The least of these times within which all tests find a place. Where none suffices there are more tests
  // than lanes, and the rest waits.
  const auto fitting = std::find_if(times.begin(), times.end(), [&](double time) {
    const auto chunks = chunks_within(time);
    return std::accumulate(chunks.begin(), chunks.end(), std::size_t{0}) == cost.size();
  });
  if (fitting == times.end()) return chunks_within(times.back());
  if (time_one_by_one(cost, n_workers) <= *fitting)
    return std::vector<std::size_t>(std::min(n_workers, cost.size()), 1);
  return chunks_within(*fitting);
}

}  // namespace phy::study
