// Finds the acoustic events of a test while it runs. After each block of cycles it gets the cracks of the
// block and the contact forces. The force that an event changes is the one at the start of the block in which
// its first crack formed; it is compared with that at the end of each block while the event lasts, and the
// largest moment counts (Hazzard & Young 2002). So an event is seen at an age between the window's duration
// and that plus one block.
#pragma once
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "events/clusters.hpp"
#include "events/forces.hpp"
#include "records/acoustic_event.hpp"

namespace phy::events {

class Recorder {
 public:
  /// `thickness` [m]: what the magnitudes are of. `start`: forces where recording begins.
  Recorder(const Window& window, double thickness, Forces start);
  /// At the time of the block's end [s]. Cracks are of this block, in their order in time.
  void after_block(double time, std::span<const CrackEvent> cracks, Forces forces);
  /// All events by the time of their first crack; nothing is recorded afterwards.
  std::vector<AcousticEvent> take();

 private:
  using Moment = std::shared_ptr<const Forces>;
  /// What the cluster that a crack begins has come to.
  struct Begun {
    Moment before;        // forces before its block
    MomentTensor tensor;  // the largest so far
  };
  AcousticEvent event_of(std::span<const std::size_t> members) const;
  void sample(std::span<const std::size_t> members);

  Window window_;
  double thickness_;
  Moment forces_;
  std::vector<CrackEvent> recent_;  // of events that may still grow, and
  std::vector<Begun> begun_;        // beside each of them what it would begin
  std::vector<AcousticEvent> events_;
};

}  // namespace phy::events
