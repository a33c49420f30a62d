// Renewing the list of contacts, contacts that are created during a test, and the stable step that follows.
#include <cmath>

#include "engine/group.hpp"

namespace phy::engine::group {

/// Searches lanes whose lists would not last, or only those that were forgotten; the others keep theirs. A
/// pair that holds something stays.
template <class T>
std::vector<PairKey> Group<T>::collect_pairs(bool forgotten_only) {
  PairUnion all(grains_.size());
  const auto most = list_.farthest();
  for (std::size_t l = 0; l < W_; ++l) {
    if (!lanes_[l].specimen) continue;
    // A renewal makes the tables of all lanes anew, so lanes whose own list would end soon are searched along
    // with it.
    if (forgotten_only ? !list_.searched(l) : list_.worn(l, most, block(l))) {
      list_.search(l, block(l), boundary_.push(l));
      // Bonds of the specimen may span any gap; install() relies on their places.
      if (lanes_[l].fresh)
        for (const Contact& c : lanes_[l].specimen->contacts) list_.add(l, grains_.key(c.a, c.b));
    }
    for (const PairKey key : list_.near(l)) all.add(key);
  }
  // One lane that needs a pair keeps it for all.
  for (std::size_t c = 0; c < contacts_.size(); ++c)
    for (std::size_t l = 0; l < W_; ++l)
      if (contacts_.remembers(c, l)) {
        all.add(contacts_.pairs()[c]);
        break;
      }
  return all.sorted();
}

template <class T>
void Group<T>::rebuild(bool forgotten_only) {
  contacts_.carry(collect_pairs(forgotten_only));
  // The lowest occupied lane speaks for all: check_neighbour() has made sure that geometry is the same.
  MatrixRecipe matrix;
  for (std::size_t l = W_; l-- > 0;)
    if (lanes_[l].specimen) matrix = lanes_[l].specimen->matrix;
  contacts_.make_constants(matrix);
  for (std::size_t l = 0; l < W_; ++l) {
    if (lanes_[l].fresh) contacts_.install(l, *lanes_[l].specimen);
    lanes_[l].fresh = false;
  }
  // A new list may hold pairs that are already near; they are created at once, before interfaces get their
  // parameters.
  list_open();
  create_contacts();
  contacts_.assign_interfaces(specimens());
  boundary_.list_touches(list_);
  rearranged_ = true;
  dirty_ = false;
  ++n_rebuilds_;
}

/// Contacts that may yet be created in some lane; all others are there since the start.
template <class T>
void Group<T>::list_open() {
  open_.clear();
  for (std::size_t c = 0; c < contacts_.size(); ++c)
    for (std::size_t l = 0; l < W_; ++l)
      if (!contacts_.original(c, l) && lanes_[l].specimen) {
        open_.push_back(c);
        break;
      }
}

/// A pair that was never bonded and whose grains lie on different sides of a plane meets as a broken
/// interface.
template <class T>
bool Group<T>::create_interface(std::size_t c, std::size_t l, double gap) {
  const Specimen& s = *lanes_[l].specimen;
  const std::size_t n = grains_.size();
  // The label of a grain says between which planes of a set it lies; labels rise across the planes, so their
  // order is the side. The first set that separates the grains decides.
  for (std::size_t set = 0; set < s.n_laid(); ++set) {
    const std::int32_t a = s.plane_label[set * n + grains_.packing_id(key_a(contacts_.pairs()[c]))];
    const std::int32_t b = s.plane_label[set * n + grains_.packing_id(key_b(contacts_.pairs()[c]))];
    if (a == b) continue;
    contacts_.make_interface(c, l, s, {static_cast<std::uint8_t>(set), b > a ? 1 : -1, gap});
    return true;
  }
  return false;
}

/// What a contact that was created is, seen from the lower grain.
template <class T>
Contact Group<T>::created(std::size_t c, std::size_t l) const {
  Contact k;
  k.a = grains_.packing_id(key_a(contacts_.pairs()[c])),
  k.b = grains_.packing_id(key_b(contacts_.pairs()[c]));
  k.kind = ContactKind::touching;
  if (!contacts_.interface(c, l)) return k;
  k.kind = ContactKind::joint;
  k.side = static_cast<std::int8_t>(contacts_.side(c, l));
  k.set = contacts_.set(c, l);
  return k;
}

template <class T>
void Group<T>::create_contacts() {
  bool interfaces = false;
  for (const std::size_t c : open_) {
    const std::size_t a = contacts_.grain_a(c), b = contacts_.grain_b(c);
    for (std::size_t l = 0; l < W_; ++l) {
      // In the list since the start, not yet installed, or created before.
      if (contacts_.original(c, l) || !running(l) || contacts_.interface(c, l)) continue;
      const Vec2 d =
          grains_.start(b) - grains_.start(a) + grains_.displacement(b, l) - grains_.displacement(a, l);
      // Somewhat before the surfaces meet: a pair must be counted in the time step, and know its model,
      // before it carries force.
      const double gap = norm(d) - grains_.radius(a) - grains_.radius(b);
      if (gap >= meeting_gap * grains_.smallest_radius()) continue;
      Lane& lane = lanes_[l];
      if (lane.created.contains(contacts_.pairs()[c])) continue;
      interfaces = create_interface(c, l, gap) || interfaces;
      const ContactStiffness k =
          stiffness_of(contacts_.models(), *lane.specimen, created(c, l), (1.0 / norm(d)) * d);
      lane.created.emplace(contacts_.pairs()[c], k);
      // The bound only grows here; renew_step() makes it anew when it has become too loose.
      lane.bound->add(k);
    }
  }
  // Their parameter rows depend on the sets of all lanes.
  if (interfaces) contacts_.assign_interfaces(specimens()), rearranged_ = true;
  for (std::size_t l = 0; l < W_; ++l)
    if (running(l)) renew_step(l);
}

/// dt = safety 2/(omega_max sqrt(1 + alpha)), see stable_step.hpp; bodies and jacket use the same step.
template <class T>
void Group<T>::set_step(std::size_t l) {
  Lane& lane = lanes_[l];
  lane.dt = lane.setup.step_safety * 2.0 / (lane.bound->omega() * std::sqrt(1.0 + lane.setup.damping));
  boundary_.lane(l).dt = lane.dt;
}

template <class T>
void Group<T>::renew_step(std::size_t l) {
  if (lanes_[l].bound->loose()) tighten_bound(l);
  set_step(l);
}

/// The bound anew, from the contacts that are there: broken bonds have left less.
template <class T>
void Group<T>::tighten_bound(std::size_t l) {
  Lane& lane = lanes_[l];
  const Specimen& s = *lane.specimen;
  std::vector<ContactStiffness> stiffnesses;
  for (const Contact& k : s.contacts) {
    if (k.kind == ContactKind::touching) continue;  // with those that were created
    const std::size_t c = contacts_.find(grains_.key(k.a, k.b));
    const bool whole = k.kind == ContactKind::joint || (c < contacts_.size() && contacts_.unbroken(c, l));
    const ContactStiffness initial = initial_stiffness(contacts_.models(), s, k);
    stiffnesses.push_back(whole ? initial : stiffness_of(contacts_.models(), s, k, initial.branch, false));
  }
  for (const auto& [key, k] : lane.created) stiffnesses.push_back(k);
  lane.bound->renew(s, stiffnesses, lane.boundary(), lane.setup.body_friction);
}

template class Group<double>;
template class Group<float>;

}  // namespace phy::engine::group
