// The neighbour list: which pairs of grains the force loop looks at, lane by lane.
//
// A lane's list holds the pairs that may touch before it is renewed: within the skin, and as much farther as
// a grain may go in the next block that is too fast for half the skin, or that a jacket drives. A list is
// renewed before anything outside it can touch: when twice the largest motion since it was made, plus what
// the fastest grain can do in the next block, exceeds the skin. A grain at rest that is hit within the block
// may go farther all the same. What it then meets unseen is found at the end of the block (missed), and once
// something has broken the block is run again with a list that reaches as far as the grain went: when a list
// is renewed, neighbours in the lanes have a say in (docs/decisions/0015 has what is left).
#pragma once
#include <algorithm>
#include <optional>
#include <vector>

#include "engine/grain_memory.hpp"

namespace phy::engine::group {

constexpr double meeting_gap = 0.02;  ///< a pair meets below this gap, of the smallest radius

template <class T>
class NeighbourList {
 public:
  explicit NeighbourList(const GrainMemory<T>& grains);

  /// Per lane: what the farthest grain has moved since the lane's last search [m], and the largest speed
  /// [m/s].
  struct Farthest {
    std::vector<double> moved, speed;
  };
  Farthest farthest() const;

  /// The lane's list has to be made anew.
  void forget(std::size_t lane) { lanes_[lane].searched = false; }
  void clear(std::size_t lane) { lanes_[lane] = {}; }
  bool searched(std::size_t lane) const { return lanes_[lane].searched; }
  /// The lane's list may end soon (blocks of `block` seconds): worth renewing together with the others.
  bool worn(std::size_t lane, const Farthest& most, double block) const;
  /// Grains may meet outside the list in the next block, or a body, moving by `bodies` [m], meet one.
  bool outlived(std::size_t lane, const Farthest& most, double block, double bodies) const;
  /// Makes a lane's list. `push`: per sorted grain, how far a jacket drives it in a block [m]; may be empty.
  void search(std::size_t lane, double block, std::vector<double>&& push);
  /// Until accept() the lane's lists reach round each sorted grain as far as it went [m] in any run of the
  /// block.
  void expect(std::size_t lane, const std::vector<double>& way);
  /// The block will not be run again.
  void accept() {
    for (Lane& lane : lanes_) lane.way.clear();
  }
  /// A sorted grain has gone farther since the search than the list allows for, or than any list can.
  bool beyond_range(std::size_t lane, std::size_t grain) const {
    return way(lane, grain) > range(lane, grain);
  }
  bool too_far(std::size_t lane, std::size_t grain) const;
  /// Adds a pair whatever its gap.
  void add(std::size_t lane, PairKey pair) { lanes_[lane].near.push_back(pair); }
  const std::vector<PairKey>& near(std::size_t lane) const { return lanes_[lane].near; }

  /// How far a sorted grain may go since the search, as the list allows for [m].
  double range(std::size_t lane, std::size_t grain) const { return lanes_[lane].range[grain]; }
  /// The jacket's push that the list allows for [m].
  double push(std::size_t lane, std::size_t grain) const {
    return lanes_[lane].push.empty() ? 0.0 : lanes_[lane].push[grain];
  }
  /// The farthest that any list allows a slow grain to go [m].
  double usual_range() const { return 0.5 * grains_->skin(); }

  /// Two grains that overlap though they are neither in this lane's list nor `known`: one of them has gone
  /// farther than the list reaches. The few fast grains are held against all.
  template <class Known>
  std::optional<PairKey> missed(std::size_t lane, const Known& known) const;

 private:
  struct Lane {
    std::vector<PairKey> near;  // of the last search
    std::vector<double> range, push;
    std::vector<double> way;  // in blocks that are run again; may be empty
    bool searched = false;
  };
  const GrainMemory<T>* grains_;
  std::vector<Lane> lanes_;
  std::vector<Vec2> searched_at_;  // per grain and lane: displacement at the last search

  double way(std::size_t lane, std::size_t g) const {
    return norm(grains_->displacement(g, lane) - searched_at_[g * grains_->lanes() + lane]);
  }
};

template <class T>
template <class Known>
std::optional<PairKey> NeighbourList<T>::missed(std::size_t l, const Known& known) const {
  const Lane& lane = lanes_[l];
  const GrainMemory<T>& of = *grains_;
  for (std::size_t g = 0; g < lane.range.size(); ++g) {
    const Vec2 way = of.displacement(g, l) - searched_at_[g * of.lanes() + l];
    if (dot(way, way) <= lane.range[g] * lane.range[g]) continue;
    for (std::size_t h = 0; h < of.size(); ++h) {
      const Vec2 d = of.place(h, l) - of.start(g) - of.displacement(g, l);
      const double touch = of.radius(g) + of.radius(h);
      const PairKey key =
          pair_key(static_cast<std::uint32_t>(std::min(g, h)), static_cast<std::uint32_t>(std::max(g, h)));
      const auto listed = [&] {
        return std::find(lane.near.begin(), lane.near.end(), key) != lane.near.end();
      };
      if (h != g && dot(d, d) < touch * touch && !listed() && !known(key)) return key;
    }
  }
  return std::nullopt;
}

/// A union of lists of pairs. The lanes agree on nearly all of them, so a pair is looked for among the few of
/// its upper grain; sorting all lists together takes ten times as long.
class PairUnion {
 public:
  explicit PairUnion(std::size_t n_grains) : of_(n_grains) {}
  void add(PairKey key);
  std::vector<PairKey> sorted();

 private:
  std::vector<std::vector<PairKey>> of_;
};

}  // namespace phy::engine::group
