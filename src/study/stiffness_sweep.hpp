// K_n(k_n) and K_s(k_s): which macro joint stiffness a specimen shows for the smooth joints that it holds.
//
// For every packing the joint stiffnesses of the first bedding set are varied, k_n first, then k_s,
// everything else kept; each time E(theta) is computed directly (statics/uniaxial.hpp), Eq. 1 is fitted to it
// (theory/eq1_fit.hpp) and a line is laid through K_n(k_n) and K_s(k_s). The answer depends on choices that a
// paper may leave open, so all of them are computed: contacts that only push or also pull, strain read by the
// gauge or from the platens, the loss of the fit and the modulus it refers to. docs/theory/eq2.md
#pragma once
#include <array>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/stats.hpp"
#include "records/elastic.hpp"
#include "records/recipe.hpp"
#include "records/specimen.hpp"
#include "theory/eq1_fit.hpp"

namespace phy::study {

enum class Contacts { pushing, pulling };     ///< linear contacts only push, or also pull (an idealisation)
enum class StrainReading { gauge, platens };  ///< middle 60 % of the height, or approach of the platens
enum class SweptStiffness { normal, shear };  ///< k_n and K_n, or k_s and K_s

/// One pair of joint stiffnesses: E and nu at all angles.
struct SweptSet {
  double k_n = 0.0, k_s = 0.0;                        ///< [Pa/m]
  std::array<std::vector<ElasticResult>, 2> results;  ///< by Contacts; in the order of the angles
};

/// One packing under one bedding rule, through the whole sweep.
struct SweptPacking {
  std::shared_ptr<const Packing> packing;
  std::int64_t seed = 0;
  BeddingRule rule = BeddingRule::zone;
  double spacing = 0.0;        ///< of the first bedding set [m]
  std::vector<double> angles;  ///< [deg]
  BeddingReport bedding;       ///< of the first set, mean over the angles
  std::array<ElasticResult, 2> intact;
  std::vector<SweptSet> sets;                     ///< every pair of stiffnesses once
  std::array<std::vector<std::size_t>, 2> swept;  ///< by SweptStiffness: numbers of `sets`, factors ascending
};

/// The packings of a sweep, in the order of their seeds (packing.seed, seed + 1, ...), from the cache or
/// made.
std::vector<std::shared_ptr<const Packing>> sweep_packings(const Recipe& recipe, int threads);

/// One packing through recipe.sweep.factors, with the given rule in all bedding sets. Needs a recipe that has
/// passed its checks with factors in it.
SweptPacking sweep_stiffness(const std::shared_ptr<const Packing>& packing, std::int64_t seed,
                             const Recipe& recipe, BeddingRule rule, int threads);

/// How E(theta) is read and fitted.
struct MacroReading {
  Contacts contacts = Contacts::pushing;
  StrainReading strain = StrainReading::gauge;
  theory::Eq1Loss loss = theory::Eq1Loss::compliance;
  theory::Eq1Reference reference = theory::Eq1Reference::given;
};

/// Eq. 1 fitted to one set of a packing.
theory::Eq1Fit fit_macro(const SweptPacking& swept, const SweptSet& set, const MacroReading& reading);

/// K = slope k + intercept through a sweep: one line per packing, then mean and interval over the packings.
struct MacroLine {
  Summary slope;      ///< [-]
  Summary intercept;  ///< [Pa/m]
  Summary R2;
  /// The other stiffness at the largest factor over that at the smallest, minus 1: 0 if each of K_n and K_s
  /// follows its own k alone.
  Summary cross;
  std::string refused;  ///< why the last packing without a line has none; empty if all have one
};
MacroLine fit_macro_line(std::span<const SweptPacking> packings, SweptStiffness what,
                         const MacroReading& reading);

}  // namespace phy::study
