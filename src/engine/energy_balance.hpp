// The energy balance of a specimen, per metre of thickness [J/m], kept block by block in double:
//
//   work of the boundary = d(kinetic + strain energies) + slip + damping + released
//
// with d(...) since the boundary was placed. Strain energies are those of grains, cement, interfaces and of
// grains against bodies; slip is the work of friction and dilation, damping that of local damping, released
// what bonds held when they broke. Nothing in it is fitted: what is left over, as a fraction of the work, is
// the energy error of the time stepping (HistoryRow::energy_error), which the watchdog and the quality of a
// result go by.
#pragma once
#include "records/result.hpp"

namespace phy::engine::group {

class EnergyBalance {
 public:
  double work = 0.0;      ///< of the boundary
  double slip = 0.0;      ///< lost to friction
  double damping = 0.0;   ///< lost to local damping
  double released = 0.0;  ///< lost by breakage

  /// From zero, with what the specimen holds in `row`.
  void begin(const HistoryRow& row);
  /// The next row sets the work equal to stored plus dissipated energy: its state was prescribed
  /// (pre-strain), not loaded by the boundary, and must not appear as an energy error.
  void settle() { settle_ = true; }
  /// Completes a row that has its kinetic and strain energies.
  void write(HistoryRow& row);

 private:
  double base_ = 0.0;
  bool settle_ = false;
};

}  // namespace phy::engine::group
