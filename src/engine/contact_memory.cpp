#include "engine/contact_memory.hpp"

#include <iterator>
#include <map>

#include "base/check.hpp"

namespace phy::engine::group {

template <class T>
ContactMemory<T>::ContactMemory(const GrainMemory<T>& grains, const contact::Models& models)
    : grains_(&grains), models_(models), W_(grains.lanes()), width_(c_fields + models.n_fields()) {
  // `with` and `fields` pass a contact in arrays of fixed size on the stack.
  for (const contact::ContactModel* m : {models.matrix, models.interface})
    PHY_CHECK(m->size().fields <= most_numbers && m->size().parameters <= most_numbers &&
                  m->size().geometry <= most_numbers,
              "a contact model has no more numbers than there is room for");
  matrix_table_.assign(models.matrix->size().parameters * W_);
}

template <class T>
std::size_t ContactMemory<T>::find(PairKey pair) const {
  const auto at = std::lower_bound(pairs_.begin(), pairs_.end(), pair);
  return at != pairs_.end() && *at == pair ? static_cast<std::size_t>(at - pairs_.begin()) : size();
}

template <class T>
std::array<double, ContactMemory<T>::most_numbers> ContactMemory<T>::fields(std::size_t c,
                                                                            std::size_t l) const {
  std::array<double, most_numbers> values{};
  for (std::size_t f = c_fields; f < width_; ++f)
    values[f - c_fields] = static_cast<double>(state_[(c * width_ + f) * W_ + l]);
  return values;
}

template <class T>
void ContactMemory<T>::set_fields(std::size_t c, std::size_t l, const double* values) {
  for (std::size_t f = c_fields; f < width_; ++f) at(c, f, l) = T(values[f - c_fields]);
}

/// Bonds and interfaces always stay in the list: they pull, or hold a plane, at any distance. Others stay as
/// long as a field, such as a shear force, is not zero.
template <class T>
bool ContactMemory<T>::remembers(std::size_t c, std::size_t l) const {
  if (original(c, l)) return true;
  for (std::size_t f = 0; f < width_; ++f)
    if (state_[(c * width_ + f) * W_ + l] != T(0)) return true;
  return false;
}

template <class T>
bool ContactMemory<T>::unbroken(std::size_t c, std::size_t l) const {
  return model(c, l).unbroken(fields(c, l).data());
}

template <class T>
double ContactMemory<T>::overlap(std::size_t c, std::size_t l) const {
  const std::size_t a = grain_a(c), b = grain_b(c);
  // Same quantity as the loop's, here from lengths: in double the cancellation does no harm.
  const Vec2 d0 = grains_->start(b) - grains_->start(a);
  const Vec2 d = d0 + grains_->displacement(b, l) - grains_->displacement(a, l);
  return norm(d0) - norm(d) - static_cast<double>(const_[c].gap);
}

template <class T>
ContactState ContactMemory<T>::state(std::size_t c, std::size_t l, const Specimen& specimen) const {
  ContactState s;
  // Grains in memory are sorted; outside the engine they have the numbers of the packing, the lower one
  // first.
  s.a = grains_->packing_id(key_a(pairs_[c])), s.b = grains_->packing_id(key_b(pairs_[c]));
  with(c, l, specimen,
       [&](const contact::ContactModel& model, const contact::Standing& now) { model.describe(now, s); });
  if (s.a > s.b) {  // seen from the other grain: both directions turn, the scalars stay
    std::swap(s.a, s.b);
    s.normal = -1.0 * s.normal;
  }
  return s;
}

template <class T>
void ContactMemory<T>::clear(std::size_t l) {
  for (std::size_t field = 0; field < size() * width_; ++field) state_[field * W_ + l] = T(0);
  for (std::size_t c = 0; c < size(); ++c) set_[c * W_ + l] = no_set, original_[c * W_ + l] = 0;
}

template <class T>
void ContactMemory<T>::carry(std::vector<PairKey> pairs) {
  // Both lists are sorted, so one pass carries all states over. Pairs without a state start at zero, the
  // state of a pair that has not touched.
  Buffer<T> state;
  state.assign(pairs.size() * width_ * W_);
  std::vector<std::uint8_t> set(pairs.size() * W_, no_set), original(pairs.size() * W_, 0);
  std::size_t old = 0;
  for (std::size_t c = 0; c < pairs.size(); ++c) {
    while (old < pairs_.size() && pairs_[old] < pairs[c]) ++old;
    if (old == pairs_.size() || pairs_[old] != pairs[c]) continue;
    std::copy_n(state_.get() + old * width_ * W_, width_ * W_, state.get() + c * width_ * W_);
    std::copy_n(set_.data() + old * W_, W_, set.data() + c * W_);
    std::copy_n(original_.data() + old * W_, W_, original.data() + c * W_);
  }
  state_ = std::move(state);
  set_ = std::move(set);
  original_ = std::move(original);
  pairs_ = std::move(pairs);
}

template <class T>
void ContactMemory<T>::install(std::size_t l, const Specimen& specimen) {
  // Mere touching needs no state; its place may even be missing.
  for (const Contact& k : specimen.contacts) {
    if (k.kind == ContactKind::touching) continue;
    const std::size_t c = find(grains_->key(k.a, k.b));
    PHY_CHECK(c < size(), "a bonded pair is in the list");
    original_[c * W_ + l] = 1;
    if (k.kind == ContactKind::joint) {
      // `side` of a specimen belongs to the order of packing numbers, here to that of sorted numbers.
      const bool same_order = grains_->sorted_id(k.a) < grains_->sorted_id(k.b);
      at(c, c_side, l) = T(same_order ? k.side : -k.side);
      set_[c * W_ + l] = k.set;
    }
    std::array<double, most_numbers> state{};
    models_.of(k.kind).install(specimen, k, state.data());
    set_fields(c, l, state.data());
  }
}

/// The shear force is taken over, so that it does not jump where a contact changes its model
/// (docs/decisions/0009).
template <class T>
void ContactMemory<T>::make_interface(std::size_t c, std::size_t l, const Specimen& specimen,
                                      const Meeting& meeting) {
  const double F_s = state(c, l, specimen).F_s;
  std::array<double, most_numbers> fields{};
  models_.interface->meet(meeting.gap, F_s, fields.data());
  at(c, c_side, l) = T(meeting.side);
  set_[c * W_ + l] = meeting.set;
  set_fields(c, l, fields.data());
}

template <class T>
void ContactMemory<T>::copy(std::size_t l, ContactMemory<T>& to, std::size_t to_lane) const {
  // The target first gets places for all our pairs. Both lists are then sorted and ours is part of theirs.
  std::vector<PairKey> all;
  std::set_union(pairs_.begin(), pairs_.end(), to.pairs_.begin(), to.pairs_.end(), std::back_inserter(all));
  to.carry(std::move(all));
  std::size_t there = 0;
  for (std::size_t c = 0; c < size(); ++c, ++there) {
    while (to.pairs_[there] != pairs_[c]) ++there;
    for (std::size_t f = 0; f < width_; ++f) to.at(there, f, to_lane) = state_[(c * width_ + f) * W_ + l];
    to.set_[there * to.W_ + to_lane] = set_[c * W_ + l];
    to.original_[there * to.W_ + to_lane] = original_[c * W_ + l];
  }
}

template <class T>
void ContactMemory<T>::make_constants(const MatrixRecipe& matrix) {
  const Layout& layout = grains_->layout();
  const_.clear();
  geometry_.clear();
  row_contact_.assign(1, 0);
  far_rows_ = false;
  std::array<double, 2 * most_numbers> numbers{};
  for (const PairKey key : pairs_) {
    const auto a = static_cast<std::size_t>(key_a(key)), b = static_cast<std::size_t>(key_b(key));
    const double r1 = grains_->radius(a), r2 = grains_->radius(b);
    const Vec2 d = grains_->start(b) - grains_->start(a);
    const double d0 = norm(d), gap0 = d0 - r1 - r2;
    // In a stress-free packing discs may overlap without force: pressing begins at the distance that they
    // start with. Otherwise an initial overlap is a force.
    const double gap = gap0 > 0.0 || !grains_->packing().stress_free ? gap0 : 0.0;
    const_.push_back(
        {key_a(key), key_b(key), -1, T(d.x), T(d.y), T(d0), T(gap), T(r1 + 0.5 * gap0), T(r2 + 0.5 * gap0)});
    models_.matrix->geometry(matrix, r1, r2, numbers.data());
    models_.interface->geometry(matrix, r1, r2, numbers.data() + models_.matrix->size().geometry);
    for (std::size_t i = 0; i < models_.n_geometry(); ++i) geometry_.push_back(T(numbers[i]));
    // Pairs are sorted by their upper grain, so contacts of a row are one range. Rows without contacts get an
    // empty range. A contact over more than one row forbids time skewing (sweep.hpp).
    const std::int32_t row = layout.row_of[b];
    while (static_cast<std::int32_t>(row_contact_.size()) <= row)
      row_contact_.push_back(static_cast<std::int32_t>(const_.size()) - 1);
    far_rows_ = far_rows_ || row - layout.row_of[a] > 1;
  }
  while (static_cast<int>(row_contact_.size()) <= layout.n_rows())
    row_contact_.push_back(static_cast<std::int32_t>(const_.size()));
}

template <class T>
void ContactMemory<T>::fill_matrix_parameters(const LaneSpecimens& specimens) {
  const std::size_t n = models_.matrix->size().parameters;
  std::array<double, most_numbers> values{};
  for (std::size_t l = 0; l < W_; ++l) {
    if (specimens[l] != nullptr)
      models_.matrix->parameters(*specimens[l], no_set, values.data());
    else
      // An empty lane still computes: idle parameters keep it at zero and free of NaN.
      models_.matrix->idle_parameters(values.data());
    for (std::size_t i = 0; i < n; ++i) matrix_table_[i * W_ + l] = T(values[i]);
  }
}

template <class T>
void ContactMemory<T>::fill_interface_row(std::size_t row, const std::string& sets,
                                          const LaneSpecimens& specimens) {
  const std::size_t n = models_.interface->size().parameters;
  std::array<double, most_numbers> values{};
  for (std::size_t l = 0; l < W_; ++l) {
    const auto set = static_cast<std::uint8_t>(sets[l]);
    if (set == no_set)
      models_.interface->idle_parameters(values.data());
    else
      models_.interface->parameters(*specimens[l], set, values.data());
    for (std::size_t i = 0; i < n; ++i) interface_table_[(row * n + i) * W_ + l] = T(values[i]);
  }
}

template <class T>
void ContactMemory<T>::assign_interfaces(const LaneSpecimens& specimens) {
  std::map<std::string, std::int32_t> rows;
  // Which bedding set every lane has here, as one string: contacts with equal strings share a row of
  // parameters.
  for (std::size_t c = 0; c < size(); ++c) {
    const std::string sets(reinterpret_cast<const char*>(set_.data()) + c * W_, W_);
    const bool some =
        std::any_of(sets.begin(), sets.end(), [](char s) { return static_cast<std::uint8_t>(s) != no_set; });
    const_[c].joint =
        some ? rows.try_emplace(sets, static_cast<std::int32_t>(rows.size())).first->second : -1;
  }
  // Never empty: the loop's pointer stays valid also without interfaces.
  interface_table_.assign(std::max<std::size_t>(1, rows.size()) * models_.interface->size().parameters * W_);
  for (const auto& [sets, row] : rows) fill_interface_row(static_cast<std::size_t>(row), sets, specimens);
}

template <class T>
void ContactMemory<T>::enter(GroupView<T>& view) {
  view.row_contact = row_contact_.data();
  view.contact_const = const_.data(), view.geometry = geometry_.data();
  view.contact = state_.get();
  view.matrix = matrix_table_.get(), view.joint = interface_table_.get();
}

template class ContactMemory<double>;
template class ContactMemory<float>;

}  // namespace phy::engine::group
