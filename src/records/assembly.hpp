// Small specimens made by hand for verification.
#pragma once
#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "base/exact_math.hpp"
#include "records/specimen.hpp"

namespace phy {

/// Bonds that never break; the linear part is 1e-9 of the bond, so that tension and compression are alike.
inline MatrixRecipe soft_contact() {
  MatrixRecipe m;
  m.E_c = 38.0;
  m.E_b = 38e9;
  m.sigma_c = m.tau_c = 1e30;
  m.sigma_c_sd = m.tau_c_sd = 0.0;
  return m;
}

/// A specimen of these discs, without contacts.
inline Specimen assembly(std::vector<Disc> discs, const MatrixRecipe& matrix) {
  auto packing = std::make_shared<Packing>();
  packing->hash = "by hand";
  for (const Disc& d : discs) {
    packing->width = std::max(packing->width, d.x + d.r);
    packing->height = std::max(packing->height, d.y + d.r);
  }
  packing->discs = std::move(discs);
  Specimen s;
  s.packing = std::move(packing);
  s.matrix = matrix;
  return s;
}

/// Rows of equal discs in a hexagonal lattice, rows along x, lowest row on y = 0.
inline std::vector<Disc> hexagonal(int n_x, int n_y, double r) {
  std::vector<Disc> discs;
  for (int j = 0; j < n_y; ++j)
    for (int i = 0; i < n_x; ++i)
      discs.push_back({r * (1.0 + 2.0 * i + (j % 2)), r * (1.0 + std::sqrt(3.0) * j), r});
  return discs;
}

/// Bonds all pairs that touch (within 1e-6 of the radius) with the mean strengths.
inline void bond_touching(Specimen& s) {
  const auto& d = s.packing->discs;
  for (std::uint32_t a = 0; a < d.size(); ++a) {
    for (std::uint32_t b = a + 1; b < d.size(); ++b) {
      if (norm(Vec2{d[b].x - d[a].x, d[b].y - d[a].y}) > (d[a].r + d[b].r) * (1.0 + 1e-6)) continue;
      Contact c;
      c.a = a, c.b = b, c.sigma_c = s.matrix.sigma_c, c.tau_c = s.matrix.tau_c;
      s.contacts.push_back(c);
    }
  }
}

/// Turns bonds that cross a plane of bedding[0] into joints (crossing rule, planes through the origin).
inline void joint_crossing(Specimen& s) {
  const BeddingRecipe& set = s.bedding.front();
  const Vec2 n = plane_normal(set.theta);
  const auto& d = s.packing->discs;
  for (const Disc& disc : d)
    s.plane_label.push_back(
        static_cast<std::int32_t>(std::floor((n.x * disc.x + n.y * disc.y) / set.spacing)));
  for (Contact& c : s.contacts) {
    const std::int32_t a = s.plane_label[c.a], b = s.plane_label[c.b];
    if (a == b) continue;
    c.kind = ContactKind::joint;
    c.side = b > a ? 1 : -1;
  }
}

}  // namespace phy
