#include "events/clusters.hpp"

#include <cmath>
#include <map>

#include "analysis/specimen_checks.hpp"
#include "base/clusters.hpp"

namespace phy::events {

Window window_of(const Specimen& specimen) {
  // Of the model and not of the rock: what breaks here are bonds between these grains.
  const double diameter = analysis::grain_diameter(specimen);
  constexpr double E_over_G = 2.5;  // of a Poisson's ratio of 0.25
  const double density = specimen.matrix.density * (1.0 - specimen.packing->report.porosity);
  return {diameter, diameter / std::sqrt(specimen.matrix.modulus() / E_over_G / density)};
}

std::vector<std::vector<std::size_t>> clusters(std::span<const CrackEvent> cracks, const Window& window) {
  Clusters all(cracks.size());
  // Blocks hold few cracks, so that all pairs are looked at.
  for (std::size_t i = 0; i < cracks.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (norm(cracks[i].position - cracks[k].position) <= window.reach &&
          std::fabs(cracks[i].time - cracks[k].time) <= window.duration)
        all.join(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(k));
  // A cluster has the number of its first member, so that the clusters come in the order in which they began.
  std::map<std::uint32_t, std::vector<std::size_t>> members;
  for (std::size_t i = 0; i < cracks.size(); ++i)
    members[all.find(static_cast<std::uint32_t>(i))].push_back(i);
  std::vector<std::vector<std::size_t>> found;
  for (auto& [first, some] : members) found.push_back(std::move(some));
  return found;
}

}  // namespace phy::events
