// The jacket of a boundary (jacket.hpp): fitted anew before every block, lane by lane.
#include <algorithm>
#include <cmath>

#include "engine/boundary_memory.hpp"
#include "engine/jacket.hpp"

namespace phy::engine::group {
namespace {

constexpr double ray_spacing = 0.25;  // of the smallest radius: no grain of the surface is missed

}  // namespace

/// Force on a grain [N/m].
template <class T>
Vec2 BoundaryMemory<T>::pressing(std::size_t g, std::size_t l) const {
  const LaneBoundary& lane = lanes_[l];
  if (lane.pressed.empty()) return {};
  return {lane.stress.x * lane.pressed[g].x, lane.stress.y * lane.pressed[g].y};
}

/// Way in a block from rest under the pressure alone, F t^2/(2 m). Local damping takes a share of the force
/// that drives a grain, which leaves (1 - alpha) F.
template <class T>
double BoundaryMemory<T>::pushed_way(std::size_t g, std::size_t l) const {
  const LaneBoundary& lane = lanes_[l];
  const double force = (1.0 - lane.damping) * norm(pressing(g, l));
  if (force == 0.0) return 0.0;
  const double block = lane.dt * static_cast<double>(n_steps_);
  return 0.5 * force / grains_->mass(g, lane.density) * block * block;
}

template <class T>
std::vector<double> BoundaryMemory<T>::push(std::size_t l) const {
  std::vector<double> ways(jacket_.present() ? grains_->size() : 0);
  for (std::size_t g = 0; g < ways.size(); ++g) ways[g] = pushed_way(g, l);
  return ways;
}

/// Sum of the areas that are pressed, times their displacement, along x and y [m^2].
template <class T>
Vec2 BoundaryMemory<T>::area_swept(std::size_t l) const {
  const std::vector<Vec2>& pressed = lanes_[l].pressed;
  Vec2 sum;
  for (std::size_t g = 0; g < pressed.size(); ++g)
    sum = sum + Vec2{pressed[g].x * grains_->get(g, g_ux, l), pressed[g].y * grains_->get(g, g_uy, l)};
  return sum;
}

template <class T>
bool BoundaryMemory<T>::fit_jacket(std::size_t l, NeighbourList<T>& list) {
  std::vector<Vec2> x(grains_->size());
  // The surface is looked for where the grains are now; their order in memory is that of the start.
  for (std::size_t g = 0; g < x.size(); ++g) x[g] = grains_->place(g, l);
  const double spacing = ray_spacing * grains_->smallest_radius();
  lanes_[l].pressed = jacket_.on == Jacket::On::hole
                          ? hole_areas(x, grains_->radii(), jacket_, spacing)
                          : side_areas(x, grains_->radii(), grains_->packing().height, spacing);
  // Written as "not within" so that a NaN also asks for a new list.
  for (std::size_t g = 0; g < x.size() && list.searched(l); ++g)
    if (!(pushed_way(g, l) <= list.push(l, g))) list.forget(l);
  return !list.searched(l);
}

template <class T>
bool BoundaryMemory<T>::fit_jackets(NeighbourList<T>& list) {
  if (!jacket_.present()) return false;
  bool forgotten = false;
  for (std::size_t l = 0; l < W_; ++l)
    if (acts(l)) forgotten = fit_jacket(l, list) || forgotten;
  list_loads();
  // After the loads are known: the work of the block is p times the change of this sum.
  for (std::size_t l = 0; l < W_; ++l)
    if (!lanes_[l].pressed.empty()) lanes_[l].swept_from = area_swept(l);
  return forgotten;
}

/// The grains that are pressed in some lane, and the forces on them.
template <class T>
void BoundaryMemory<T>::list_loads() {
  // All lanes share the list of pressed grains; lanes that do not press one of them hold a zero force there.
  // Grains that no lane presses are left out.
  load_.clear();
  std::vector<T> forces;
  for (std::size_t g = 0; g < grains_->size(); ++g) {
    const std::size_t before = forces.size();
    for (std::size_t l = 0; l < W_; ++l) forces.push_back(T(pressing(g, l).x));
    for (std::size_t l = 0; l < W_; ++l) forces.push_back(T(pressing(g, l).y));
    if (std::all_of(forces.begin() + static_cast<std::ptrdiff_t>(before), forces.end(),
                    [](T f) { return f == T(0); }))
      forces.resize(before);
    else
      load_.push_back(static_cast<std::int32_t>(g));
  }
  load_force_.assign(forces.size());
  std::copy(forces.begin(), forces.end(), load_force_.get());
  // Loads are sorted by grain, so those of a row are one range.
  for (std::size_t row = 0; row < row_load_.size(); ++row)
    row_load_[row] = static_cast<std::int32_t>(
        std::lower_bound(load_.begin(), load_.end(), grains_->layout().row_grain[row]) - load_.begin());
}

template Vec2 BoundaryMemory<double>::area_swept(std::size_t) const;
template Vec2 BoundaryMemory<float>::area_swept(std::size_t) const;
template std::vector<double> BoundaryMemory<double>::push(std::size_t) const;
template std::vector<double> BoundaryMemory<float>::push(std::size_t) const;
template bool BoundaryMemory<double>::fit_jackets(NeighbourList<double>&);
template bool BoundaryMemory<float>::fit_jackets(NeighbourList<float>&);

}  // namespace phy::engine::group
