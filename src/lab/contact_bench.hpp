// The smallest laboratory: one contact between two discs. Disc 1 is clamped, disc 2 is driven through
// closure, slide and rotation, and the law answers step by step, exactly as in the engine (same source, R =
// double). The frame (n, t) stays: the bench shows laws; how it turns with the grains is the engine's matter
// (V0).
#pragma once
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "laws/law.hpp"
#include "records/contact_path.hpp"

namespace phy::lab {

/// A law of the list, for people.
struct LawInfo {
  const char* name;
  const char* sentence;
  std::span<const laws::ParameterInfo> parameters;
};
/// All laws of the list.
const std::vector<LawInfo>& law_infos();

/// One contact under some law.
class BenchContact {
 public:
  virtual ~BenchContact() = default;
  /// Moves disc 2 by an increment. Steps small against the events of interest follow them closely.
  virtual laws::Reaction<double> step(ContactPoint increment) = 0;
  /// Strain energy held after the last step [J/m].
  virtual double energy() const = 0;
  /// Tensile capacity [N/m]; 0: broken, or a law without a bond.
  virtual double capacity() const = 0;
};
/// `parameters` in the order of the law's schema. Null when no law has this name.
std::unique_ptr<BenchContact> bench_contact(std::string_view law, std::span<const double> parameters);

/// State after a step.
struct BenchRow {
  ContactPoint at;
  ContactForces forces;
  double dissipated = 0.0;  ///< by slip and dashpots so far [J/m]
  double released = 0.0;    ///< by breakage so far [J/m]
  double stored = 0.0;      ///< strain energy [J/m]
  int broke = 0;            ///< in this step: 1 tension, 2 shear
};
/// Drives a contact from the origin along straight legs to each corner, `steps` equal steps per leg. The
/// first row is the state at the origin.
std::vector<BenchRow> drive(BenchContact& contact, std::span<const ContactPoint> corners, int steps);

}  // namespace phy::lab
