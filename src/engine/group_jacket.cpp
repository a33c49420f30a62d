// The jacket of a group (jacket.hpp): fitted anew before every block, lane by lane.
#include "engine/group.hpp"
#include "engine/jacket.hpp"

namespace phy::group {
namespace {

constexpr double ray_spacing = 0.25;  // of the smallest radius: no grain of the surface is missed

}  // namespace

/// Way on which the jacket alone would drive a grain that nothing holds, in the next block [m].
template <class T>
double Group<T>::pushed_way(std::size_t g, std::size_t l) const {
  const Lane& lane = lanes_[l];
  if (lane.pressed.empty() || lane.pressed[g] == 0.0) return 0.0;
  const double mass = lane.specimen->matrix.density * pi * radius_[g] * radius_[g];
  const double force = (1.0 - lane.setup.damping) * lane.pressure * std::fabs(lane.pressed[g]);
  const double block = lane.dt * options_.interval;
  return 0.5 * force / mass * block * block;
}

/// Sum of the heights that are pressed, times their displacement [m^2].
template <class T>
double Group<T>::area_swept(std::size_t l) const {
  const std::vector<double>& pressed = lanes_[l].pressed;
  double sum = 0.0;
  for (std::size_t g = 0; g < pressed.size(); ++g) sum += pressed[g] * grain(g, g_ux, l);
  return sum;
}

/// A grain that is driven farther than the list of near pairs allows for asks for a new one.
template <class T>
void Group<T>::fit_jacket(std::size_t l) {
  Lane& lane = lanes_[l];
  std::vector<Vec2> x(n_grains());
  for (std::size_t g = 0; g < n_grains(); ++g) x[g] = x0_[g] + displacement(g, l);
  lane.pressed = jacket_heights(x, radius_, packing_->height, ray_spacing * r_min_);
  lane.pressed_way.resize(n_grains(), 0.0);
  for (std::size_t g = 0; g < n_grains() && lane.searched; ++g)
    lane.searched = pushed_way(g, l) <= lane.pressed_way[g];
  dirty_ = dirty_ || !lane.searched;
}

template <class T>
void Group<T>::fit_jackets() {
  if (!jacket_) return;
  for (std::size_t l = 0; l < W_; ++l)
    if (lanes_[l].specimen && lanes_[l].placed) fit_jacket(l);
  const auto force = [&](std::size_t g, std::size_t l) {
    return lanes_[l].pressed.empty() ? 0.0 : lanes_[l].pressure * lanes_[l].pressed[g];
  };
  load_.clear();
  std::vector<T> forces;
  for (std::size_t g = 0; g < n_grains(); ++g) {
    const std::size_t before = forces.size();
    for (std::size_t l = 0; l < W_; ++l) forces.push_back(T(force(g, l)));
    if (std::all_of(forces.begin() + static_cast<std::ptrdiff_t>(before), forces.end(),
                    [](T f) { return f == T(0); }))
      forces.resize(before);
    else
      load_.push_back(static_cast<std::int32_t>(g));
  }
  load_force_.assign(forces.size());
  std::copy(forces.begin(), forces.end(), load_force_.get());
  for (std::size_t row = 0; row < row_load_.size(); ++row)
    row_load_[row] = static_cast<std::int32_t>(
        std::lower_bound(load_.begin(), load_.end(), layout_.row_grain[row]) - load_.begin());
  for (std::size_t l = 0; l < W_; ++l)
    if (!lanes_[l].pressed.empty()) lanes_[l].swept_from = area_swept(l);
}

template class Group<double>;
template class Group<float>;

}  // namespace phy::group
