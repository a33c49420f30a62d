#include "engine/grain_memory.hpp"

#include <algorithm>

#include "base/check.hpp"
#include "base/exact_math.hpp"

namespace phy::engine::group {
namespace {

constexpr double skin_factor = 0.25;  // of the smallest radius

}  // namespace

template <class T>
GrainMemory<T>::GrainMemory(std::shared_ptr<const Packing> packing, std::size_t W, GrainInertia inertia)
    : packing_(std::move(packing)), inertia_(*packing_, inertia), W_(W) {
  PHY_CHECK(!packing_->discs.empty(), "a packing has grains");
  for (const Disc& d : packing_->discs) r_min_ = r_min_ > 0.0 ? std::min(r_min_, d.r) : d.r;
  skin_ = skin_factor * r_min_;
  layout_ = make_layout(*packing_, skin_);
  const GaugeWeights gauge = gauge_weights(*packing_);
  // Fields in the sorted order of the loop. Constants are per area and per r^4: density, which may differ by
  // lane, comes in by l_accel.
  for (const std::int32_t sorted : layout_.order) {
    const auto i = static_cast<std::size_t>(sorted);
    const Disc& d = packing_->discs[i];
    x0_.push_back({d.x, d.y});
    radius_.push_back(d.r);
    const double area = inertia_.area(i);
    const_.push_back(
        {T(1.0 / area), T(inertia_.roundness() / (area * d.r * d.r)), T(d.r), T(gauge.x[i]), T(gauge.y[i])});
  }
  state_.assign(size() * n_grain_fields * W_);
}

template <class T>
void GrainMemory<T>::clear(std::size_t lane) {
  for (std::size_t field = 0; field < size() * n_grain_fields; ++field) state_[field * W_ + lane] = T(0);
}

template <class T>
void GrainMemory<T>::copy(std::size_t lane, GrainMemory<T>& to, std::size_t to_lane) const {
  for (std::size_t field = 0; field < size() * n_grain_fields; ++field)
    to.state_[field * to.W_ + to_lane] = state_[field * W_ + lane];
}

template <class T>
std::vector<GrainState> GrainMemory<T>::states(std::size_t lane) const {
  std::vector<GrainState> all(size());
  for (std::size_t g = 0; g < size(); ++g)
    // Back to the packing's numbers: only the engine knows the sorted ones.
    all[static_cast<std::size_t>(layout_.order[g])] = {get(g, g_ux, lane), get(g, g_uy, lane),
                                                       rotation(g, lane)};
  return all;
}

template class GrainMemory<double>;
template class GrainMemory<float>;

}  // namespace phy::engine::group
