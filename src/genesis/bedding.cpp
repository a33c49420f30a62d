#include "genesis/bedding.hpp"

#include <algorithm>
#include <cmath>

#include "base/check.hpp"
#include "base/exact_math.hpp"
#include "base/rng.hpp"
#include "genesis/bond.hpp"

namespace phy::genesis {
namespace {

constexpr double parallel = 1e-12;  // of the radii: difference of heights that is rounding

/// Length of the line {height = h} inside the rectangle |x| <= w, |y| <= v around the centre.
double chord(Vec2 n, double h, double w, double v) {
  const Vec2 along{n.y, -n.x};
  double first = -2.0 * (w + v), last = 2.0 * (w + v);
  const auto cut = [&](double start, double slope, double limit) {
    // Along a side the line is inside it everywhere, or nowhere.
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
  // Two centres on one height have no side; one of them has to be taken, on every machine the same.
  return rise < -parallel * (a.r + b.r) ? std::int8_t{-1} : std::int8_t{1};
}

/// The contact point x_a + n (r_a + gap/2).
Vec2 contact_point(const Disc& a, const Disc& b) {
  const double dx = b.x - a.x, dy = b.y - a.y;
  const double l = std::sqrt(dx * dx + dy * dy);
  // In the middle of gap or overlap, whatever the radii.
  const double s = l > 0.0 ? 0.5 * (l + a.r - b.r) / l : 0.5;
  return {a.x + s * dx, a.y + s * dy};
}

/// Counters of draws are unsigned; planes and patches are numbered from the centre both ways.
std::uint32_t counter(double number) {
  return static_cast<std::uint32_t>(static_cast<std::int64_t>(number) + 0x80000000LL);
}

/// A standard normal number of a plane, drawn again beyond strength_cut.
double deviate(std::int64_t seed, Stream stream, std::uint8_t set, std::int32_t plane) {
  for (std::uint32_t attempt = 0;; ++attempt) {
    const double z = normal(static_cast<std::uint32_t>(seed), stream, set, counter(plane), attempt);
    if (std::abs(z) <= strength_cut) return z;
  }
}

/// One set as laid in one specimen: which contacts are its joints.
class Layer {
 public:
  Layer(const Specimen& specimen, std::uint8_t number)
      : recipe_(specimen.bedding_of(number)),
        seed_(static_cast<std::uint32_t>(specimen.matrix.bond_seed)),
        set_(specimen.set_of(number)),
        first_plane_(specimen.laid_sets.empty() ? 0 : specimen.laid_sets[number].plane),
        planes_(recipe_, specimen.packing->width, specimen.packing->height),
        centre_{0.5 * specimen.packing->width, 0.5 * specimen.packing->height},
        least_cos_(sin_cos_degrees(recipe_.orientation_range).cos) {}

  const PlaneSet& planes() const { return planes_; }

  bool takes(const Contact& c, const Disc& a, const Disc& b, bool crosses) const {
    if (!recipe_.has_planes()) {
      const Vec2 branch{b.x - a.x, b.y - a.y};
      // No planes: a contact is a joint by its direction alone.
      return std::abs(dot(branch, planes_.normal())) >= least_cos_ * norm(branch);
    }
    const Vec2 point = contact_point(a, b);
    const double height = planes_.height_of(point.x, point.y);
    const bool qualifies =
        recipe_.rule == BeddingRule::crossing
            ? crosses
            : planes_.distance(height) <= 0.5 * recipe_.zone_thickness || (crosses && !recipe_.bridges);
    return qualifies && (recipe_.persistence >= 1.0 || is_jointed(c, point, height));
  }

 private:
  const BeddingRecipe& recipe_;
  std::uint32_t seed_;
  std::uint8_t set_;
  std::int32_t first_plane_;
  PlaneSet planes_;
  Vec2 centre_;
  double least_cos_;

  /// Is its patch of the nearest plane jointed?
  bool is_jointed(const Contact& c, Vec2 point, double height) const {
    if (recipe_.patch_length == 0.0)
      // Patches of no length: each contact by itself.
      return uniform(seed_, Stream::bedding_contact, c.a, c.b, set_) < recipe_.persistence;
    const std::uint32_t plane = counter(first_plane_ + planes_.nearest(height));
    const Vec2 n = planes_.normal();
    const double along = dot({n.y, -n.x}, point - centre_) / recipe_.patch_length;
    // Each plane begins its patches elsewhere, or bridges would line up across the planes.
    const double patch = std::floor(along + uniform(seed_, Stream::bedding_phase, set_, plane));
    return uniform(seed_, Stream::bedding_patch, set_, plane, counter(patch)) < recipe_.persistence;
  }
};

void lay_set(Specimen& specimen, std::uint8_t number) {
  const Packing& packing = *specimen.packing;
  const BeddingRecipe& recipe = specimen.bedding_of(number);
  const Layer layer(specimen, number);
  std::int32_t* label = &specimen.plane_label[number * packing.discs.size()];
  // Dispersed joints and layers without any keep the label 0: grains that meet later meet in the matrix.
  if (recipe.has_planes() && !recipe.unjointed())
    for (std::size_t i = 0; i < packing.discs.size(); ++i)
      label[i] = layer.planes().interval(layer.planes().height_of(packing.discs[i].x, packing.discs[i].y));
  for (Contact& c : specimen.contacts) {
    const Disc& a = packing.discs[c.a];
    const Disc& b = packing.discs[c.b];
    // Not those of an earlier set; a contact left without a bond may become a joint too.
    if (c.kind == ContactKind::joint || !layer.takes(c, a, b, label[c.a] != label[c.b])) continue;
    c.kind = ContactKind::joint;
    c.set = number;
    c.side = side_of(layer.planes(), a, b);
    c.sigma_n = draw_strength(recipe.sigma_n, recipe.sigma_n_sd,
                              {specimen.matrix.bond_seed, Stream::joint_tension, c.a, c.b}) /
                recipe.sigma_n;
  }
}

/// Bonds within the layers of a set get the layers' stiffness and strengths; the first layer has them.
void lay_layers(Specimen& specimen, std::uint8_t number, std::vector<char>& in_layer) {
  const Packing& packing = *specimen.packing;
  const BeddingRecipe& recipe = specimen.bedding_of(number);
  if (recipe.layer_thickness == 0.0) return;
  const PlaneSet planes(recipe, packing.width, packing.height);
  for (std::size_t i = 0; i < specimen.contacts.size(); ++i) {
    Contact& c = specimen.contacts[i];
    if (c.kind != ContactKind::bonded || in_layer[i] != 0) continue;
    const Vec2 point = contact_point(packing.discs[c.a], packing.discs[c.b]);
    if (planes.distance(planes.height_of(point.x, point.y)) > 0.5 * recipe.layer_thickness) continue;
    in_layer[i] = 1;
    // Stiffness as a factor beside the direction's; strengths at once, for they are drawn already.
    c.layer = recipe.layer_stiffness;
    c.sigma_c *= recipe.layer_strength, c.tau_c *= recipe.layer_strength;
  }
}

/// Of one set of the recipe, all of its planes together.
BeddingReport report_on(const Specimen& specimen, std::uint8_t set) {
  const Packing& packing = *specimen.packing;
  const BeddingRecipe& recipe = specimen.bedding[set];
  const std::size_t n = packing.discs.size();
  std::vector<const std::int32_t*> labels;
  double length = 0.0, area = 0.0;
  for (std::size_t k = 0; k < specimen.n_laid(); ++k) {
    if (specimen.set_of(static_cast<std::uint8_t>(k)) != set) continue;
    labels.push_back(&specimen.plane_label[k * n]);
    length += PlaneSet(specimen.bedding_of(k), packing.width, packing.height).total_length();
  }
  long n_joints = 0, n_same_side = 0, n_crossing = 0, n_bridges = 0;
  for (const Contact& c : specimen.contacts) {
    // A grain on either side of any of the set's planes.
    const bool crosses = std::any_of(labels.begin(), labels.end(), [&](auto* l) { return l[c.a] != l[c.b]; });
    if (crosses) ++n_crossing;
    // Of any set: a contact that another set has made a joint is no bridge.
    if (crosses && c.kind != ContactKind::joint) ++n_bridges;
    if (c.kind != ContactKind::joint || specimen.set_of(c.set) != set) continue;
    ++n_joints;
    if (!crosses) ++n_same_side;
    area += 2.0 * recipe.radius_multiplier * std::min(packing.discs[c.a].r, packing.discs[c.b].r);
  }
  const auto fraction = [](double part, double all) { return all > 0.0 ? part / all : 0.0; };
  BeddingReport r;
  r.dispersed = !recipe.has_planes();
  if (r.dispersed) {
    r.joint_fraction = fraction(static_cast<double>(n_joints), static_cast<double>(specimen.contacts.size()));
    return r;
  }
  r.overlap_ratio = fraction(area, length);
  r.bridge_fraction = fraction(static_cast<double>(n_bridges), static_cast<double>(n_crossing));
  r.non_crossing_fraction = fraction(static_cast<double>(n_same_side), static_cast<double>(n_joints));
  return r;
}

/// Every plane of a set within `radius` of the centre, as a set of its own whose other planes lie far
/// outside.
void lay_apart(const BeddingRecipe& whole, std::uint8_t set, double radius, std::int64_t seed,
               std::vector<LaidSet>& out) {
  // The most tilted plane comes nearer to the centre than the point about which it turns.
  const double reach = radius / sin_cos_degrees(strength_cut * whole.theta_sd).cos;
  const auto add = [&](std::int32_t plane, double height) {
    if (std::abs(height) > reach) return;
    LaidSet one{whole, set, plane};
    const double tilt = whole.theta_sd * deviate(seed, Stream::bedding_theta, set, plane);
    one.recipe.theta += tilt;
    one.recipe.offset = height * sin_cos_degrees(tilt).cos;  // it turns about its point beside the centre
    one.recipe.spacing = 8.0 * reach;
    out.push_back(one);
  };
  // Of planes k-1 and k.
  const auto distance = [&](std::int32_t k) {
    return whole.spacing * (1.0 + whole.spacing_sd * deviate(seed, Stream::bedding_spacing, set, k));
  };
  add(0, whole.offset);
  double height = whole.offset;
  // Outwards from the middle, so that a wider specimen has the same planes within.
  for (std::int32_t k = 1; (height += distance(k)) <= reach; ++k) add(k, height);
  height = whole.offset;
  for (std::int32_t k = 0; (height -= distance(k)) >= -reach; --k) add(k - 1, height);
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

std::int32_t PlaneSet::nearest(double height) const {
  return static_cast<std::int32_t>(std::floor((height - offset_) / spacing_ + 0.5));
}

double PlaneSet::distance(double height) const {
  const double t = (height - offset_) / spacing_;
  return std::abs(t - std::floor(t + 0.5)) * spacing_;
}

double PlaneSet::total_length() const {
  const double reach = centre_.x * std::abs(normal_.x) + centre_.y * std::abs(normal_.y);
  double length = 0.0;
  // One more to either side: their chords are zero where they miss the box.
  for (std::int32_t k = interval(-reach); k <= interval(reach) + 1; ++k)
    length += chord(normal_, offset_ + k * spacing_, centre_.x, centre_.y);
  return length;
}

std::vector<LaidSet> laid_apart(const std::vector<BeddingRecipe>& bedding, double width, double height,
                                std::int64_t bond_seed) {
  std::vector<LaidSet> all;
  if (std::none_of(bedding.begin(), bedding.end(), [](const BeddingRecipe& b) { return b.scatters(); }))
    return all;
  for (std::size_t set = 0; set < bedding.size(); ++set) {
    const auto number = static_cast<std::uint8_t>(set);
    if (bedding[set].scatters())
      lay_apart(bedding[set], number, 0.5 * norm(Vec2{width, height}) + bedding[set].spacing, bond_seed, all);
    else
      all.push_back({bedding[set], number, 0});
  }
  return all;
}

void lay_bedding(Specimen& specimen) {
  const Packing& packing = *specimen.packing;
  specimen.laid_sets = laid_apart(specimen.bedding, packing.width, packing.height, specimen.matrix.bond_seed);
  // The largest number is the engine's for none.
  PHY_CHECK(specimen.n_laid() < 255, "a contact numbers its set in one byte");
  specimen.plane_label.assign(specimen.n_laid() * packing.discs.size(), 0);
  specimen.bedding_report.clear();
  const auto n_laid = static_cast<std::uint8_t>(specimen.n_laid());
  for (std::uint8_t number = 0; number < n_laid; ++number) lay_set(specimen, number);
  std::vector<char> in_layer(specimen.contacts.size(), 0);
  for (std::uint8_t number = 0; number < n_laid; ++number) lay_layers(specimen, number, in_layer);
  const auto n_sets = static_cast<std::uint8_t>(specimen.bedding.size());
  for (std::uint8_t set = 0; set < n_sets; ++set) specimen.bedding_report.push_back(report_on(specimen, set));
}

}  // namespace phy::genesis
