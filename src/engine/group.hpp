// The group behind LaneGroup: its memory and what it is made of. Inside the engine only; the members are
// defined by theme.
//   group.cpp        loading, the block of cycles, states for others
//   group_list.cpp   near pairs, contacts, births, time step
//   group_move.cpp   a specimen on its way to another group
//   group_rig.cpp    tools: placing, driving, the points where they act
//   group_jacket.cpp the grains that a jacket presses on
//   group_books.cpp  energy books, cracks, history row, watchdog
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <map>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <vector>

#include "base/check.hpp"
#include "base/exact_math.hpp"
#include "engine/lane_group.hpp"
#include "engine/layout.hpp"
#include "engine/stable_step.hpp"
#include "laws/laws.hpp"

namespace phy::group {

constexpr double hold_force = 1e30;  // N/m: no strength is reached while breakage is off
constexpr std::uint8_t no_set = 255;
constexpr double far_away = 1.0;  // m: gap of a tool that is not there

/// Zeroed memory aligned to a cache line.
template <class T>
class Buffer {
 public:
  void assign(std::size_t n) {
    const std::size_t bytes = std::max<std::size_t>(64, (n * sizeof(T) + 63) / 64 * 64);
    data_.reset(static_cast<T*>(std::aligned_alloc(64, bytes)));
    if (!data_) throw std::bad_alloc();
    std::fill_n(data_.get(), bytes / sizeof(T), T(0));
  }
  T* get() { return data_.get(); }
  const T* get() const { return data_.get(); }
  T& operator[](std::size_t i) { return data_.get()[i]; }
  const T& operator[](std::size_t i) const { return data_.get()[i]; }

 private:
  struct Free {
    void operator()(T* p) const { std::free(p); }
  };
  std::unique_ptr<T, Free> data_;
};

/// A tool in a lane.
struct ToolMotion {
  Drive drive;
  double drive_time = 0.0;
  Vec2 memory;  // servo: remembered displacement per block
  ToolState state;
  Vec2 listed_at;  // displacement when the points near the tools were listed
};

/// Upper bound of a tool's speed. In balance it is at most that of the fastest grain: moving all grains that
/// it touches moves it by as much.
inline double fastest_tool(const Drive& d, double fastest_grain) {
  return norm(d.velocity) + (d.servo_x.on ? d.servo_x.max_speed : 0.0) +
         (d.servo_y.on ? d.servo_y.max_speed : 0.0) +
         (d.balance_x.on || d.balance_y.on ? fastest_grain : 0.0);
}

/// Everything the group knows about one specimen.
struct Lane {
  std::shared_ptr<const Specimen> specimen;  // null: empty lane
  LaneSetup setup;
  bool fresh = false;  // loaded, states not yet filled in
  bool hold = false, placed = false;
  std::optional<FrequencyBound> bound;
  std::map<PairKey, ContactStiffness> born;  // contacts that the bound counts beyond those of the start
  double dt = 0.0, time = 0.0;
  std::int64_t step = 0;
  std::vector<ToolMotion> tools;
  double pressure = 0.0, swept = 0.0;  // of the jacket; the area it has swept since it was placed [m^2]
  std::vector<double> pressed;         // height of each sorted grain that the jacket presses on, as it fits
  std::vector<double> pressed_way;     // what it may push each in a block, of which the list knows
  double swept_from = 0.0;             // sum of height times displacement, when it was fitted
  double work = 0.0, slip = 0.0, damping = 0.0, released = 0.0;
  double base_energy = 0.0, base_axial = 0.0, base_lateral = 0.0;
  double zero_travel = 0.0;   // of the axial tools where strains count from [m]
  bool settle_books = false;  // the next block's end is the zero of the energy balance (jump start)
  HistoryRow row;
  LaneHealth health;
  std::vector<Breakage> cracks;
  std::int64_t n_contacts = 0;
  std::vector<PairKey> near;  // of this lane's last search
  std::vector<double> range;  // of each sorted grain: the way since that search that the list allows for [m]
  bool searched = false;

  const Rig& rig() const { return *setup.rig; }
  /// Of the axial tools since the rig was placed [m].
  double travel() const {
    const LoadAxis& axis = rig().axial;
    if (!axis.present() || !placed) return 0.0;
    const auto at = [&](int tool) { return tools[static_cast<std::size_t>(tool)].state.displacement; };
    return axis.travel(at(axis.lo), at(axis.hi));
  }
};

template <class T>
class Group final : public LaneGroup {
 public:
  Group(std::shared_ptr<const Packing> packing, const GroupOptions& options);

