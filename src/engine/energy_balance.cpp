#include "engine/energy_balance.hpp"

namespace phy::engine::group {

void EnergyBalance::begin(const HistoryRow& r) {
  work = slip = damping = released = 0.0;
  // Without strain_wall: bodies are placed stress-free, which lets go what grains against them held before.
  base_ = r.kinetic + r.strain_linear + r.strain_bond + r.strain_joint;
}

void EnergyBalance::write(HistoryRow& r) {
  r.slip = slip;
  r.damping = damping;
  r.released = released;
  // Spent = stored since the start + dissipated. With exact time stepping it equals the work.
  const double held = r.kinetic + r.strain_linear + r.strain_bond + r.strain_joint + r.strain_wall - base_;
  const double spent = held + r.slip + r.damping + r.released;
  // A state that was set (pre-strain) has not been worked for: the difference is counted as work once.
  if (settle_) work = spent;
  settle_ = false;
  r.boundary_work = work;
  r.energy_error = work > 0.0 ? (work - spent) / work : 0.0;
}

}  // namespace phy::engine::group
