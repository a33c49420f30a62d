// The grains of a group: their order in memory, what the packing says of each, and their state in every lane.
#pragma once
#include <memory>
#include <vector>

#include "base/near_pairs.hpp"
#include "engine/buffer.hpp"
#include "engine/inertia.hpp"
#include "engine/layout.hpp"
#include "engine/view.hpp"
#include "records/result.hpp"

namespace phy::engine::group {

template <class T>
class GrainMemory {
 public:
  /// W: number of lanes.
  GrainMemory(std::shared_ptr<const Packing> packing, std::size_t W, GrainInertia inertia);

  const Packing& packing() const { return *packing_; }
  const Layout& layout() const { return layout_; }
  std::size_t size() const { return x0_.size(); }
  std::size_t lanes() const { return W_; }
  double smallest_radius() const { return r_min_; }
  /// Near pairs are listed up to this gap [m]; rows are as much higher than the largest grain.
  double skin() const { return skin_; }

  // Grains by sorted number.
  Vec2 start(std::size_t g) const { return x0_[g]; }
  double radius(std::size_t g) const { return radius_[g]; }
  const std::vector<double>& radii() const { return radius_; }
  double mass(std::size_t g, double density) const {
    return inertia_.mass(packing_id(static_cast<std::int32_t>(g)), density);
  }
  const Inertia& inertia() const { return inertia_; }
  std::uint32_t packing_id(std::int32_t g) const {
    return static_cast<std::uint32_t>(layout_.order[static_cast<std::size_t>(g)]);
  }
  std::size_t sorted_id(std::uint32_t packing) const {
    return static_cast<std::size_t>(layout_.rank[packing]);
  }
  PairKey key(std::uint32_t packing_a, std::uint32_t packing_b) const {
    return pair_key(static_cast<std::uint32_t>(layout_.rank[packing_a]),
                    static_cast<std::uint32_t>(layout_.rank[packing_b]));
  }

  double get(std::size_t g, int field, std::size_t lane) const {
    return static_cast<double>(state_[(g * n_grain_fields + static_cast<std::size_t>(field)) * W_ + lane]);
  }
  void set(std::size_t g, int field, std::size_t lane, double value) {
    state_[(g * n_grain_fields + static_cast<std::size_t>(field)) * W_ + lane] = T(value);
  }
  Vec2 displacement(std::size_t g, std::size_t lane) const {
    return {get(g, g_ux, lane), get(g, g_uy, lane)};
  }
  Vec2 velocity(std::size_t g, std::size_t lane) const { return {get(g, g_vx, lane), get(g, g_vy, lane)}; }
  Vec2 place(std::size_t g, std::size_t lane) const { return x0_[g] + displacement(g, lane); }
  double rotation(std::size_t g, std::size_t lane) const { return get(g, g_rot, lane); }

  /// All states.
  void keep(std::vector<T>& in) const { state_.keep(in); }
  void restore(const std::vector<T>& from) { state_.restore(from); }
  /// At rest, where the packing has them.
  void clear(std::size_t lane);
  void copy(std::size_t lane, GrainMemory<T>& to, std::size_t to_lane) const;
  /// Displacements and rotations in the order of the packing.
  std::vector<GrainState> states(std::size_t lane) const;

  T* data() { return state_.get(); }
  const T* data() const { return state_.get(); }
  const GrainConst<T>* constants() const { return const_.data(); }

 private:
  std::shared_ptr<const Packing> packing_;
  Inertia inertia_;
  std::size_t W_;
  double r_min_ = 0.0, skin_ = 0.0;
  Layout layout_;
  std::vector<Vec2> x0_;
  std::vector<double> radius_;
  std::vector<GrainConst<T>> const_;
  Buffer<T> state_;
};

}  // namespace phy::engine::group
