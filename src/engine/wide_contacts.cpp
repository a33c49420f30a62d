#include "engine/wide_contacts.hpp"

#include <algorithm>
#include <map>

#include "base/lane_records.hpp"

namespace phy::engine::group {

/// A row's contacts, model by model, each model from a batch of its own on.
template <class T>
void WideContacts<T>::add_row(const GroupView<T>& v, std::int32_t first, std::int32_t end) {
  std::map<std::int32_t, std::vector<std::int32_t>> of_model;
  for (std::int32_t c = first; c < end; ++c) of_model[v.contact_const[c].joint].push_back(c);
  const std::size_t start = contact_.size();
  for (const auto& [joint, contacts] : of_model) {
    for (const std::int32_t c : contacts) {
      order_[static_cast<std::size_t>(c)] = static_cast<std::int32_t>(contact_.size() - start);
      contact_.push_back(c);
    }
    while (contact_.size() % W_ != 0) contact_.push_back(none);
    joint_.resize(contact_.size() / W_, joint);
  }
  most_places_ = std::max(most_places_, contact_.size() - start);
}

/// Grains with as many pushes one after the other: the loop over them then runs without guessing wrong when
/// one ends.
template <class T>
void WideContacts<T>::add_pushes(const GroupView<T>& v, std::int32_t first, std::int32_t end) {
  std::map<std::int32_t, std::vector<std::int32_t>> of_grain;
  for (std::int32_t c = first; c < end; ++c) {
    const std::int32_t record = order_[static_cast<std::size_t>(c)] * record_size;
    of_grain[v.contact_const[c].a].push_back(record);
    of_grain[v.contact_const[c].b].push_back(record + record_size / 2);
  }
  std::map<std::size_t, std::vector<std::int32_t>> by_number;
  for (const auto& [grain, pushes] : of_grain) by_number[pushes.size()].push_back(grain);
  for (const auto& [n, grains] : by_number) {
    const auto start = static_cast<std::int32_t>(pushed_.size());
    groups_.push_back({static_cast<std::int32_t>(n), start, start + static_cast<std::int32_t>(grains.size()),
                       static_cast<std::int32_t>(pushes_.size())});
    pushed_.insert(pushed_.end(), grains.begin(), grains.end());
    for (const std::int32_t g : grains) pushes_.insert(pushes_.end(), of_grain[g].begin(), of_grain[g].end());
  }
}

/// An empty place is a contact between a grain and itself, too far apart to press.
template <class T>
void WideContacts<T>::fill_constants(const GroupView<T>& v) {
  constexpr T far = T(1e3);  // [m]
  const std::size_t n = n_wide_constants + n_geometry_;
  constants_.assign(joint_.size() * n * W_);
  a_.assign(contact_.size(), 0), b_.assign(contact_.size(), 0);
  for (std::size_t p = 0; p < contact_.size(); ++p) {
    const bool empty = contact_[p] == none;
    const auto c = static_cast<std::size_t>(empty ? contact_[p / W_ * W_] : contact_[p]);
    const ContactConst<T>& k = v.contact_const[c];
    T* const lane = constants_.get() + p / W_ * n * W_ + p % W_;
    const auto put = [&](std::size_t i, T x) { lane[i * W_] = x; };
    put(wide_X, k.X), put(wide_Y, k.Y), put(wide_d0, k.d0), put(wide_gap, empty ? far : k.gap);
    put(wide_lever_a, k.lever_a), put(wide_lever_b, k.lever_b);
    for (std::size_t i = 0; i < n_geometry_; ++i) put(n_wide_constants + i, v.geometry[c * n_geometry_ + i]);
    if (!empty) a_[p] = k.a, b_[p] = k.b;
  }
}

template <class T>
void WideContacts<T>::arrange(const GroupView<T>& v) {
  const std::int32_t n_contacts = v.row_contact[v.n_rows];
  row_batch_.assign(1, 0), joint_.clear(), contact_.clear(), most_places_ = 0;
  row_group_.assign(1, 0), groups_.clear(), pushed_.clear(), pushes_.clear();
  order_.resize(static_cast<std::size_t>(n_contacts));
  for (int row = 0; row < v.n_rows; ++row) {
    add_row(v, v.row_contact[row], v.row_contact[row + 1]);
    row_batch_.push_back(static_cast<std::int32_t>(joint_.size()));
    add_pushes(v, v.row_contact[row], v.row_contact[row + 1]);
    row_group_.push_back(static_cast<std::int32_t>(groups_.size()));
  }
  fill_constants(v);
  state_.assign(contact_.size() * n_fields_);
  push_.assign(most_places_ * record_size);
  sums_.assign(most_places_ * n_wide_sums);
  slips_.resize(most_places_);
}

/// Calls `use` with the places of a number among the contacts and in the batches.
template <class T>
template <class Use>
void WideContacts<T>::each_number(const Use& use) const {
  for (std::size_t p = 0; p < contact_.size(); ++p) {
    if (contact_[p] == none) continue;
    for (std::size_t f = 0; f < n_fields_; ++f)
      use(static_cast<std::size_t>(contact_[p]) * n_fields_ + f, (p / W_ * n_fields_ + f) * W_ + p % W_);
  }
}

template <class T>
void WideContacts<T>::enter(GroupView<T>& v) {
  each_number([&](std::size_t from, std::size_t to) { state_[to] = v.contact[from]; });
  WideView<T>& w = v.wide;
  w.row_batch = row_batch_.data(), w.joint = joint_.data();
  w.contact = contact_.data(), w.a = a_.data(), w.b = b_.data(), w.order = order_.data();
  w.row_group = row_group_.data(), w.group = groups_.data();
  w.pushed = pushed_.data(), w.pushes = pushes_.data();
  w.constants = constants_.get(), w.state = state_.get(), w.push = push_.get();
  w.sums = sums_.get(), w.slips = slips_.data(), w.most_places = most_places_;
}

template <class T>
void WideContacts<T>::leave(const GroupView<T>& v) const {
  each_number([&](std::size_t to, std::size_t from) { v.contact[to] = state_[from]; });
}

template class WideContacts<double>;
template class WideContacts<float>;

}  // namespace phy::engine::group
