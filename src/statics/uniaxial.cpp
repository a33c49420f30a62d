#include "statics/uniaxial.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <iterator>
#include <numeric>
#include <string>

#include "base/clock.hpp"
#include "base/nan.hpp"
#include "base/parallel.hpp"
#include "engine/layout.hpp"

namespace phy::statics {
namespace {

constexpr double unit_strain = 1.0;
constexpr double worst_ground_share = 1e-6;  // of the platen force that weak springs may carry
constexpr double undecided = 1e-9;  // closures below this, in grain radii per unit strain, are rounding

/// "12, 77, 103 and 5 more"
std::string listed(const std::vector<std::uint32_t>& grains) {
  constexpr std::size_t shown = 10;
  std::string text;
  for (std::size_t i = 0; i < std::min(shown, grains.size()); ++i)
    text += (i > 0 ? ", " : "") + std::to_string(grains[i]);
  if (grains.size() > shown) text += " and " + std::to_string(grains.size() - shown) + " more";
  return text;
}

/// The grain that keeps frictionless specimens from sliding away: most contacts in the largest connected
/// part.
std::uint32_t anchor(const Network& net) {
  const laws::Tangent<double> any{1.0, 1.0, 1.0};
  Network grains = net;
  // Platens join everything and would make one part of loose ones.
  std::erase_if(grains.links, [&](const Link& l) { return l.a >= net.n_grains; });
  const auto part = connected_parts(grains, std::vector<laws::Tangent<double>>(grains.links.size(), any));
  std::vector<std::uint32_t> size(net.x.size(), 0), contacts(net.x.size(), 0);
  for (const std::uint32_t p : part) ++size[p];
  for (const Link& l : grains.links) ++contacts[l.a], ++contacts[l.b];
  std::uint32_t best = 0;
  for (std::uint32_t i = 1; i < net.n_grains; ++i) {
    const auto a = size[part[i]], b = size[part[best]];
    // The lowest number wins a tie: the same grain on every machine.
    if (a > b || (a == b && contacts[i] > contacts[best])) best = i;
  }
  return best;
}

/// Do contacts lead from the bottom to the top platen? If not: the grains that hang on one platen only, the
/// smaller lot.
ElasticOutcome check_load_path(const Network& net, const std::vector<laws::Tangent<double>>& k) {
  const auto part = connected_parts(net, k);
  const std::size_t bottom = net.n_grains, top = bottom + 1;
  // Through the contacts that are closed now: the set changes from solution to solution.
  if (part[bottom] == part[top]) return {};
  std::vector<std::uint32_t> low, high;
  for (std::uint32_t i = 0; i < net.n_grains; ++i) {
    if (part[i] == part[bottom]) low.push_back(i);
    if (part[i] == part[top]) high.push_back(i);
  }
  // The smaller lot is what has come off.
  const bool upper = high.size() <= low.size();
  std::vector<std::uint32_t>& lot = upper ? high : low;
  const std::string reason =
      std::string("no chain of contacts joins the platens; the ") + (upper ? "top" : "bottom") +
      " platen is in touch with " +
      (lot.empty() ? "no grain" : std::to_string(lot.size()) + " grains: " + listed(lot));
  return {ElasticStatus::no_load_path, reason, "bond the parts of the specimen to each other",
          std::move(lot)};
}

/// Parameters of one name are also varied by the same amount.
void add_together(const contact::ElasticParameter& p, const Sensitivity& s,
                  std::vector<Sensitivity>& together) {
  for (Sensitivity& sum : together)
    if (sum.parameter == p.together) {
      sum.dE += s.dE, sum.dnu += s.dnu;
      return;
    }
  // The first of its name brings the place in the list.
  together.push_back(s);
  together.back().parameter = p.together;
}

}  // namespace

void UniaxialStatics::prepare(const Specimen& specimen, const ElasticOptions& options) {
  specimen_ = &specimen;
  // Contacts first, platens behind them: numbers of contacts are those of the specimen.
  network_ = make_network(specimen);
  add_platens(network_, specimen, options.platens);
  const auto bottom = static_cast<std::uint32_t>(network_.n_grains), top = bottom + 1;
  // The answer is linear in the strain as long as the same contacts are closed, so any strain will do.
  const double delta = 0.5 * unit_strain * specimen.packing->height;
  boundary_ = {};
  for (const std::uint32_t platen : {bottom, top})
    for (const int component : {0, 1, 2})
      boundary_.movements.push_back({{platen, component},
                                     component != 1  ? 0.0
                                     : platen == top ? -delta
                                                     : delta});
  // Smooth platens leave one rigid motion, sideways.
  if (options.platens == Platens::frictionless && network_.n_grains > 0)
    boundary_.movements.push_back({{anchor(network_), 0}, 0.0});
  prescribed_.clear();
  for (const Given& m : boundary_.movements) prescribed_.push_back(m.where);
  // The next angle of one packing mostly has the same pairs: the symbolic part is kept.
  if (!system_ || !system_->fits(network_, prescribed_)) system_.emplace(network_, prescribed_);
}

// One solution with the present set of closed contacts. False: the outcome says why there is none.
bool UniaxialStatics::step(ElasticResult& result, Reading& reading) {
  ++result.n_iterations;
  // Linear with the contacts that are closed; which are is found by `update`.
  k_ = stiffnesses(network_, active_);
  result.outcome = system_->factor(network_, k_);
  if (result.outcome.ok()) result.outcome = check_load_path(network_, k_);
  if (!result.outcome.ok()) return false;
  u_ = system_->solve(network_, k_, boundary_);
  read(reading);
  // A load that meets a mechanism moves it until the weak springs hold it.
  const bool carried = reading.force > 0.0 && system_->ground_share(u_, reading.force) < worst_ground_share;
  // A specimen that lengthens under load has no gauge worth reading.
  if (carried && reading.axial > 0.0) return true;
  if (carried) {
    result.outcome = {ElasticStatus::no_gauge,
                      "too few grains carry load in the middle 60 % of the height",
                      "use a specimen with more grains",
                      {}};
    return false;
  }
  for (std::uint32_t i = 0; i < network_.n_grains; ++i)
    if (system_->loose()[i]) result.outcome.grains.push_back(i);
  result.outcome.status = ElasticStatus::mechanism;
  result.outcome.reason = "the load meets a part that moves without resistance, among the grains " +
                          listed(result.outcome.grains);
  result.outcome.advice = "bond these grains or give their contacts shear stiffness";
  return false;
}

void UniaxialStatics::read(Reading& reading) {
  Packing firm = *specimen_->packing;  // the gauge reads the grains that take part
  std::vector<std::size_t> number;
  firm.discs.clear();
  for (std::size_t i = 0; i < network_.n_grains; ++i)
    if (!system_->loose()[i]) firm.discs.push_back(specimen_->packing->discs[i]), number.push_back(i);
  const engine::GaugeWeights w = engine::gauge_weights(firm);
  gauge_axial_.assign(u_.size(), 0.0), gauge_lateral_.assign(u_.size(), 0.0);
  reading.axial = reading.lateral = 0.0;
  for (std::size_t j = 0; j < number.size(); ++j) {
    // Kept as loads: the adjoint solutions for these give all sensitivities at once.
    gauge_lateral_[3 * number[j]] = -w.x[j], gauge_axial_[3 * number[j] + 1] = -w.y[j];
    reading.lateral -= w.x[j] * u_[3 * number[j]], reading.axial -= w.y[j] * u_[3 * number[j] + 1];
  }
  const std::vector<double> f = inner_forces(network_, k_, u_);
  const std::size_t bottom = 3 * network_.n_grains + 1;
  // Both platens carry the same but for rounding and the weak springs: the mean.
  reading.force = 0.5 * (f[bottom] - f[bottom + 3]);
  reading.E = reading.force / (specimen_->packing->width * reading.axial);
  reading.nu = -reading.lateral / reading.axial;
}

// Opens and closes unilateral parts by the last solution. The third change is the last: open, closed, open
// for good.
UniaxialStatics::Update UniaxialStatics::update(std::vector<std::uint8_t>& changes) {
  constexpr std::uint8_t last_change = 3;
  Update update;
  for (std::size_t i = 0; i < network_.links.size(); ++i) {
    const Link& l = network_.links[i];
    if (!l.unilateral) continue;
    const double closure = strains(l, u_)[0];
    const bool closed = closure > 0.0;
    // A contact without load has a closure of rounding alone, and would flicker.
    if (closed == (active_[i] != 0) || std::fabs(closure) < undecided * network_.length) continue;
    ++update.wrong;
    // Some contacts open when closed and close when open: they are counted, and left.
    if (changes[i] == last_change) continue;
    ++changes[i], ++update.changed;
    active_[i] = closed;
  }
  return update;
}

ElasticResult UniaxialStatics::solve(const Specimen& specimen, const ElasticOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  prepare(specimen, options);
  ElasticResult result;
  result.bilateral = options.bilateral;
  active_.assign(network_.links.size(), 1);
  std::vector<std::uint8_t> changes(network_.links.size(), 0);
  const double allowed = options.max_alternating * static_cast<double>(specimen.contacts.size());
  Reading reading, before;
  // Active set: solve, open what pulls, close what overlaps, again.
  while (step(result, reading) && !options.bilateral) {
    const bool steady = std::fabs(reading.E - before.E) <= options.tolerance * std::fabs(reading.E) &&
                        std::fabs(reading.nu - before.nu) <= options.tolerance;
    // `update` already prepares the next set; the answer belongs to this one.
    const std::vector<char> solved = active_;
    const auto [wrong, changed] = update(changes);
    result.n_alternating = static_cast<std::int64_t>(wrong);
    const bool few = static_cast<double>(result.n_alternating) <= allowed;
    // Done when nothing changes, or when what still changes matters to no digit that is asked for.
    if (changed == 0 || (steady && few) || result.n_iterations >= options.max_iterations) {
      active_ = solved;
      const bool settled = changed == 0 || steady;
      if (!few || !settled)
        result.outcome = {ElasticStatus::not_converged,
                          std::to_string(result.n_alternating) +
                              " contacts have no consistent state: closed they open, open they close",
                          "use the bilateral solution, or compare with a run of the press",
                          {}};
      break;
    }
    before = reading;
  }
  finish(result, reading, options);
  result.seconds = seconds_since(start);
  return result;
}

ElasticResult UniaxialStatics::solve_held(const Specimen& specimen, const std::vector<char>& active,
                                          const ElasticOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  prepare(specimen, options);
  ElasticResult result;
  result.bilateral = options.bilateral;
  active_ = active;
  Reading reading;
  step(result, reading);
  finish(result, reading, options);
  result.seconds = seconds_since(start);
  return result;
}

void UniaxialStatics::finish(ElasticResult& result, const Reading& reading, const ElasticOptions& options) {
  const Specimen& s = *specimen_;
  result.name = s.name;
  const ElasticStatus status = result.outcome.status;
  // A set that has not settled still has a useful answer; anything else has none.
  if (status != ElasticStatus::solved && status != ElasticStatus::not_converged) {
    result.E_gauge = result.nu_gauge = result.E_platen = nan;
    u_.clear();
    specimen_ = nullptr;
    return;
  }
  result.E_gauge = reading.E, result.nu_gauge = reading.nu;
  result.E_platen = reading.force / (s.packing->width * unit_strain);
  for (std::size_t i = 0; i < network_.links.size(); ++i) {
    const Link& l = network_.links[i];
    // Platens are no contacts of the specimen.
    if (l.a >= network_.n_grains) continue;
    result.n_contacts += l.k.unilateral.k_n > 0.0 || l.k.bilateral.k_n > 0.0 ? 1 : 0;
    result.n_open += l.k.unilateral.k_n > 0.0 && !active_[i] ? 1 : 0;
  }
  std::vector<std::uint32_t> loose;
  for (std::uint32_t i = 0; i < network_.n_grains; ++i)
    if (system_->loose()[i]) loose.push_back(i);
  result.n_loose = static_cast<std::int64_t>(loose.size());
  // No failure: rattlers carry nothing in a press either.
  if (!loose.empty() && result.outcome.ok()) {
    result.outcome.reason = std::to_string(loose.size()) + " grains carry no load: " + listed(loose);
    result.outcome.grains = std::move(loose);
  }
  if (options.sensitivities) add_sensitivities(result, reading);
  specimen_ = nullptr;
}

void UniaxialStatics::add_sensitivities(ElasticResult& result, const Reading& reading) const {
  // Adjoint method: two further solutions with the same factor, whatever the number of parameters.
  const Movements axial = system_->solve(gauge_axial_), lateral = system_->solve(gauge_lateral_);
  const double width = specimen_->packing->width, approach = unit_strain * specimen_->packing->height;
  std::vector<std::array<double, 3>> e, e_axial, e_lateral;
  for (const Link& l : network_.links) {
    e.push_back(strains(l, u_));
    e_axial.push_back(strains(l, axial)), e_lateral.push_back(strains(l, lateral));
  }
  const auto sensitivity = [&](const contact::ElasticParameter& p, std::uint8_t set, double value) {
    const std::vector<laws::Tangent<double>> rates = stiffness_rates(network_, *specimen_, active_, p, set);
    double dF = 0.0, d_axial = 0.0, d_lateral = 0.0;
    for (std::size_t i = 0; i < network_.links.size(); ++i) {
      const std::array<double, 3> q = resistance(rates[i], e[i]);
      for (std::size_t r = 0; r < 3; ++r)
        // Of the energy, whose derivative by a parameter needs no change of u: u is in equilibrium.
        dF += q[r] * e[i][r], d_axial -= q[r] * e_axial[i][r], d_lateral -= q[r] * e_lateral[i][r];
    }
    Sensitivity s{p.name, p.unit, value, 0.0, 0.0};
    // Quotient rule: E = F/(width axial), nu = -lateral/axial.
    s.dE = (dF / approach - reading.E * width * d_axial) / (width * reading.axial);
    s.dnu = -(d_lateral + reading.nu * d_axial) / reading.axial;
    return s;
  };
  const contact::Models& models = network_.models;
  std::vector<Sensitivity> together;
  for (const contact::ElasticParameter& p : models.matrix->elastic_parameters()) {
    // Layers alone have no foliation that this could refer to.
    if (p.matrix == &MatrixRecipe::stiffness_ratio && !specimen_->matrix.directional()) continue;
    Sensitivity s = sensitivity(p, 0, specimen_->matrix.*p.matrix);
    if (p.together != nullptr) add_together(p, s, together);
    s.parameter = "matrix." + s.parameter;
    result.sensitivities.push_back(std::move(s));
  }
  std::move(together.begin(), together.end(), std::back_inserter(result.sensitivities));
  for (std::size_t i = 0; i < specimen_->bedding.size(); ++i)
    for (const contact::ElasticParameter& p : models.interface->elastic_parameters()) {
      Sensitivity s = sensitivity(p, static_cast<std::uint8_t>(i), specimen_->bedding[i].*p.bedding);
      s.parameter = "bedding[" + std::to_string(i) + "]." + s.parameter;
      result.sensitivities.push_back(std::move(s));
    }
}

ElasticResult solve_uniaxial(const Specimen& specimen, const ElasticOptions& options) {
  UniaxialStatics statics;
  return statics.solve(specimen, options);
}

std::vector<ElasticResult> solve_all(const std::vector<Specimen>& specimens, const ElasticOptions& options,
                                     int threads) {
  // Those of one packing after the other: the symbolic part of their systems is the same (system.hpp).
  std::vector<std::size_t> order(specimens.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::less<>()(specimens[a].packing.get(), specimens[b].packing.get());
  });
  std::vector<ElasticResult> results(specimens.size());
  for_all(order.size(), threads, [&] {
    return [&, statics = UniaxialStatics()](std::size_t next) mutable {
      const std::size_t i = order[next];
      // What the user has stopped keeps an empty result.
      if (options.stop == nullptr || !*options.stop) results[i] = statics.solve(specimens[i], options);
    };
  });
  return results;
}

}  // namespace phy::statics