  int lanes() const override { return options_.lanes; }
  void load(int lane, std::shared_ptr<const Specimen> specimen, const LaneSetup& setup) override;
  void clear(int lane) override { reset_lane(lane); }
  void move_lane(int lane, LaneGroup& to, int to_lane) override;
  void place_rig(int lane) override;
  void zero_strains(int lane) override;
  void hold_bonds(int lane, bool hold) override { at(lane).hold = hold; }
  void drive(int lane, int tool, const Drive& drive) override;
  void press(int lane, double pressure) override { at(lane).pressure = pressure; }
  void start_moving(int lane, const std::function<Vec2(Vec2)>& velocity) override;
  void jump(int lane, double axial_strain) override;
  bool at_strength(int lane) const override;
  void set_motion(int lane, std::uint32_t id, const GrainState& state, Vec2 velocity, double spin) override;
  void advance() override;

  const HistoryRow& row(int lane) const override { return at(lane).row; }
  const ToolState& tool(int lane, int tool) const override {
    return at(lane).tools[static_cast<std::size_t>(tool)].state;
  }
  JacketState jacket(int lane) const override { return {at(lane).pressure, at(lane).swept}; }
  const LaneHealth& health(int lane) const override { return at(lane).health; }
  std::vector<Breakage>& cracks(int lane) override { return at(lane).cracks; }
  Snapshot snapshot(int lane) const override;
  std::vector<GrainState> grains(int lane) const override;
  double time_step(int lane) const override { return at(lane).dt; }
  std::int64_t n_contacts(int lane) const override { return at(lane).n_contacts; }
  std::int64_t n_rebuilds() const override { return n_rebuilds_; }
  std::int64_t n_listed() const override { return static_cast<std::int64_t>(pairs_.size()); }

 private:
  std::shared_ptr<const Packing> packing_;
  GroupOptions options_;
  std::size_t W_;
  AdvanceBlock<T> kernel_;
  std::vector<Lane> lanes_;
  Layout layout_;
  double r_min_ = 0.0, skin_ = 0.0;
  std::vector<Vec2> x0_;           // sorted reference positions
  std::vector<double> radius_;     // sorted
  std::vector<PairKey> pairs_;     // sorted list of near pairs
  std::vector<std::uint8_t> set_;  // per contact and lane: bedding set of a joint
  std::vector<std::uint8_t> tag_;  // per contact and lane: 1 = bonded or joint since the start
  std::vector<std::size_t> open_;  // pairs that births() looks at
  std::vector<std::int32_t> row_contact_;
  std::vector<GrainConst<T>> grain_const_;
  std::vector<ContactConst<T>> contact_const_;
  Buffer<T> grain_, contact_, lane_table_, joint_table_, slip_, damping_;
  Buffer<double> sample_;
  // The rig. All lanes have the same tools; where these touch or hold differs by the packing alone.
  std::size_t n_tools_ = 0;
  std::vector<Vec2> touch_normal_;          // per tool and sorted grain; zero: never touched
  Buffer<T> touch_gap_, touch_shear_;       // per tool, grain and lane
  Buffer<T> tool_u_, tool_v_, tool_force_;  // per step, tool, component and lane
  Buffer<double> tool_du_;
  Buffer<T> balance_on_, balance_force_;  // per tool, component and lane
  std::vector<BalancePoint> balanced_;    // in some lane, in the block that runs
  std::vector<std::int32_t> balanced_touch_;
  std::vector<std::int32_t> row_touch_, row_grip_, row_load_;
  std::vector<TouchPoint<T>> touch_;
  std::vector<GripPoint> grip_;
  bool jacket_ = false;
  std::vector<std::int32_t> load_;  // grains that a jacket presses in some lane
  Buffer<T> load_force_;
  std::vector<RawCrack> raw_cracks_;
  std::vector<Vec2> built_at_;  // per grain and lane: displacement when the list was built
  bool dirty_ = true;
  bool far_rows_ = false;
  std::int64_t n_rebuilds_ = 0;

