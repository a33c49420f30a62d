#include "calibrate/method.hpp"

#include "calibrate/sequence.hpp"

namespace phy::calibrate {

const Method& method_of(CalibrationMethod id) {
  static const Method posterior = {.has_posterior = true,
                                   .compares_models = true,
                                   .needs_ucs = false,
                                   .check = [](const Evidence&) {},
                                   .fit_moduli =
                                       [](const ModuliTask& t) {
                                         return fit_elastic(t.evidence, t.packings, t.spare, t.simulator,
                                                            t.listener.begins);
                                       },
                                   .fit_strengths = fit_strength};
  static const Method sequence = {.has_posterior = false,
                                  .compares_models = false,
                                  .needs_ucs = true,  // it has no other way to sigma_c
                                  .check = check_sequence,
                                  .fit_moduli =
                                      [](const ModuliTask& t) {
                                        return moduli_by_sequence(t.evidence, t.packings, t.simulator,
                                                                  t.listener.begins);
                                      },
                                  .fit_strengths = strengths_by_sequence};
  return id == CalibrationMethod::posterior ? posterior : sequence;
}

}  // namespace phy::calibrate
