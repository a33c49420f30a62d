// A group: up to W specimens of one packing that run side by side in the lanes of the force loop.
//
// The group owns the memory, the list of near pairs, the time steps and the energy books; the laboratory
// (lab/) decides what is loaded, when a test ends and what is kept. All lanes share the list (the union of
// what each needs); a pair that concerns other lanes only contributes zeros. Checks happen at the end of a
// block of `interval` cycles, which is a constant of the recipe: list, births of contacts, time step,
// watchdog, history.
#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "engine/kernels.hpp"
#include "records/result.hpp"
#include "records/specimen.hpp"

namespace phy {

/// Numerics of a group; never changes a bit, except `interval`.
struct GroupOptions {
  Isa isa = Isa::sse2;
  Precision precision = Precision::double_precision;
  int lanes = 1;
  int skew = 4;        ///< cycles per sweep
  int interval = 100;  ///< cycles between checks (recipe: test.history_interval)
};

/// How a lane is driven.
struct LaneSetup {
  double damping = 0.7;
  double step_safety = 0.92;
  double platen_speed = 0.05;  ///< of each platen [m/s]
  double ramp_strain = 2e-5;   ///< axial strain gained while the speed rises linearly from 0
  double platen_friction = 0.0;
  double jump_strain = 0.0;  ///< start from an affine state of this axial strain
};

/// What the watchdog saw at the end of a block.
struct LaneHealth {
  bool ok = true;
  std::string reason;
};

class LaneGroup {
 public:
  virtual ~LaneGroup() = default;

  virtual int lanes() const = 0;
  /// Puts a specimen into a lane, at rest, without platens. Throws InternalError when it is of another
  /// packing.
  virtual void load(int lane, std::shared_ptr<const Specimen> specimen, const LaneSetup& setup) = 0;
  /// Empties a lane.
  virtual void clear(int lane) = 0;
  /// Sets both platens against the specimen as it lies now and starts the books at zero.
  virtual void place_platens(int lane) = 0;
  /// Stops or allows breakage (relaxation, jump start, elastic runs).
  virtual void hold_bonds(int lane, bool hold) = 0;
  /// Moves or stops the platens (speed 0 keeps them where they are).
  virtual void drive_platens(int lane, bool on) = 0;
  /// Sets the affine state of the jump start; platens must be placed. Its strain energy enters the books as
  /// work.
  virtual void jump(int lane, double axial_strain) = 0;
  /// True when a bond or joint carries its strength or more: it would break the moment breakage is allowed.
  virtual bool at_strength(int lane) const = 0;
  /// Gives a grain (packing number) a displacement [m, rad], a velocity [m/s] and a spin [rad/s].
  virtual void set_motion(int lane, std::uint32_t grain, const GrainState& at, Vec2 velocity,
                          double spin) = 0;
  /// One block of `interval` cycles for all lanes.
  virtual void advance() = 0;

  virtual const HistoryRow& row(int lane) const = 0;  ///< state at the end of the block
  virtual const LaneHealth& health(int lane) const = 0;
  virtual std::vector<CrackEvent>& cracks(int lane) = 0;  ///< all so far, ordered within each block
  virtual Snapshot snapshot(int lane) const = 0;          ///< grains and contacts now
  /// Displacements of all grains now, packing order.
  virtual std::vector<GrainState> grains(int lane) const = 0;
  virtual double time_step(int lane) const = 0;         ///< [s]
  virtual std::int64_t n_contacts(int lane) const = 0;  ///< bonded, joint or touching when loaded
  virtual std::int64_t n_rebuilds() const = 0;
  virtual std::int64_t n_listed() const = 0;  ///< near pairs in the list
};

std::unique_ptr<LaneGroup> make_group(std::shared_ptr<const Packing> packing, const GroupOptions& options);

}  // namespace phy
