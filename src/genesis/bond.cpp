#include "genesis/bond.hpp"

#include <algorithm>
#include <cmath>

#include "base/check.hpp"
#include "base/exact_math.hpp"
#include "contact/direction.hpp"
#include "genesis/near_pairs.hpp"

namespace phy::genesis {

double draw_strength(double mean, double sd, const StrengthKey& of) {
  if (sd == 0.0) return mean;
  // At a positive mean at least half of the draws are accepted: 200 refusals in a row do not happen.
  for (std::uint32_t attempt = 0; attempt < 200; ++attempt) {
    const auto key = static_cast<std::uint32_t>(of.seed);
    const double z = normal(key, of.stream, std::min(of.a, of.b), std::max(of.a, of.b), attempt);
    const double strength = mean + sd * z;
    if (std::abs(z) <= strength_cut && strength > 0.0) return strength;
  }
  PHY_CHECK(false, "a bond strength needs a positive mean");
}

namespace {

/// cos 2a of a contact between two discs, a being the angle between its normal and that of the foliation.
double cos_2a(const Disc& a, const Disc& b, Vec2 foliation_normal) {
  const Vec2 d{b.x - a.x, b.y - a.y};
  const double along = dot(d, foliation_normal);
  return 2.0 * along * along / dot(d, d) - 1.0;
}

/// The strengths of a contact that is bonded.
void cement(Contact& c, const MatrixRecipe& m) {
  c.kind = ContactKind::bonded;
  c.sigma_c = draw_strength(m.sigma_c, m.sigma_c_sd, {m.bond_seed, Stream::bond_tension, c.a, c.b}) *
              contact::direction_factor(m.tension_ratio, c.cos_2a);
  c.tau_c = draw_strength(m.tau_c, m.tau_c_sd, {m.bond_seed, Stream::bond_shear, c.a, c.b}) *
            contact::direction_factor(m.cohesion_ratio, c.cos_2a) *
            contact::oblique_factor(m.cohesion_oblique, c.cos_2a);
}

bool left_unbonded(const MatrixRecipe& m, std::uint32_t a, std::uint32_t b) {
  return m.unbonded_fraction > 0.0 &&
         uniform(static_cast<std::uint32_t>(m.bond_seed), Stream::unbonded, a, b) < m.unbonded_fraction;
}

/// Of those that are not left unbonded: `gapped_fraction` of all.
bool gapped(const MatrixRecipe& m, std::uint32_t a, std::uint32_t b) {
  return m.gapped_fraction > 0.0 && uniform(static_cast<std::uint32_t>(m.bond_seed), Stream::gapped, a, b) *
                                            (1.0 - m.unbonded_fraction) <
                                        m.gapped_fraction;
}

}  // namespace

std::vector<Contact> bond(const Packing& packing, const MatrixRecipe& matrix) {
  double r_max = 0.0;
  for (const Disc& d : packing.discs) r_max = std::max(r_max, d.r);
  const Vec2 foliation_normal = plane_normal(matrix.foliation);
  std::vector<Contact> contacts;
  for (const Pair& p : near_pairs(packing.discs, matrix.bond_reach(r_max))) {
    const Disc& a = packing.discs[p.a];
    const Disc& b = packing.discs[p.b];
    if (gap(a, b) > matrix.bond_reach(0.5 * (a.r + b.r))) continue;
    Contact c;
    c.a = p.a;
    c.b = p.b;
    // A flat joint without a bond is an interface all the same.
    c.kind = matrix.model == MatrixModel::flat_joint ? ContactKind::bonded : ContactKind::touching;
    const bool left = left_unbonded(matrix, p.a, p.b), open = !left && gapped(matrix, p.a, p.b);
    if (open) c.gap = matrix.initial_gap;
    if (!left && !open) {
      if (matrix.directional()) c.cos_2a = cos_2a(a, b, foliation_normal);
      cement(c, matrix);
    }
    contacts.push_back(c);
  }
  return contacts;
}

}  // namespace phy::genesis
