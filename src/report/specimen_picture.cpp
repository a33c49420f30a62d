#include "report/specimen_picture.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/exact_math.hpp"
#include "records/test_description.hpp"
#include "report/palette.hpp"

namespace phy::report {
namespace {

constexpr double thinnest = 1.2;  // line of a crack [pixels]

/// Per disc the number of its colour in disc_colors.
std::vector<std::size_t> tones_of(const SpecimenRecord& t) {
  std::vector<std::size_t> tone(t.scene.discs.size(), 0);
  // Only planes at equal distances can be counted; of others the discs with a joint are seen.
  if (!t.bedding.empty() && !t.recipe.bedding.empty() && t.recipe.bedding[0].is_regular()) {
    const Vec2 normal = plane_normal(t.bedding[0].theta);
    const BeddingRecipe& set = t.recipe.bedding[0];
    for (std::size_t i = 0; i < tone.size(); ++i) {
      const Disc& d = t.scene.discs[i];
      const double along = dot(normal, {d.x - 0.5 * t.scene.width, d.y - 0.5 * t.scene.height});
      const double planes = (along - set.offset) / set.spacing;
      const double distance = std::abs(planes - std::floor(planes + 0.5)) * set.spacing;
      // Layers with a matrix of their own, else the rock between one plane and the next in turn.
      const bool other = set.layer_thickness > 0.0 ? distance <= 0.5 * set.layer_thickness
                                                   : std::fmod(std::floor(planes), 2.0) != 0.0;
      tone[i] = other ? 1 : 0;
    }
  }
  for (const SceneLink& l : t.scene.links)
    // After the layers: joints are seen on top.
    if (l.kind == ContactKind::joint) tone[l.a] = tone[l.b] = 2;
  return tone;
}

Vec2 vector_of(const std::array<float, 2>& u) {
  return {static_cast<double>(u[0]), static_cast<double>(u[1])};
}

/// `sign` makes the recorded strains grow.
std::vector<Vec2> displacements(const Scene& scene, double strain, double sign) {
  const auto& frames = scene.frames;
  std::size_t after = 0;
  while (after + 1 < frames.size() && sign * frames[after].axial_strain < strain) ++after;
  // Frames are few; between them discs move on straight lines.
  const Frame &a = frames[after == 0 ? 0 : after - 1], &b = frames[after];
  const double start = sign * a.axial_strain, span = sign * b.axial_strain - start;
  // One frame alone, or two of one strain, shows itself.
  const double part = span > 0.0 ? std::clamp((strain - start) / span, 0.0, 1.0) : 1.0;
  std::vector<Vec2> u;
  for (std::size_t i = 0; i < scene.discs.size(); ++i)
    u.push_back((1.0 - part) * vector_of(a.u[i]) + part * vector_of(b.u[i]));
  return u;
}

/// Each channel times `part`.
Color darker(Color c, double part) {
  Color out = 0;
  for (const unsigned shift : {16U, 8U, 0U})
    out |= static_cast<Color>(std::lround(part * static_cast<double>(c >> shift & 255U))) << shift;
  return out;
}

void draw_disc(Canvas& canvas, Vec2 at, double r, Color color) {
  // A rim within four pixels would be blurred into a darker disc.
  if (r < 4.0) return canvas.disc(at.x, at.y, r, color);
  canvas.disc(at.x, at.y, r, darker(color, 0.76));
  canvas.disc(at.x, at.y, 0.88 * r, color);
}

}  // namespace

double last_strain(const SpecimenRecord& test) {
  const auto& rows = test.result.history.rows;
  return rows.empty() ? 0.0 : test.recipe.test.kind->curve.strain_of(rows.back());
}

void draw_specimen(Canvas& canvas, const SpecimenRecord& test, const SpecimenView& view, double strain) {
  const Scene& scene = test.scene;
  const double sign = test.recipe.test.kind->curve.sign;
  const std::vector<std::size_t> tone = tones_of(test);
  std::vector<Vec2> at = displacements(scene, strain, sign);
  for (std::size_t i = 0; i < at.size(); ++i) {
    const Disc& d = scene.discs[i];
    at[i] = {view.left + view.scale * (d.x + view.magnify * at[i].x),
             view.top + view.scale * (scene.height - d.y - view.magnify * at[i].y)};
    draw_disc(canvas, at[i], view.scale * d.r, disc_colors[tone[i]]);
  }
  for (const CrackEvent& c : test.result.cracks) {
    if (!view.cracks || sign * c.strain > strain) break;  // ordered by step
    // Files may be damaged or edited, and a picture must not read beyond its discs.
    if (c.a >= at.size() || c.b >= at.size()) continue;
    // The contact lies where the discs touch, not midway between their centres.
    const double part = scene.discs[c.a].r / (scene.discs[c.a].r + scene.discs[c.b].r);
    const Vec2 middle = (1.0 - part) * at[c.a] + part * at[c.b];
    // Never thinner than can be seen: cracks matter more than their true size.
    const double half = std::max(thinnest, 0.6 * view.scale * c.size);
    const Vec2 along{half * c.normal.y, half * c.normal.x};  // across the normal; y of pixels points down
    canvas.line(middle + along, middle - along, std::max(thinnest, 0.25 * view.scale * c.size),
                crack_colors[crack_kind(c)]);
  }
}

}  // namespace phy::report
