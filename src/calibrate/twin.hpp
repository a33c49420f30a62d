// A twin: a synthetic table made by the model itself from known parameters, to try the calibration on.
//
// Response: UCS by the press, loaded from rest; E and nu by the direct solution (one-sided contacts) where
// the table is to hold those at small strain, else as a laboratory reads them off the same tests. Means over
// packings that the calibration never uses. A specimen of the laboratory is that response times 1 + noise,
// independent for every quantity, angle and specimen.
#pragma once
#include <cstdint>
#include <vector>

#include "calibrate/simulator.hpp"
#include "records/calibration.hpp"

namespace phy::calibrate {

struct TwinOptions {
  std::vector<double> angles = {0, 15, 30, 45, 60, 75, 90};  ///< [deg]
  std::vector<std::int64_t> seeds = {1001, 1002, 1003, 1004, 1005};
  int n_specimens = 3;
  double noise = 0.05;
  std::uint32_t noise_seed = 1;
};

/// Noise-free E, nu and UCS of a model at angles, in this order, mean over packings, with the settings of the
/// calibration's tests.
std::vector<Comparison> twin_response(const Recipe& truth, const std::vector<double>& angles,
                                      const std::vector<std::int64_t>& seeds, Simulator& simulator,
                                      ModulusReading E_is = ModulusReading::small_strain);

/// Readings of specimens with that response; one row per angle and specimen.
std::vector<RockReading> twin_readings(const std::vector<Comparison>& response, const TwinOptions& options);

/// The readings as a table that parse_readings reads; without bedding it has no column theta.
std::string readings_csv(const std::vector<RockReading>& readings, bool bedded);

}  // namespace phy::calibrate
