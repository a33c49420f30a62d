#include "engine/wide_contacts.hpp"

#include <algorithm>
#include <numeric>

#include "base/lane_records.hpp"

namespace phy::engine::group {

/// A row's contacts, model by model, each model from a batch of its own on.
template <class T>
void WideContacts<T>::add_row(const GroupView<T>& v, std::int32_t first, std::int32_t end) {
  const std::size_t start = contact_.size();
  const auto joint = [&](std::int32_t c) { return v.contact_const[c].joint; };
  row_.resize(static_cast<std::size_t>(end - first));
  std::iota(row_.begin(), row_.end(), first);
  std::stable_sort(row_.begin(), row_.end(),
                   [&](std::int32_t c, std::int32_t d) { return joint(c) < joint(d); });
  const auto fill_batch = [&] { contact_.resize((contact_.size() + W_ - 1) / W_ * W_, none); };
  for (std::size_t i = 0; i < row_.size(); ++i) {
    if (i > 0 && joint(row_[i]) != joint(row_[i - 1])) fill_batch();
    if (contact_.size() % W_ == 0) joint_.push_back(joint(row_[i]));
    place_[static_cast<std::size_t>(row_[i])] = static_cast<std::int32_t>(contact_.size() - start);
    contact_.push_back(row_[i]);
  }
  fill_batch();
  most_places_ = std::max(most_places_, contact_.size() - start);
}

/// Grains with as many pushes one after the other: the loop over them then runs without guessing wrong when
/// one ends.
template <class T>
void WideContacts<T>::add_pushes(const GroupView<T>& v, std::int32_t first, std::int32_t end) {
  record_of_.clear(), grains_.clear();
  for (std::int32_t c = first; c < end; ++c) {
    const std::int32_t record = place_[static_cast<std::size_t>(c)] * record_size;
    record_of_.push_back({v.contact_const[c].a, record});
    record_of_.push_back({v.contact_const[c].b, record + record_size / 2});
  }
  std::stable_sort(record_of_.begin(), record_of_.end(),
                   [](const Push& p, const Push& q) { return p.grain < q.grain; });
  for (std::size_t i = 0; i < record_of_.size(); ++i) {
    if (i == 0 || record_of_[i].grain != record_of_[i - 1].grain) grains_.push_back({i, 0});
    ++grains_.back().n;
  }
  std::stable_sort(grains_.begin(), grains_.end(), [](const Run& p, const Run& q) { return p.n < q.n; });
  for (std::size_t i = 0; i < grains_.size(); ++i) {
    const auto at = static_cast<std::int32_t>(pushed_.size());
    if (i == 0 || grains_[i].n != grains_[i - 1].n)
      groups_.push_back({grains_[i].n, at, at, static_cast<std::int32_t>(pushes_.size())});
    groups_.back().end = at + 1;
    pushed_.push_back(record_of_[grains_[i].first].grain);
    for (std::int32_t k = 0; k < grains_[i].n; ++k)
      pushes_.push_back(record_of_[grains_[i].first + static_cast<std::size_t>(k)].record);
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
  place_.resize(static_cast<std::size_t>(n_contacts));
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
  w.contact = contact_.data(), w.a = a_.data(), w.b = b_.data(), w.place = place_.data();
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
