// E(theta) and nu(theta) of a recipe by direct solution, and the macro joint stiffnesses that they show.
#pragma once
#include <atomic>
#include <string>
#include <vector>

#include "records/elastic.hpp"
#include "records/recipe.hpp"
#include "records/specimen.hpp"
#include "statics/uniaxial.hpp"
#include "theory/eq1_fit.hpp"

namespace phy::study {

/// The specimens of a recipe with both answers. The intact specimen is always there, as the last one, unless
/// the matrix has directions: then no specimen is intact.
struct ElasticStudy {
  Recipe recipe;
  std::vector<Specimen> specimens;
  std::vector<ElasticResult> one_sided, bilateral;
  double seconds = 0.0;  ///< of all solutions

  bool has_intact() const { return !layered(specimens.back()); }
  std::size_t n_angles() const { return specimens.size() - (has_intact() ? 1 : 0); }
  /// [deg]
  double theta(std::size_t i) const { return inclination(specimens[i]); }
  const ElasticResult& intact() const { return one_sided.back(); }
};

/// Solves the whole specimens, whatever test the recipe names. `stop` as of statics::solve_all and
/// genesis::packing_of.
ElasticStudy solve_recipe(const Recipe& recipe, statics::Platens platens, int threads,
                          const std::atomic<bool>* stop = nullptr);

/// Eq. 1 fitted with one kind of contacts and one reference.
struct NamedFit {
  std::string name;
  theory::Eq1Fit fit;
};

/// Contacts that push only, then also pull; the reference E that of intact rock, of 90 degrees, free.
std::vector<NamedFit> fit_all(const ElasticStudy& study, theory::Eq1Loss loss);

}  // namespace phy::study
