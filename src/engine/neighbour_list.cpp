#include "engine/neighbour_list.hpp"

#include <algorithm>
#include <cmath>

namespace phy::engine::group {
namespace {

constexpr double flight_margin = 2.0;   // over what a fast grain does in a block at its present speed
constexpr double farthest_reach = 8.0;  // of the smallest radius: the cells of the search grow with it

}  // namespace

template <class T>
NeighbourList<T>::NeighbourList(const GrainMemory<T>& grains)
    : grains_(&grains), lanes_(grains.lanes()), searched_at_(grains.size() * grains.lanes()) {}

/// Grain by grain and all lanes at once, as they lie in memory.
template <class T>
typename NeighbourList<T>::Farthest NeighbourList<T>::farthest() const {
  const std::size_t W = grains_->lanes();
  Farthest most{std::vector<double>(W), std::vector<double>(W)};
  double *moved = most.moved.data(), *speed = most.speed.data();
  for (std::size_t g = 0; g < grains_->size(); ++g) {
    const T* const of = grains_->data() + g * n_grain_fields * W;
    const Vec2* const from = searched_at_.data() + g * W;
    for (std::size_t l = 0; l < W; ++l) {
      const Vec2 d{static_cast<double>(of[g_ux * W + l]) - from[l].x,
                   static_cast<double>(of[g_uy * W + l]) - from[l].y};
      const Vec2 v{static_cast<double>(of[g_vx * W + l]), static_cast<double>(of[g_vy * W + l])};
      // Squares; the roots are taken once per lane.
      moved[l] = std::max(moved[l], dot(d, d));
      speed[l] = std::max(speed[l], dot(v, v));
    }
  }
  for (std::size_t l = 0; l < W; ++l) moved[l] = std::sqrt(moved[l]), speed[l] = std::sqrt(speed[l]);
  return most;
}

/// Half of the way that ends a list (outlived): such a list would soon force the next renewal.
template <class T>
bool NeighbourList<T>::worn(std::size_t lane, const Farthest& most, double block) const {
  return !searched(lane) || 4.0 * (most.moved[lane] + most.speed[lane] * block) >= grains_->skin();
}

template <class T>
bool NeighbourList<T>::outlived(std::size_t lane, const Farthest& most, double block, double bodies) const {
  // Two grains may approach each other, so twice the largest way; less the distance at which pairs are
  // created. A body is listed by the sum of both ways.
  const double grains = most.moved[lane] + most.speed[lane] * block, skin = grains_->skin();
  return 2.0 * grains > skin - meeting_gap * grains_->smallest_radius() || grains + bodies > skin;
}

template <class T>
void NeighbourList<T>::search(std::size_t l, double block, std::vector<double>&& push) {
  const GrainMemory<T>& of = *grains_;
  Lane& lane = lanes_[l];
  lane.near.clear();
  lane.push = std::move(push);
  std::vector<Vec2> x(of.size());
  std::vector<double> reach = of.radii();
  lane.range.assign(of.size(), usual_range());
  for (std::size_t g = 0; g < of.size(); ++g) {
    searched_at_[g * of.lanes() + l] = of.displacement(g, l);
    x[g] = of.place(g, l);
    // Round a fast grain the list reaches as far as twice its way in a block, because it may speed up.
    const double flight = std::max(block * norm(of.velocity(g, l)), lane.way.empty() ? 0.0 : lane.way[g]);
    double more = std::max(0.0, flight_margin * flight - usual_range());
    // The allowance is written back into `push`: fit_jackets() compares the next push with it.
    if (!lane.push.empty() && lane.push[g] > 0.0) more += lane.push[g] += usual_range();
    // The cells of the search are as large as the largest reach: a single runaway grain must not make them
    // huge.
    more = std::min(more, farthest_reach * of.smallest_radius());
    reach[g] += more, lane.range[g] += more;
  }
  near_pairs(x, reach, of.skin(), lane.near);
  lane.searched = true;
}

template <class T>
void NeighbourList<T>::expect(std::size_t l, const std::vector<double>& way) {
  std::vector<double>& all = lanes_[l].way;
  all.resize(way.size());
  for (std::size_t g = 0; g < way.size(); ++g) all[g] = std::max(all[g], way[g]);
}

template <class T>
bool NeighbourList<T>::too_far(std::size_t l, std::size_t g) const {
  return way(l, g) > usual_range() + farthest_reach * grains_->smallest_radius();
}

void PairUnion::add(PairKey key) {
  // By the upper grain, so that joining the lists in order of grains gives the pairs sorted.
  std::vector<PairKey>& known = of_[static_cast<std::size_t>(key_b(key))];
  if (std::find(known.begin(), known.end(), key) == known.end()) known.push_back(key);
}

std::vector<PairKey> PairUnion::sorted() {
  std::vector<PairKey> all;
  for (std::vector<PairKey>& of : of_) {
    std::sort(of.begin(), of.end());
    all.insert(all.end(), of.begin(), of.end());
  }
  return all;
}

template class NeighbourList<double>;
template class NeighbourList<float>;

}  // namespace phy::engine::group
