#include "events/recorder.hpp"

#include <algorithm>
#include <utility>

#include "base/check.hpp"
#include "events/source.hpp"

namespace phy::events {

Recorder::Recorder(const Window& window, double thickness, Forces start)
    : window_(window), thickness_(thickness), forces_(std::make_shared<const Forces>(std::move(start))) {
  PHY_CHECK(thickness > 0.0 && window.reach > 0.0, "events have a thickness and a size");
}

AcousticEvent Recorder::event_of(std::span<const std::size_t> members) const {
  AcousticEvent e;
  const CrackEvent& first = recent_[members.front()];
  e.time = first.time, e.strain = first.strain;
  e.duration = recent_[members.back()].time - first.time;
  e.n_cracks = static_cast<std::int64_t>(members.size());
  e.thickness = thickness_;
  for (const std::size_t i : members) {
    e.position = e.position + (1.0 / static_cast<double>(members.size())) * recent_[i].position;
    e.energy += recent_[i].energy;
  }
  e.tensor = begun_[members.front()].tensor;
  describe(e);
  return e;
}

/// The first crack of a cluster keeps its largest tensor. Where two clusters grow together, that of the
/// earlier one goes on.
void Recorder::sample(std::span<const std::size_t> members) {
  std::vector<std::uint32_t> grains;
  for (const std::size_t i : members) grains.insert(grains.end(), {recent_[i].a, recent_[i].b});
  // Cracks of one event share grains, and each is one grain of the source.
  std::sort(grains.begin(), grains.end());
  grains.erase(std::unique(grains.begin(), grains.end()), grains.end());
  Begun& begun = begun_[members.front()];
  const MomentTensor now = moment_tensor(grains, event_of(members).position, *begun.before, *forces_);
  if (scalar_moment(now) > scalar_moment(begun.tensor)) begun.tensor = now;
}

void Recorder::after_block(double time, std::span<const CrackEvent> cracks, Forces forces) {
  // Whatever broke first in this block, the forces before it are those at the block's start.
  for (const CrackEvent& c : cracks) recent_.push_back(c), begun_.push_back({forces_, {}});
  forces_ = std::make_shared<const Forces>(std::move(forces));
  std::vector<bool> over(recent_.size());
  for (const std::vector<std::size_t>& members : clusters(recent_, window_)) {
    sample(members);
    // What breaks from now on is too late for it.
    if (time - recent_[members.back()].time < window_.duration) continue;
    events_.push_back(event_of(members));
    for (const std::size_t i : members) over[i] = true;
  }
  // The order in time stays: clusters begin with their first crack.
  std::size_t kept = 0;
  for (std::size_t i = 0; i < recent_.size(); ++i) {
    if (over[i]) continue;
    recent_[kept] = recent_[i];
    begun_[kept++] = std::move(begun_[i]);
  }
  recent_.resize(kept), begun_.resize(kept);
}

std::vector<AcousticEvent> Recorder::take() {
  // Young events have no later block to be read in: they count with what they have come to.
  for (const std::vector<std::size_t>& members : clusters(recent_, window_))
    events_.push_back(event_of(members));
  recent_.clear(), begun_.clear();
  std::stable_sort(events_.begin(), events_.end(),
                   [](const AcousticEvent& p, const AcousticEvent& q) { return p.time < q.time; });
  return std::move(events_);
}

}  // namespace phy::events
