// Contacts of a specimen that has its group to itself, laid out for the loop over lanes of contacts
// (wide_loop.hpp): batches of W contacts of one row that share a model, and the set of a bedding.
//
// Between blocks the contacts live in ContactMemory, as everywhere else. Before a block their state is copied
// into the batches and after it back, a hundredth of what the block itself costs; the rest is made anew only
// when the list of contacts or their interfaces have changed.
#pragma once
#include <cstdint>
#include <vector>

#include "engine/buffer.hpp"
#include "engine/view.hpp"

namespace phy::engine::group {

template <class T>
class WideContacts {
 public:
  /// W: contacts side by side. `n_geometry`, `n_fields`: numbers of a contact, and its lane vectors of
  /// memory.
  WideContacts(std::size_t W, std::size_t n_geometry, std::size_t n_fields)
      : W_(W), n_geometry_(n_geometry), n_fields_(n_fields) {}

  /// Places for the contacts of the view, which have changed.
  void arrange(const GroupView<T>& view);
  /// State of the contacts into the batches; the view gains them.
  void enter(GroupView<T>& view);
  /// And back.
  void leave(const GroupView<T>& view) const;

 private:
  std::size_t W_, n_geometry_, n_fields_;
  std::vector<std::int32_t> row_batch_, joint_, contact_, a_, b_, place_;
  std::vector<std::int32_t> row_group_, pushed_, pushes_;
  std::vector<PushedGrains> groups_;
  std::vector<ContactSlip<T>> slips_;
  Buffer<T> constants_, state_, push_, sums_;
  std::size_t most_places_ = 0;

  // Used while a row is laid out.
  struct Push {
    std::int32_t grain, record;
  };
  struct Run {  ///< pushes of one grain
    std::size_t first;
    std::int32_t n;
  };
  std::vector<std::int32_t> row_;
  std::vector<Push> record_of_;
  std::vector<Run> grains_;

  static constexpr std::int32_t none = -1;
  void add_row(const GroupView<T>& view, std::int32_t first, std::int32_t end);
  void add_pushes(const GroupView<T>& view, std::int32_t first, std::int32_t end);
  void fill_constants(const GroupView<T>& view);
  template <class Use>
  void each_number(const Use& use) const;
};

}  // namespace phy::engine::group
