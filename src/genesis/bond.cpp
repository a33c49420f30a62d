#include "genesis/bond.hpp"

#include <algorithm>
#include <cmath>

#include "base/check.hpp"
#include "genesis/near_pairs.hpp"

namespace phy::genesis {

double draw_strength(double mean, double sd, std::int64_t seed, Stream stream, std::uint32_t a,
                     std::uint32_t b) {
  if (sd == 0.0) return mean;
  // At a positive mean at least half of the draws are accepted: 200 refusals in a row do not happen.
  for (std::uint32_t attempt = 0; attempt < 200; ++attempt) {
    const auto key = static_cast<std::uint32_t>(seed);
    const double z = normal(key, stream, std::min(a, b), std::max(a, b), attempt);
    const double strength = mean + sd * z;
    if (std::abs(z) <= strength_cut && strength > 0.0) return strength;
  }
  PHY_CHECK(false, "a bond strength needs a positive mean");
}

std::vector<Contact> bond(const Packing& packing, const MatrixRecipe& matrix) {
  double r_max = 0.0;
  for (const Disc& d : packing.discs) r_max = std::max(r_max, d.r);
  const std::int64_t seed = matrix.bond_seed;
  std::vector<Contact> contacts;
  for (const Pair& p : near_pairs(packing.discs, std::max(matrix.bond_gap, 0.0) * r_max)) {
    const Disc& a = packing.discs[p.a];
    const Disc& b = packing.discs[p.b];
    if (gap(a, b) > matrix.bond_gap * 0.5 * (a.r + b.r)) continue;
    Contact c;
    c.a = p.a;
    c.b = p.b;
    c.sigma_c = draw_strength(matrix.sigma_c, matrix.sigma_c_sd, seed, Stream::bond_tension, p.a, p.b);
    c.tau_c = draw_strength(matrix.tau_c, matrix.tau_c_sd, seed, Stream::bond_shear, p.a, p.b);
    contacts.push_back(c);
  }
  return contacts;
}

}  // namespace phy::genesis
