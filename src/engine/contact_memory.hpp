// The contacts of a group: one place per near pair of any lane, sorted by pair, with the state of its contact
// model in every lane. A place whose pair concerns other lanes only holds zeros. What the fields of a state
// mean is defined by the contact model (contact/model.hpp).
#pragma once
#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "contact/model.hpp"
#include "engine/grain_memory.hpp"

namespace phy::engine::group {

constexpr std::uint8_t no_set = 255;

/// Specimen of every lane; null: empty.
using LaneSpecimens = std::vector<const Specimen*>;

template <class T>
class ContactMemory {
 public:
  ContactMemory(const GrainMemory<T>& grains, const contact::Models& models);

  const contact::Models& models() const { return models_; }
  std::size_t size() const { return pairs_.size(); }
  const std::vector<PairKey>& pairs() const { return pairs_; }
  /// Place of a pair, size() if it has none.
  std::size_t find(PairKey pair) const;
  std::size_t grain_a(std::size_t c) const { return static_cast<std::size_t>(key_a(pairs_[c])); }
  std::size_t grain_b(std::size_t c) const { return static_cast<std::size_t>(key_b(pairs_[c])); }

  bool interface(std::size_t c, std::size_t lane) const { return side(c, lane) != 0; }
  /// Of an interface: +1 where the plane's normal points from grain a to grain b, else -1; 0 in the matrix.
  int side(std::size_t c, std::size_t lane) const {
    return static_cast<int>(state_[(c * width_ + c_side) * W_ + lane]);
  }
  std::uint8_t set(std::size_t c, std::size_t lane) const { return set_[c * W_ + lane]; }
  /// Bonded, or an interface, since the start of the test.
  bool original(std::size_t c, std::size_t lane) const { return original_[c * W_ + lane] != 0; }
  /// Holds something that a renewed list must not lose.
  bool remembers(std::size_t c, std::size_t lane) const;
  const contact::ContactModel& model(std::size_t c, std::size_t lane) const {
    return interface(c, lane) ? *models_.interface : *models_.matrix;
  }
  bool unbroken(std::size_t c, std::size_t lane) const;
  /// Approach of the grains beyond the point where they press on each other, now [m].
  double overlap(std::size_t c, std::size_t lane) const;
  /// Calls `use` with the model of a contact and the contact as it stands.
  template <class Use>
  auto with(std::size_t c, std::size_t lane, const Specimen& specimen, const Use& use) const;
  ContactState state(std::size_t c, std::size_t lane, const Specimen& specimen) const;

  /// All states, as they may be restored while the pairs stay.
  void keep(std::vector<T>& in) const { state_.keep(in); }
  void restore(const std::vector<T>& from) { state_.restore(from); }
  /// Empties a lane.
  void clear(std::size_t lane);
  /// From now on these pairs, sorted; states go along.
  void carry(std::vector<PairKey> pairs);
  /// Bonds and interfaces of a specimen as its test begins. All its pairs have places.
  void install(std::size_t lane, const Specimen& specimen);
  /// An unbonded pair becomes a broken interface of a bedding set.
  struct Meeting {
    std::uint8_t set;
    int side;    ///< as ContactConst has it: 1 where the plane's normal points from the first grain to the
                 ///< second
    double gap;  ///< they are apart [m]
  };
  void make_interface(std::size_t c, std::size_t lane, const Specimen& specimen, const Meeting& meeting);
  /// The affine start of all contacts of a lane: `field` gives the displacement at a point.
  template <class Field>
  void affine_start(std::size_t lane, const Specimen& specimen, const Field& field);
  void copy(std::size_t l, ContactMemory<T>& to, std::size_t to_lane) const;

  /// What all lanes share, after the pairs have changed.
  void make_constants(const MatrixRecipe& matrix);
  /// Parameters of the interfaces; contacts whose lanes see the same sets share a row.
  void assign_interfaces(const LaneSpecimens& specimens);
  void fill_matrix_parameters(const LaneSpecimens& specimens);
  /// Some contact joins rows that are not neighbours.
  bool far_rows() const { return far_rows_; }
  void enter(GroupView<T>& view);

 private:
  static constexpr std::size_t most_numbers = 16;  // fields, parameters or geometry of a model
  const GrainMemory<T>* grains_;
  contact::Models models_;
  std::size_t W_, width_;  // lane vectors per contact
  std::vector<PairKey> pairs_;
  std::vector<std::uint8_t> set_, original_;  // per contact and lane
  Buffer<T> state_, matrix_table_, interface_table_;
  std::vector<ContactConst<T>> const_;
  std::vector<T> geometry_;
  std::vector<std::int32_t> row_contact_;
  bool far_rows_ = false;

  T& at(std::size_t c, std::size_t field, std::size_t lane) {
    return state_[(c * width_ + field) * W_ + lane];
  }
  std::array<double, most_numbers> fields(std::size_t c, std::size_t lane) const;
  void set_fields(std::size_t c, std::size_t lane, const double* values);
  void fill_interface_row(std::size_t row, const std::string& sets, const LaneSpecimens& specimens);
};

template <class T>
template <class Use>
auto ContactMemory<T>::with(std::size_t c, std::size_t l, const Specimen& specimen, const Use& use) const {
  const std::size_t a = grain_a(c), b = grain_b(c);
  const bool plane = interface(c, l);
  const std::array<double, most_numbers> state = fields(c, l);
  std::array<double, most_numbers> numbers{};
  const std::size_t n = models_.n_geometry(), of_matrix = models_.matrix->size().geometry;
  const std::size_t first = plane ? of_matrix : 0, end = plane ? n : of_matrix;
  for (std::size_t i = first; i < end; ++i) numbers[i - first] = static_cast<double>(geometry_[c * n + i]);
  const Vec2 branch_0 = grains_->start(b) - grains_->start(a);
  const contact::Standing now{specimen,
                              set_[c * W_ + l],
                              static_cast<double>(side(c, l)),
                              original(c, l),
                              std::min(grains_->radius(a), grains_->radius(b)),
                              static_cast<double>(const_[c].gap),
                              branch_0,
                              branch_0 + grains_->displacement(b, l) - grains_->displacement(a, l),
                              grains_->rotation(b, l) - grains_->rotation(a, l),
                              numbers.data(),
                              state.data()};
  return use(model(c, l), now);
}

template <class T>
template <class Field>
void ContactMemory<T>::affine_start(std::size_t l, const Specimen& specimen, const Field& field) {
  for (std::size_t c = 0; c < size(); ++c) {
    const Vec2 du = field(grains_->start(grain_b(c))) - field(grains_->start(grain_a(c)));
    std::array<double, most_numbers> state = fields(c, l);
    with(c, l, specimen, [&](const contact::ContactModel& model, const contact::Standing& now) {
      model.affine_start(now, du, state.data());
    });
    set_fields(c, l, state.data());
  }
}

}  // namespace phy::engine::group
