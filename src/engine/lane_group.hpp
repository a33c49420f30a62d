// A group: up to W specimens of one packing that run side by side in the lanes of the force loop.
//
// The group owns the memory, the list of near pairs, the time steps and the energy balance; the laboratory
// (lab/) decides what is loaded, when a test ends and what is kept. All lanes share the list (the union of
// what each needs); a pair that concerns other lanes only contributes zeros. Checks happen at the end of a
// block of `interval` cycles, which is a constant of the recipe: list, creation of contacts, time step,
// watchdog, history.
#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "engine/boundary.hpp"
#include "engine/kernels.hpp"
#include "records/result.hpp"
#include "records/specimen.hpp"

namespace phy::engine {

/// Numerics of a group; never changes a bit, except `interval` and `inertia`.
struct GroupOptions {
  Isa isa = Isa::sse2;
  Precision precision = Precision::double_precision;
  int lanes = 1;
  int skew = 8;                               ///< cycles per sweep
  int interval = 100;                         ///< cycles between checks (recipe: test.history_interval)
  GrainInertia inertia = GrainInertia::disc;  ///< recipe: engine.grain_inertia
  const ContactPhysics* contacts = &physics_of({}, {});  ///< models of matrix and interfaces
};

/// Numerics and boundary of a lane. Lanes of a group share the geometry of the boundary.
struct LaneSetup {
  double damping = 0.7;
  double step_safety = 0.92;
  double body_friction = 0.0;                          ///< of the rough bodies
  std::shared_ptr<const Boundary> boundary = nullptr;  ///< null: no boundary at all
};

/// What the watchdog saw at the end of a block.
struct LaneHealth {
  bool ok = true;
  std::string reason;   ///< which of its checks has fired, with numbers
  bool outran = false;  ///< two grains met that were not looked for as a contact
};

/// A bond or joint that has broken, and where the bodies were then.
struct Breakage {
  CrackEvent crack;     ///< without its strain, which the test defines
  double travel = 0.0;  ///< of the axial bodies since the boundary was placed [m]
};

class LaneGroup {
 public:
  virtual ~LaneGroup() = default;

  virtual int lanes() const = 0;
  /// Puts a specimen into a lane, at rest, its boundary not yet in place. Throws InternalError when it is of
  /// another packing, or geometry of contacts, than its neighbours.
  virtual void load(int lane, std::shared_ptr<const Specimen> specimen, const LaneSetup& setup) = 0;
  /// Empties a lane.
  virtual void clear(int lane) = 0;
  /// Moves a running specimen into an empty lane of another group of the same packing, precision and block.
  /// Between blocks only; the state of both groups is whole again after their next block.
  virtual void move_lane(int lane, LaneGroup& to, int to_lane) = 0;
  /// Sets the boundary against the specimen as it lies now, at rest, and starts the balance at zero.
  virtual void place_boundary(int lane) = 0;
  /// The strains of the gauges, and the travel that the watchdog's energy check depends on, count from now.
  virtual void zero_strains(int lane) = 0;
  /// Stops or allows breakage (relaxation, affine pre-strain, elastic runs).
  virtual void forbid_breakage(int lane, bool forbid) = 0;
  /// How a body moves from now on.
  virtual void prescribe(int lane, int body, const PrescribedMotion& prescribed) = 0;
  /// Pressure of the jacket on the sides from now on [Pa].
  virtual void press(int lane, double pressure) = 0;
  /// Stress of the jacket on the wall of the hole, along x and y; compression positive [Pa].
  virtual void press_hole(int lane, Vec2 stress) = 0;
  /// Gives all grains a velocity [m/s] by their place; its energy enters the balance as work.
  virtual void start_moving(int lane, const std::function<Vec2(Vec2)>& velocity) = 0;
  /// Sets the affine pre-strain along the boundary's axial axis (y), boundary in place.
  /// Its strain energy enters the balance as work.
  virtual void pre_strain(int lane, double axial_strain) = 0;
  /// True when a bond or joint carries its strength or more: it would break the moment breakage is allowed.
  virtual bool at_strength(int lane) const = 0;
  /// Gives a grain (packing number) a displacement [m, rad], a velocity [m/s] and a spin [rad/s].
  virtual void set_motion(int lane, std::uint32_t grain, const GrainState& at, Vec2 velocity,
                          double spin) = 0;
  /// One block of `interval` cycles for all lanes.
  virtual void advance() = 0;

  /// State at the end of the block: gauges, energies, bookkeeping. Strain and stress of the boundary are
  /// left at 0: the test makes them from bodies and jacket. Where the watchdog has fired only step and time
  /// are of now: the rest is the last row that had passed it.
  virtual const HistoryRow& row(int lane) const = 0;
  virtual const BodyState& body(int lane, int body) const = 0;
  virtual JacketState jacket(int lane) const = 0;
  /// Area that the wall of the hole has swept since the boundary was placed, into the rock positive [m^2].
  virtual double hole_swept(int lane) const = 0;
  virtual const LaneHealth& health(int lane) const = 0;
  virtual std::vector<Breakage>& cracks(int lane) = 0;  ///< all so far, ordered within each block
  virtual Snapshot snapshot(int lane) const = 0;        ///< grains and contacts now; no strain, no stress
  /// Displacements of all grains now, packing order.
  virtual std::vector<GrainState> grains(int lane) const = 0;
  virtual double time_step(int lane) const = 0;         ///< [s]
  virtual std::int64_t n_contacts(int lane) const = 0;  ///< bonded, joint or touching when loaded
  virtual std::int64_t n_rebuilds() const = 0;
  virtual std::int64_t n_listed() const = 0;  ///< near pairs in the list
};

std::unique_ptr<LaneGroup> make_group(std::shared_ptr<const Packing> packing, const GroupOptions& options);

}  // namespace phy::engine
