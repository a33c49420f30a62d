#include "analysis/specimen_checks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "base/clusters.hpp"
#include "base/nan.hpp"

namespace phy::analysis {
namespace {

double largest_overlap(const Specimen& s) {
  double most = 0.0;
  for (const Contact& c : s.contacts) {
    const Disc &a = s.packing->discs[c.a], &b = s.packing->discs[c.b];
    most = std::max(most, (a.r + b.r - norm(Vec2{b.x - a.x, b.y - a.y})) / std::min(a.r, b.r));
  }
  return most;
}

using Neighbours = std::vector<std::vector<std::uint32_t>>;

Neighbours neighbours_of(const Specimen& s) {
  Neighbours of(s.packing->discs.size());
  for (const Contact& c : s.contacts) of[c.a].push_back(c.b), of[c.b].push_back(c.a);
  return of;
}

/// Marks the grains that nothing can load: taking one away may leave its neighbour with one contact.
std::vector<char> dangling(const Neighbours& of) {
  std::vector<std::size_t> left(of.size());
  std::vector<std::uint32_t> next;
  std::vector<char> gone(of.size(), 0);
  for (std::uint32_t g = 0; g < of.size(); ++g)
    // One contact cannot hold a grain: it turns about it.
    if (left[g] = of[g].size(); left[g] < 2) next.push_back(g);
  while (!next.empty()) {
    const std::uint32_t g = next.back();
    next.pop_back();
    if (gone[g] != 0) continue;
    gone[g] = 1;
    for (const std::uint32_t n : of[g])
      if (gone[n] == 0 && --left[n] < 2) next.push_back(n);
  }
  return gone;
}

double rattlers(const Specimen& s) {
  const std::vector<char> gone = dangling(neighbours_of(s));
  Clusters parts(gone.size());
  for (const Contact& c : s.contacts)
    if (gone[c.a] == 0 && gone[c.b] == 0) parts.join(c.a, c.b);
  std::vector<std::size_t> size(gone.size(), 0);
  for (std::uint32_t g = 0; g < gone.size(); ++g) size[parts.find(g)] += gone[g] == 0 ? 1 : 0;
  const auto largest = *std::max_element(size.begin(), size.end());
  return 1.0 - static_cast<double>(largest) / static_cast<double>(gone.size());
}

double fewest_joints(const Specimen& s) {
  std::vector<double> n(s.bedding.size(), 0.0);
  for (const Contact& c : s.contacts)
    if (c.kind == ContactKind::joint) n[s.set_of(c.set)] += 1.0;
  // Layers may have no joints on purpose.
  for (std::size_t i = 0; i < n.size(); ++i)
    if (s.bedding[i].unjointed()) n[i] = std::numeric_limits<double>::infinity();
  return *std::min_element(n.begin(), n.end());
}

}  // namespace

Number broken_at_start(const Specimen& specimen, const std::vector<CrackEvent>& cracks, std::int64_t step) {
  Number share{
      "broken_at_start", nan, "1",
      "share of the matrix bonds that the confining, normal or far-field stress broke before loading began",
      ""};
  // Pairs and not cracks: a bond of four elements breaks four times.
  std::set<std::pair<std::uint32_t, std::uint32_t>> bonds;
  for (const Contact& c : specimen.contacts)
    if (c.kind == ContactKind::bonded && (c.sigma_c > 0.0 || c.tau_c > 0.0)) bonds.emplace(c.a, c.b);
  const auto n_bonds = static_cast<double>(bonds.size());
  for (const CrackEvent& c : cracks)
    // In the order of the specimen's pairs.
    if (c.step <= step) bonds.erase({std::min(c.a, c.b), std::max(c.a, c.b)});  // parts of a bond count once
  if (n_bonds > 0.0)
    share.value = 1.0 - static_cast<double>(bonds.size()) / n_bonds;
  else
    share.note = "the matrix has no bonds";
  return share;
}

double grain_diameter(const Specimen& specimen) {
  const std::vector<Disc>& discs = specimen.packing->discs;
  double sum = 0.0;
  for (const Disc& d : discs) sum += 2.0 * d.r;
  return sum / static_cast<double>(discs.size());
}

std::vector<Number> specimen_checks(const Specimen& specimen) {
  const Packing& p = *specimen.packing;
  const double diameter = grain_diameter(specimen);
  std::vector<Number> out = {
      {"grains_across", std::min(p.width, p.height) / diameter, "1",
       "smaller side of the specimen / mean grain diameter", ""},
      {"porosity", p.report.porosity, "1", "1 - area of all discs / area of the box, of the packing", ""},
      {"overlap", largest_overlap(specimen), "1",
       "largest overlap of two grains in contact at the start / radius of the smaller one", ""},
      {"rattlers", rattlers(specimen), "1",
       "share of grains that no contact can load: fewer than two contacts, or cut off from the largest part",
       ""}};
  if (specimen.bedding.empty()) return out;
  double spacing = std::numeric_limits<double>::infinity();
  for (const BeddingRecipe& set : specimen.bedding)
    // The narrowest set decides: its layers have fewest grains.
    if (set.has_planes()) spacing = std::min(spacing, set.spacing);
  // Dispersed joints alone have no spacing.
  if (std::isfinite(spacing))
    out.push_back({"grains_per_spacing", spacing / diameter, "1",
                   "spacing of the bedding / mean grain diameter, of several sets the smallest", ""});
  if (const double joints = fewest_joints(specimen); std::isfinite(joints))
    out.push_back({"joints", joints, "1",
                   "smooth joints of a bedding set at the start, of several sets the fewest", ""});
  return out;
}

}  // namespace phy::analysis
