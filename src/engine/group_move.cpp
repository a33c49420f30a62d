// A running specimen changes its group: columns of grains, touches and contacts are copied, lane by lane, and
// the books go along. What both groups derive from their lanes (lists, tables, constants) is made anew before
// their next block. A lane's bits never depended on its group, so none changes.
#include "engine/group.hpp"

namespace phy::group {

template <class T>
void Group<T>::send_motion(std::size_t l, Group<T>& to, std::size_t k) const {
  for (std::size_t field = 0; field < n_grains() * n_grain_fields; ++field)
    to.grain_[field * to.W_ + k] = grain_[field * W_ + l];
  for (std::size_t place = 0; place < n_tools_ * n_grains(); ++place) {
    to.touch_gap_[place * to.W_ + k] = touch_gap_[place * W_ + l];
    to.touch_shear_[place * to.W_ + k] = touch_shear_[place * W_ + l];
  }
}

template <class T>
void Group<T>::send_contacts(std::size_t l, Group<T>& to, std::size_t k) const {
  std::vector<PairKey> all;
  std::set_union(pairs_.begin(), pairs_.end(), to.pairs_.begin(), to.pairs_.end(), std::back_inserter(all));
  to.carry_state(all);
  to.pairs_ = std::move(all);
  std::size_t there = 0;
  for (std::size_t c = 0; c < pairs_.size(); ++c, ++there) {
    while (to.pairs_[there] != pairs_[c]) ++there;
    for (std::size_t f = 0; f < n_contact_fields; ++f)
      to.contact_[(there * n_contact_fields + f) * to.W_ + k] = contact_[(c * n_contact_fields + f) * W_ + l];
    to.set_[there * to.W_ + k] = set_[c * W_ + l];
    to.tag_[there * to.W_ + k] = tag_[c * W_ + l];
  }
}

template <class T>
void Group<T>::move_lane(int lane, LaneGroup& target, int to_lane) {
  auto* const to = dynamic_cast<Group<T>*>(&target);
  PHY_CHECK(to != nullptr && to != this && to->options_.interval == options_.interval,
            "a lane moves between groups of one precision and block");
  PHY_CHECK(at(lane).specimen && !to->at(to_lane).specimen, "a specimen moves into an empty lane");
  to->check_mate(*at(lane).specimen);
  const auto from = static_cast<std::size_t>(lane), into = static_cast<std::size_t>(to_lane);
  to->adopt_rig(at(lane).rig());
  to->at(to_lane) = at(lane);
  to->at(to_lane).searched = false;
  send_contacts(from, *to, into);
  send_motion(from, *to, into);
  to->dirty_ = true;
  reset_lane(lane);
}

template class Group<double>;
template class Group<float>;

}  // namespace phy::group
