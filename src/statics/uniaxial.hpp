// E and nu of a specimen between two platens, by direct solution instead of time stepping.
//
// The platens approach by a unit strain; all answers are ratios, so nothing depends on its size. Strains are
// read like those of the press: platen strain 2 delta / H, and the least-squares gauge of the middle 60 % of
// the height (engine/layout.hpp). Stress is the mean platen force over the width.
//
// Contacts push but do not pull. Which of the unilateral parts act is found by iteration: all act at first;
// after each solution those whose grains part are taken out and those whose grains approach are put back. An
// open contact loses its shear spring too, so no energy is minimised and a few contacts find no consistent
// state (closed they open, open they close). A contact that changes its state for the third time is held open
// for good: this ends every cycle, always in the same way. Done when nothing changes, or when E and nu change
// by less than `tolerance` and no more than `max_alternating` of the contacts still change. Rejected: a line
// search on energy (there is none), half stiffnesses (neither state's answer). `bilateral` skips all this:
// the linear idealisation of a fully cemented grain skeleton.
//
// Sensitivities come from the same factor. With F the platen force, u the solution for platens moved by d in
// all:
//   dF/dp = u.(dK/dp) u / d                                the forces of the platens do no other work
//   d(w.u)/dp = -lambda.(dK/dp) u,  K lambda = w           for a strain gauge w.u
// at the final set of closed contacts (where a contact changes its state E has a kink).
// docs/theory/statics.md
#pragma once
#include <atomic>
#include <memory>
#include <optional>

#include "records/elastic.hpp"
#include "statics/system.hpp"

namespace phy::statics {

struct ElasticOptions {
  bool bilateral = false;  ///< unilateral parts also pull
  Platens platens = Platens::frictionless;
  bool sensitivities = true;
  double tolerance = 1e-6;         ///< relative change of E, absolute change of nu
  double max_alternating = 0.005;  ///< of the contacts
  int max_iterations = 50;
  const std::atomic<bool>* stop = nullptr;  ///< solve_all begins no more once it is set
};

/// Solves specimens one after the other; keeps the symbolic factorisation while packing and contacts stay the
/// same. Not shared between threads: one per thread.
class UniaxialStatics {
 public:
  ElasticResult solve(const Specimen& specimen, const ElasticOptions& options = {});
  /// As solve, with the closed unilateral parts given (one per link of the last network) instead of searched
  /// for.
  ElasticResult solve_held(const Specimen& specimen, const std::vector<char>& active,
                           const ElasticOptions& options = {});
  /// State of every link after the last solve: 1 = its unilateral part acts.
  const std::vector<char>& active() const { return active_; }
  /// Movements of grains and platens at axial strain 1 after the last solve; empty if there is no answer.
  const Movements& movements() const { return u_; }
  const Network& network() const { return network_; }

 private:
  struct Reading {
    double force = 0.0, axial = 0.0,
           lateral = 0.0;  // mean platen force, gauge strains (compression positive)
    double E = 0.0, nu = 0.0;
  };
  void prepare(const Specimen& specimen, const ElasticOptions& options);
  bool step(ElasticResult& result, Reading& reading);
  void read(Reading& reading);
  struct Update {
    std::size_t wrong = 0;  // contacts that the solution contradicts: open and closing, or closed and parting
    std::size_t changed = 0;  // those among them that were changed
  };
  Update update(std::vector<std::uint8_t>& changes);
  void finish(ElasticResult& result, const Reading& reading, const ElasticOptions& options);
  void add_sensitivities(ElasticResult& result, const Reading& reading) const;

  std::optional<StiffnessSystem> system_;
  const Specimen* specimen_ = nullptr;  // during solve only
  Network network_;
  std::vector<Freedom> prescribed_;
  Boundary boundary_;
  std::vector<laws::Tangent<double>> k_;
  std::vector<char> active_;
  Movements u_;
  std::vector<double> gauge_axial_, gauge_lateral_;  // weights over all degrees of freedom
};

/// One specimen, once.
ElasticResult solve_uniaxial(const Specimen& specimen, const ElasticOptions& options = {});

/// All specimens (angles, parameter sets), in parallel; the results do not depend on the number of threads.
std::vector<ElasticResult> solve_all(const std::vector<Specimen>& specimens, const ElasticOptions& options,
                                     int threads);

}  // namespace phy::statics
