#include "genesis/bedding.hpp"

#include <algorithm>
#include <cmath>

#include "base/check.hpp"
#include "base/exact_math.hpp"

namespace phy::genesis {
namespace {

constexpr double parallel = 1e-12;  // of the radii: difference of heights that is rounding

/// Length of the line {height = h} inside the rectangle |x| <= w, |y| <= v around the centre.
double chord(Vec2 n, double h, double w, double v) {
  const Vec2 along{n.y, -n.x};
  double first = -2.0 * (w + v), last = 2.0 * (w + v);
  const auto cut = [&](double start, double slope, double limit) {
    if (slope == 0.0) {
      if (std::abs(start) > limit) last = first;
      return;
    }
    const double s = (-limit - start) / slope, t = (limit - start) / slope;
    first = std::max(first, std::min(s, t));
    last = std::min(last, std::max(s, t));
  };
  cut(h * n.x, along.x, w);
  cut(h * n.y, along.y, v);
  return std::max(0.0, last - first);
}

std::int8_t side_of(const PlaneSet& planes, const Disc& a, const Disc& b) {
  const double rise = planes.height_of(b.x, b.y) - planes.height_of(a.x, a.y);
  return rise < -parallel * (a.r + b.r) ? std::int8_t{-1} : std::int8_t{1};
}

/// Height of the contact point x_a + n (r_a + gap/2).
double contact_height(const PlaneSet& planes, const Disc& a, const Disc& b) {
  const double dx = b.x - a.x, dy = b.y - a.y;
  const double l = std::sqrt(dx * dx + dy * dy);
  const double s = l > 0.0 ? 0.5 * (l + a.r - b.r) / l : 0.5;
  return planes.height_of(a.x + s * dx, a.y + s * dy);
}

void lay_set(Specimen& specimen, std::uint8_t set) {
  const Packing& packing = *specimen.packing;
  const BeddingRecipe& recipe = specimen.bedding[set];
  const PlaneSet planes(recipe, packing.width, packing.height);
  std::int32_t* label = &specimen.plane_label[set * packing.discs.size()];
  for (std::size_t i = 0; i < packing.discs.size(); ++i)
    label[i] = planes.interval(planes.height_of(packing.discs[i].x, packing.discs[i].y));
  for (Contact& c : specimen.contacts) {
    if (c.kind == ContactKind::joint) continue;  // of an earlier set
    const Disc& a = packing.discs[c.a];
    const Disc& b = packing.discs[c.b];
    const bool qualifies = recipe.rule == BeddingRule::crossing
                               ? label[c.a] != label[c.b]
                               : planes.distance(contact_height(planes, a, b)) <= 0.5 * recipe.zone_thickness;
    if (!qualifies) continue;
    c.kind = ContactKind::joint;
    c.set = set;
    c.side = side_of(planes, a, b);
  }
}

BeddingReport report_on(const Specimen& specimen, std::uint8_t set) {
  const Packing& packing = *specimen.packing;
  const BeddingRecipe& recipe = specimen.bedding[set];
  const std::int32_t* label = &specimen.plane_label[set * packing.discs.size()];
  double area = 0.0;
  long n_joints = 0, n_same_side = 0, n_crossing = 0, n_bridges = 0;
  for (const Contact& c : specimen.contacts) {
    const bool crosses = label[c.a] != label[c.b];
    if (crosses) ++n_crossing;
    if (crosses && c.kind != ContactKind::joint) ++n_bridges;
    if (c.kind != ContactKind::joint || c.set != set) continue;
    ++n_joints;
    if (!crosses) ++n_same_side;
    area += 2.0 * recipe.radius_multiplier * std::min(packing.discs[c.a].r, packing.discs[c.b].r);
  }
  const auto fraction = [](double part, double all) { return all > 0.0 ? part / all : 0.0; };
  BeddingReport r;
  r.overlap_ratio = fraction(area, PlaneSet(recipe, packing.width, packing.height).total_length());
  r.bridge_fraction = fraction(static_cast<double>(n_bridges), static_cast<double>(n_crossing));
  r.non_crossing_fraction = fraction(static_cast<double>(n_same_side), static_cast<double>(n_joints));
  return r;
}

}  // namespace

PlaneSet::PlaneSet(const BeddingRecipe& recipe, double width, double height)
    : centre_{0.5 * width, 0.5 * height}, offset_(recipe.offset), spacing_(recipe.spacing) {
  PHY_CHECK(recipe.spacing > 0.0, "planes need a positive spacing");
  normal_ = plane_normal(recipe.theta);
}

std::int32_t PlaneSet::interval(double height) const {
  return static_cast<std::int32_t>(std::floor((height - offset_) / spacing_));
}

double PlaneSet::distance(double height) const {
  const double t = (height - offset_) / spacing_;
  return std::abs(t - std::floor(t + 0.5)) * spacing_;
}

double PlaneSet::total_length() const {
  const double reach = centre_.x * std::abs(normal_.x) + centre_.y * std::abs(normal_.y);
  double length = 0.0;
  for (std::int32_t k = interval(-reach); k <= interval(reach) + 1; ++k)
    length += chord(normal_, offset_ + k * spacing_, centre_.x, centre_.y);
  return length;
}

void lay_bedding(Specimen& specimen) {
  PHY_CHECK(specimen.bedding.size() < 256, "a contact numbers its set in one byte");
  specimen.plane_label.assign(specimen.bedding.size() * specimen.packing->discs.size(), 0);
  specimen.bedding_report.clear();
  const auto n_sets = static_cast<std::uint8_t>(specimen.bedding.size());
  for (std::uint8_t set = 0; set < n_sets; ++set) lay_set(specimen, set);
  for (std::uint8_t set = 0; set < n_sets; ++set) specimen.bedding_report.push_back(report_on(specimen, set));
}

}  // namespace phy::genesis
