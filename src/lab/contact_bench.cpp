#include "lab/contact_bench.hpp"

#include "laws/laws.hpp"

namespace phy::lab {
namespace {

template <class Law>
class Bench final : public BenchContact {
 public:
  explicit Bench(std::span<const double> parameters) : law_(parameters) {}
  laws::Reaction<double> step(ContactPoint d) override {
    at_ = at_ + d;
    // Laws take closure and rotation as totals, slide as an increment: as in the force loop.
    motion_ = {at_.closure, d.closure, d.slide, at_.rotation, d.rotation};
    return last_ = law_.step(motion_);
  }
  double energy() const override { return law_.energy(motion_, last_); }
  double capacity() const override { return law_.capacity(); }

 private:
  Law law_;
  ContactPoint at_;
  laws::Motion<double> motion_{};
  laws::Reaction<double> last_{};
};

/// Calls `use` with a null pointer of every law's type, in the order of the list.
template <class Use>
void for_each_law(const Use& use) {
  [&]<class... Law>(const std::tuple<Law...>*) {
    (use(static_cast<Law*>(nullptr)), ...);
  }(static_cast<laws::Laws<double>*>(nullptr));
}

}  // namespace

const std::vector<LawInfo>& law_infos() {
  static const std::vector<LawInfo> infos = [] {
    std::vector<LawInfo> all;
    for_each_law([&]<class Law>(Law*) { all.push_back({Law::name, Law::sentence, Law::parameters}); });
    return all;
  }();
  return infos;
}

std::unique_ptr<BenchContact> bench_contact(std::string_view law, std::span<const double> parameters) {
  std::unique_ptr<BenchContact> made;
  for_each_law([&]<class Law>(Law*) {
    // The list of laws is a list of types: the word picks one at run time.
    if (law == Law::name) made = std::make_unique<Bench<Law>>(parameters);
  });
  return made;
}

std::vector<BenchRow> drive(BenchContact& contact, std::span<const ContactPoint> corners, int steps) {
  std::vector<BenchRow> rows(1);
  rows.front().stored = contact.energy();
  ContactPoint from;
  for (const ContactPoint& corner : corners) {
    // Straight legs of equal steps, as the closed form takes them in one piece.
    const ContactPoint increment = (1.0 / steps) * (corner - from);
    for (int i = 0; i < steps; ++i) {
      const laws::Reaction<double> r = contact.step(increment);
      // Dissipated and released are sums since the start.
      BenchRow row = rows.back();
      row.at = from + ((i + 1.0) / steps) * (corner - from);
      row.forces = {r.F_n, r.F_s, r.M};
      row.dissipated += r.dissipated;
      row.released += r.released;
      row.stored = contact.energy();
      row.broke = r.broke_tension ? 1 : r.broke_shear ? 2 : 0;
      rows.push_back(row);
    }
    from = corner;
  }
  return rows;
}

}  // namespace phy::lab
