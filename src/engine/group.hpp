// The group behind LaneGroup. Inside the engine only. It runs blocks of cycles over its parts and owns the
// specimens in the lanes; each part says in its header what it owns.
//   grain_memory     order and state of the grains
//   neighbour_list   which pairs are looked at
//   contact_memory   states of the contacts by their models
//   wide_contacts    the same, side by side, while a specimen that is alone runs
//   boundary_memory  bodies and jacket
//   energy_balance   work and where it went
// Its members: group.cpp loading, the block of cycles, states for others; group_contacts.cpp renewing the
// list, creation of contacts, the stable step; group_rows.cpp history rows, cracks, watchdog.
#pragma once
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/boundary_memory.hpp"
#include "engine/contact_memory.hpp"
#include "engine/energy_balance.hpp"
#include "engine/lane_group.hpp"
#include "engine/neighbour_list.hpp"
#include "engine/stable_step.hpp"
#include "engine/wide_contacts.hpp"

namespace phy::engine::group {

/// What the group knows about one specimen beside its places in the parts.
struct Lane {
  std::shared_ptr<const Specimen> specimen;  // null: empty lane
  LaneSetup setup;
  bool fresh = false;  // loaded, contacts not yet installed
  bool unbreakable = false;
  std::optional<FrequencyBound> bound;
  std::map<PairKey, ContactStiffness> created;  // contacts without a bond that the bound counts
  double dt = 0.0, time = 0.0;
  std::int64_t step = 0;
  EnergyBalance energy;
  double base_axial = 0.0, base_lateral = 0.0;  // of the strain gauge
  double zero_travel = 0.0;                     // of the axial bodies where strains count from [m]
  HistoryRow row;
  LaneHealth health;
  std::vector<Breakage> cracks;
  std::int64_t n_contacts = 0;

  const Boundary& boundary() const { return *setup.boundary; }
};

template <class T>
class Group final : public LaneGroup {
 public:
  Group(std::shared_ptr<const Packing> packing, const GroupOptions& options);

  int lanes() const override { return options_.lanes; }
  void load(int lane, std::shared_ptr<const Specimen> specimen, const LaneSetup& setup) override;
  void clear(int lane) override;
  void move_lane(int lane, LaneGroup& target, int to_lane) override;
  void place_boundary(int lane) override;
  void zero_strains(int lane) override;
  void forbid_breakage(int lane, bool forbid) override { at(lane).unbreakable = forbid; }
  void prescribe(int lane, int body, const PrescribedMotion& prescribed) override {
    boundary_.prescribe(index(lane), static_cast<std::size_t>(body), prescribed);
  }
  void press(int lane, double pressure) override {
    boundary_.lane(index(lane)).sides.stress = {pressure, 0.0};
  }
  void press_hole(int lane, Vec2 stress) override { boundary_.lane(index(lane)).hole.stress = stress; }
  void start_moving(int lane, const std::function<Vec2(Vec2)>& velocity) override;
  void pre_strain(int lane, double axial_strain) override;
  bool at_strength(int lane) const override;
  void set_motion(int lane, std::uint32_t id, const GrainState& state, Vec2 velocity, double spin) override;
  void advance() override;

  const HistoryRow& row(int lane) const override { return at(lane).row; }
  const BodyState& body(int lane, int body) const override {
    return boundary_.lane(index(lane)).bodies[static_cast<std::size_t>(body)].state;
  }
  JacketState jacket(int lane) const override {
    const PressedSurface& sides = boundary_.lane(index(lane)).sides;
    return {sides.stress.x, sides.swept};
  }
  double hole_swept(int lane) const override { return boundary_.lane(index(lane)).hole.swept; }
  const LaneHealth& health(int lane) const override { return at(lane).health; }
  std::vector<Breakage>& cracks(int lane) override { return at(lane).cracks; }
  Snapshot snapshot(int lane) const override;
  std::vector<GrainState> grains(int lane) const override { return grains_.states(index(lane)); }
  double time_step(int lane) const override { return at(lane).dt; }
  std::int64_t n_contacts(int lane) const override { return at(lane).n_contacts; }
  std::int64_t n_rebuilds() const override { return n_rebuilds_; }
  std::int64_t n_listed() const override { return static_cast<std::int64_t>(contacts_.size()); }

 private:
  GroupOptions options_;
  std::size_t W_;
  Kernel<T> kernel_;
  std::vector<Lane> lanes_;
  GrainMemory<T> grains_;
  NeighbourList<T> list_;
  ContactMemory<T> contacts_;
  std::optional<WideContacts<T>> wide_;  // where one specimen fills the register with its contacts
  BoundaryMemory<T> boundary_;
  Buffer<T> lane_table_, slip_, damping_;
  Buffer<double> sample_;
  std::vector<RawCrack> raw_cracks_;
  std::vector<std::size_t> open_;  // contacts that create_contacts() looks at
  bool dirty_ = true;              // lists and tables have to be made anew before the next block
  bool rearranged_ = true;         // contacts or their interfaces have changed since they were laid out
  std::int64_t n_rebuilds_ = 0;
  struct {
    std::vector<T> grains, contacts;
    typename BoundaryMemory<T>::State boundary;
  } kept_;  // as the block began, where it may be run again

  static std::size_t index(int lane) { return static_cast<std::size_t>(lane); }
  Lane& at(int lane) { return lanes_[index(lane)]; }
  const Lane& at(int lane) const { return lanes_[index(lane)]; }
  std::size_t n_steps() const { return static_cast<std::size_t>(options_.interval); }
  double block(std::size_t l) const { return lanes_[l].dt * options_.interval; }  ///< [s]
  bool running(std::size_t l) const { return lanes_[l].specimen && !lanes_[l].fresh; }
  double sample(int field, std::size_t lane) const {
    return sample_[static_cast<std::size_t>(field) * W_ + lane];
  }
  LaneSpecimens specimens() const;

  void check_neighbour(const Specimen& specimen) const;
  void fill_lane_table();
  GroupView<T> view();
  void run(GroupView<T>& view);
  GroupView<T> run_block();
  void keep();
  void restore();
  /// Grains are thrown about by what has broken; what flies apart before anything has is left to the
  /// watchdog.
  bool may_outrun(std::size_t lane) const { return running(lane) && !lanes_[lane].cracks.empty(); }
  bool outran(std::size_t lane, double farthest_way) const;
  bool some_outran(std::vector<int>& repeats);
  void set_step(std::size_t l);
  // contacts
  void rebuild(bool forgotten_only = false);
  std::vector<PairKey> collect_pairs(bool forgotten_only);
  void list_open();
  void create_contacts();
  bool create_interface(std::size_t c, std::size_t lane, double gap);
  Contact created(std::size_t c, std::size_t lane) const;
  void renew_step(std::size_t lane);
  void tighten_bound(std::size_t lane);
  // rows
  void sort_cracks(const GroupView<T>& view);
  void keep_energy(std::size_t lane);
  Breakage breakage(const RawCrack& raw, std::size_t lane) const;
  double travel(std::size_t lane) const;
  void write_row(std::size_t lane);
  void watch(std::size_t lane, const HistoryRow& before, double farthest_way);
  std::optional<PairKey> missed_pair(std::size_t lane, double farthest_way) const;
  std::string deepest_overlap(std::size_t lane) const;
};

}  // namespace phy::engine::group