  Lane& at(int lane) { return lanes_[static_cast<std::size_t>(lane)]; }
  const Lane& at(int lane) const { return lanes_[static_cast<std::size_t>(lane)]; }
  std::size_t n_grains() const { return x0_.size(); }
  T& grain(std::size_t g, int field, std::size_t lane) {
    return grain_[(g * n_grain_fields + static_cast<std::size_t>(field)) * W_ + lane];
  }
  double grain(std::size_t g, int field, std::size_t lane) const {
    return static_cast<double>(grain_[(g * n_grain_fields + static_cast<std::size_t>(field)) * W_ + lane]);
  }
  T& contact(std::size_t c, int field, std::size_t lane) {
    return contact_[(c * n_contact_fields + static_cast<std::size_t>(field)) * W_ + lane];
  }
  double contact(std::size_t c, int field, std::size_t lane) const {
    return static_cast<double>(
        contact_[(c * n_contact_fields + static_cast<std::size_t>(field)) * W_ + lane]);
  }
  Vec2 displacement(std::size_t g, std::size_t lane) const {
    return {grain(g, g_ux, lane), grain(g, g_uy, lane)};
  }
  std::uint32_t packing_id(std::int32_t sorted) const {
    return static_cast<std::uint32_t>(layout_.order[static_cast<std::size_t>(sorted)]);
  }
  std::size_t sorted_id(std::uint32_t packing) const {
    return static_cast<std::size_t>(layout_.rank[packing]);
  }
  std::size_t n_steps() const { return static_cast<std::size_t>(options_.interval); }
  double sample(int field, std::size_t lane) const {
    return sample_[static_cast<std::size_t>(field) * W_ + lane];
  }
  /// Place of a tool's x component in a step; y follows W_ further on.
  std::size_t tool_at(std::size_t step, std::size_t tool, std::size_t lane) const {
    return (step * n_tools_ + tool) * 2 * W_ + lane;
  }
  Vec2 tool_vector(const Buffer<T>& field, std::size_t step, std::size_t tool, std::size_t lane) const {
    const std::size_t i = tool_at(step, tool, lane);
    return {static_cast<double>(field[i]), static_cast<double>(field[i + W_])};
  }

  void allocate();
  void reset_lane(int lane);
  void check_mate(const Specimen& specimen) const;
  void fill_lane_table();
  GroupView<T> view();
  // list
  void rebuild();
  void search(std::size_t lane);
  std::vector<PairKey> collect_pairs();
  void carry_state(const std::vector<PairKey>& pairs);
  void fill_lane(std::size_t lane);
  void make_constants();
  void assign_joints();
  void fill_joint_row(std::size_t row, const std::string& sets);
  void list_open();
  void births();
  bool birth_of_joint(std::size_t c, std::size_t lane, double gap);
  void tighten_bound(std::size_t lane);
  static void renew_step(Lane& lane) {
    lane.dt = lane.setup.step_safety * 2.0 / (lane.bound->omega() * std::sqrt(1.0 + lane.setup.damping));
  }
  /// Per lane: what the farthest grain has moved since the lane's last search [m], and the largest speed
  /// [m/s].
  struct Farthest {
    std::vector<double> moved, speed;
  };
  Farthest farthest() const;
  void watch_motion(const Farthest& most);
  std::optional<PairKey> missed_pair(std::size_t lane) const;
  // move
  void send_motion(std::size_t lane, Group<T>& to, std::size_t to_lane) const;
  void send_contacts(std::size_t lane, Group<T>& to, std::size_t to_lane) const;
  // rig
  void adopt_rig(const Rig& rig);
  void place_tool(std::size_t tool, std::size_t lane);
  void list_touches();
  void list_grips(const Rig& rig);
  void plan_tools();
  void plan_balance();
  void read_balance();
  Vec2 block_velocity(Lane& lane, ToolMotion& tool) const;
  // jacket
  void fit_jackets();
  void fit_jacket(std::size_t lane);
  double pushed_way(std::size_t grain, std::size_t lane) const;
  double area_swept(std::size_t lane) const;
  // books
  void keep_books(std::size_t lane);
  void book_tools(std::size_t lane);
  Breakage breakage(const RawCrack& raw, std::size_t lane) const;
  void write_row(std::size_t lane);
  void watch(std::size_t lane, const HistoryRow& before, double farthest_way);
  std::string deepest_overlap(std::size_t lane) const;
  ContactState contact_state(std::size_t c, std::size_t lane) const;
};

}  // namespace phy::group
