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
  Vec2 force;
  for (const PressedSurface* s : {&lanes_[l].sides, &lanes_[l].hole})
    if (!s->area.empty()) force = force + Vec2{s->stress.x * s->area[g].x, s->stress.y * s->area[g].y};
  return force;
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
Vec2 BoundaryMemory<T>::area_swept(const PressedSurface& surface, std::size_t l) const {
  Vec2 sum;
  for (std::size_t g = 0; g < surface.area.size(); ++g)
    sum = sum +
          Vec2{surface.area[g].x * grains_->get(g, g_ux, l), surface.area[g].y * grains_->get(g, g_uy, l)};
  return sum;
}

/// Areas and stress do not change within a block, so this part of the work is exact (jacket.hpp).
template <class T>
void BoundaryMemory<T>::add_work(PressedSurface& surface, std::size_t l, double& work) const {
  const Vec2 swept = area_swept(surface, l) - surface.swept_from;
  work += dot(surface.stress, swept);
  surface.swept += swept.x + swept.y;
}

template <class T>
bool BoundaryMemory<T>::fit_jacket(std::size_t l, NeighbourList<T>& list) {
  std::vector<Vec2> x(grains_->size());
  // The surface is looked for where the grains are now; their order in memory is that of the start.
  for (std::size_t g = 0; g < x.size(); ++g) x[g] = grains_->place(g, l);
  const double spacing = ray_spacing * grains_->smallest_radius();
  LaneBoundary& lane = lanes_[l];
  if (jacket_.sides) lane.sides.area = side_areas(x, grains_->radii(), grains_->packing().height, spacing);
  if (jacket_.hole.radius > 0.0) lane.hole.area = hole_areas(x, grains_->radii(), jacket_.hole, spacing);
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
    for (PressedSurface* s : {&lanes_[l].sides, &lanes_[l].hole}) s->swept_from = area_swept(*s, l);
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

template void BoundaryMemory<double>::add_work(PressedSurface&, std::size_t, double&) const;
template void BoundaryMemory<float>::add_work(PressedSurface&, std::size_t, double&) const;
template std::vector<double> BoundaryMemory<double>::push(std::size_t) const;
template std::vector<double> BoundaryMemory<float>::push(std::size_t) const;
template bool BoundaryMemory<double>::fit_jackets(NeighbourList<double>&);
template bool BoundaryMemory<float>::fit_jackets(NeighbourList<float>&);

}  // namespace phy::engine::group
