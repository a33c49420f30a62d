// What the direct elastic solution of a specimen leaves behind. Plain data, SI units; compression and
// shortening positive.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace phy {

enum class ElasticStatus {
  solved,         ///< E and nu are answers; grains that carry no load may have been left aside (n_loose)
  not_converged,  ///< solved, but more contacts than allowed still alternate between open and closed
  bad_stiffness,  ///< a stiffness is negative, not finite, or all are zero; or two grains share a centre
  no_load_path,   ///< no chain of contacts joins the platens
  mechanism,      ///< the load meets a part that moves without resistance
  no_gauge        ///< too few grains in the middle of the specimen to read a strain from
};

/// How the solution ended. Not an error: it is stored like any other result.
struct ElasticOutcome {
  ElasticStatus status = ElasticStatus::solved;
  std::string reason;                 ///< what happened, with grain numbers; empty when nothing is to be said
  std::string advice;                 ///< what to change; empty when all went well
  std::vector<std::uint32_t> grains;  ///< the grains meant by `reason`, ascending
  bool ok() const { return status == ElasticStatus::solved; }
};

/// Derivatives of the gauge values with respect to one parameter, at the final set of closed contacts.
struct Sensitivity {
  std::string
      parameter;  ///< key of the recipe: "matrix.E_c", "bedding[0].k_n"; "ks_over_kn" = both ratios together
  std::string unit;
  double value = 0.0;  ///< of the parameter
  double dE = 0.0;     ///< dE_gauge / d parameter [Pa per unit]
  double dnu = 0.0;    ///< dnu_gauge / d parameter [1 per unit]
};

/// Small-strain answer of one specimen between platens. Numbers are NaN where the outcome gives none.
struct ElasticResult {
  std::string name;        ///< of the specimen
  bool bilateral = false;  ///< linear contacts also pull (an idealisation)
  ElasticOutcome outcome;
  double E_gauge = 0.0;         ///< mean platen stress / axial strain of the middle 60 % of the height [Pa]
  double nu_gauge = 0.0;        ///< -lateral / axial strain, both of the middle 60 %
  double E_platen = 0.0;        ///< mean platen stress / (approach of the platens / height) [Pa]
  std::int64_t n_contacts = 0;  ///< between grains, with a linear part, bond or joint
  std::int64_t n_open = 0;      ///< linear parts between grains that carry nothing because they would pull
  std::int64_t n_alternating = 0;  ///< contacts whose state, open or closed, the solution contradicts
  std::int64_t n_loose = 0;        ///< grains that carry no load
  int n_iterations = 0;            ///< factorisations
  std::vector<Sensitivity> sensitivities;
  double seconds = 0.0;  ///< of wall clock: assembly, factorisations, sensitivities
};

}  // namespace phy
