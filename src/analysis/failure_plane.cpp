#include "analysis/failure_plane.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "base/stats.hpp"

namespace phy::analysis {
namespace {

constexpr double wide = 3.0;  // of the wider band, over the narrower one
constexpr int directions = 180, passes = 3;
constexpr std::size_t tenths = 10, fewest_cracks = 20;
// Evenly spread clouds of 20 to 300 cracks pass both in less than one case of a hundred
// (failure_plane.test.cpp): few cracks line up by chance, and many tell the shape of their cloud.
constexpr double least_excess = 1.25, least_score = 6.0;

double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }
/// To -90 < angle <= 90.
double folded(double angle) {
  const double turned = std::remainder(angle, 180.0);
  return turned <= -90.0 ? turned + 180.0 : turned;
}

/// A crack along a direction and across it.
struct Place {
  double along, across;
};
std::vector<Place> places_of(std::span<const Vec2> cracks, double angle) {
  const double c = std::cos(radians(angle)), s = std::sin(radians(angle));
  std::vector<Place> places;
  for (const Vec2& p : cracks) places.push_back({c * p.x + s * p.y, c * p.y - s * p.x});
  std::ranges::sort(places, {}, &Place::across);
  return places;
}

double pairs_within(const std::vector<Place>& places, double width) {
  double n = 0.0;
  for (std::size_t i = 0, end = 0; i < places.size(); ++i) {
    while (end < places.size() && places[end].across - places[i].across <= width) ++end;
    n += static_cast<double>(end - i - 1);
  }
  return n;
}

/// How far pairs in one line are more than a third of those in the wider band: in standard deviations of as
/// many that fall by chance, and as a factor.
struct Score {
  double chance = 0.0, excess = 0.0, angle = 0.0;
};
Score score_of(std::span<const Vec2> cracks, double grain, double angle) {
  const std::vector<Place> places = places_of(cracks, angle);
  const double near = pairs_within(places, grain), all = std::max(1.0, pairs_within(places, wide * grain));
  // In an even cloud the number of pairs is proportional to the width of the band.
  const double share = 1.0 / wide;
  return {(near - share * all) / std::sqrt(all * share * (1.0 - share)), near / (share * all), angle};
}

/// The principal axis of the differences of all pairs in one line: sums over windows of the sorted cracks.
double refined(std::span<const Vec2> cracks, double grain, double angle) {
  struct Moments {
    double n = 0.0, a = 0.0, c = 0.0, aa = 0.0, ac = 0.0, cc = 0.0;
    void add(const Place& p, double sign) {
      n += sign, a += sign * p.along, c += sign * p.across;
      aa += sign * p.along * p.along, ac += sign * p.along * p.across, cc += sign * p.across * p.across;
    }
  };
  for (int pass = 0; pass < passes; ++pass) {
    const std::vector<Place> places = places_of(cracks, angle);
    Moments window;
    double aa = 0.0, ac = 0.0, cc = 0.0;
    std::size_t end = 0;
    for (const Place& p : places) {
      while (end < places.size() && places[end].across - p.across <= grain) window.add(places[end++], 1.0);
      aa += window.aa - 2.0 * p.along * window.a + window.n * p.along * p.along;
      cc += window.cc - 2.0 * p.across * window.c + window.n * p.across * p.across;
      ac += window.ac - p.along * window.c - p.across * window.a + window.n * p.along * p.across;
      window.add(p, -1.0);
    }
    angle += 0.5 * std::atan2(2.0 * ac, aa - cc) * 180.0 / std::numbers::pi;
  }
  return angle;
}

/// Standard error of the angle, each tenth of the cracks left out in turn.
double jackknife(const std::vector<Vec2>& cracks, double grain, double angle) {
  double squares = 0.0;
  for (std::size_t out = 0; out < tenths; ++out) {
    std::vector<Vec2> kept;
    // Cracks come in the order of time: a tenth in one piece would take a whole event away.
    for (std::size_t i = 0; i < cracks.size(); ++i)
      if (i % tenths != out) kept.push_back(cracks[i]);
    squares += std::pow(folded(refined(kept, grain, angle) - angle), 2);
  }
  return std::sqrt(squares * (tenths - 1.0) / tenths);
}

}  // namespace

FailurePlane failure_plane(std::span<const CrackEvent> cracks, double grain) {
  if (cracks.size() < fewest_cracks || !(grain > 0.0)) return {};
  Vec2 middle;
  for (const CrackEvent& c : cracks) middle = middle + c.position;
  middle = (1.0 / static_cast<double>(cracks.size())) * middle;  // sums of squares stay exact
  std::vector<Vec2> at;
  for (const CrackEvent& c : cracks) at.push_back(c.position - middle);
  Score best;
  for (int i = 0; i < directions; ++i)
    if (const Score s = score_of(at, grain, 180.0 * i / directions); s.chance > best.chance) best = s;
  FailurePlane plane;
  plane.excess = best.excess;
  if (best.chance < least_score || best.excess < least_excess) return plane;
  plane.angle = refined(at, grain, best.angle);
  plane.error = jackknife(at, grain, plane.angle);
  plane.angle = folded(plane.angle);
  return plane;
}

std::vector<Number> failure_numbers(std::span<const CrackEvent> cracks, double grain, bool has_planes) {
  const auto along = std::ranges::count(cracks, CrackPlace::bedding, &CrackEvent::place);
  const FailurePlane plane = failure_plane(cracks, grain);
  const std::string none = cracks.size() < fewest_cracks ? fmt::format("fewer than {} cracks", fewest_cracks)
                           : std::isfinite(plane.angle)  ? ""
                                                         : "the cracks do not line up";
  return {
      {"bedding_share",
       has_planes && !cracks.empty() ? static_cast<double>(along) / static_cast<double>(cracks.size()) : nan,
       "1", "share of all cracks that lie along bedding, in the whole test",
       !has_planes      ? "no bedding planes"
       : cracks.empty() ? "no cracks"
                        : ""},
      {"failure_angle", plane.angle, "deg",
       "direction in which cracks line up, from the horizontal, anticlockwise like the bedding", none},
      {"failure_angle_error", plane.error, "deg",
       "standard error of failure_angle, cracks left out by tenths", none},
      {"failure_excess", plane.excess, "1",
       "pairs of cracks within one grain diameter across failure_angle, over a third of those within "
       "three",
       cracks.size() < fewest_cracks ? none : ""}};
}

MeanDirection mean_direction(std::span<const double> angles) {
  // A plane at 179 degrees is a neighbour of one at 1: doubled angles have no such seam.
  double c = 0.0, s = 0.0;
  for (const double a : angles) c += std::cos(radians(2.0 * a)), s += std::sin(radians(2.0 * a));
  if (angles.empty()) return {};
  MeanDirection mean;
  mean.angle = folded(0.5 * std::atan2(s, c) * 180.0 / std::numbers::pi);
  std::vector<double> deviations;
  for (const double a : angles) deviations.push_back(folded(a - mean.angle));
  mean.sd = summarise(deviations).sd;
  return mean;
}

}  // namespace phy::analysis
