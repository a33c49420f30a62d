#include "jobs/press_watch.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "io/base64.hpp"
#include "io/file.hpp"
#include "records/test_description.hpp"
#include "report/palette.hpp"
#include "system/process.hpp"

namespace phy::jobs {
namespace {

using Json = nlohmann::ordered_json;
constexpr int press_format = 1;
constexpr std::chrono::milliseconds period{250};  // between pictures, at least
constexpr std::chrono::milliseconds linger{400};  // in which an ended test is still shown
constexpr std::size_t most_points = 400;          // of a curve on a screen
constexpr double size_steps = 60000.0;            // across the specimen, from its centre: within 16 bits
constexpr double finest = 0.25e-6, largest_steps = 32000.0;  // of displacements, as in scenes

/// Halved in place whenever full: points stay evenly spread without knowing how long the test will be.
void keep_every_second(std::vector<double>& values) {
  for (std::size_t i = 1; 2 * i < values.size(); ++i) values[i] = values[2 * i];
  values.resize((values.size() + 1) / 2);
}

/// Rounded into 16 bits; what a blown-up test leaves, which may be no number, becomes 0 or the largest.
std::int16_t steps(double value, double quantum) {
  const double s = value / quantum;
  // lround of NaN is undefined, and -32768 would have no positive counterpart.
  return std::isnan(s) ? std::int16_t{0}
                       : static_cast<std::int16_t>(std::lround(std::clamp(s, -32767.0, 32767.0)));
}

template <class T>
// Little-endian bytes as base64: the page turns them into a typed array without parsing numbers.
std::string packed(const std::vector<T>& numbers) {
  return io::base64({reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(T)});
}

double quantum_of(const Packing& p) { return std::max({p.width, p.height, 1e-9}) / size_steps; }

/// What does not change in the course of a test: without the bracket that would close it.
std::string head_of(const RunningTest& test) {
  const Packing& packing = *test.specimen.packing;
  const double quantum = quantum_of(packing);
  std::vector<std::int16_t> discs;
  for (const Disc& d : packing.discs)
    // From the centre, so that the range of 16 bits is used on both sides.
    for (const double part : {d.x - 0.5 * packing.width, d.y - 0.5 * packing.height, d.r})
      discs.push_back(steps(part, quantum));
  std::vector<std::uint8_t> jointed(packing.discs.size(), 0);
  for (const Contact& c : test.specimen.contacts)
    if (c.kind == ContactKind::joint) jointed[c.a] = jointed[c.b] = 1;
  Json bedding = Json::array();
  for (const BeddingRecipe& b : test.specimen.bedding)
    // Only even planes can be drawn from three numbers; others the page leaves out.
    if (b.is_regular() && b.layer_thickness == 0.0)
      bedding.push_back({{"theta", b.theta}, {"spacing", b.spacing}, {"offset", b.offset}});
  const Json head = {{"format", press_format},
                     {"specimen", test.specimen.name},
                     {"test", test.recipe.test.kind->name},
                     {"width [m]", packing.width},
                     {"height [m]", packing.height},
                     {"bedding", bedding},
                     {"crack_kinds", report::crack_names},
                     {"disc_quantum [m]", quantum},
                     {"discs", packed(discs)},
                     {"jointed", packed(jointed)}};
  std::string text = head.dump(-1, ' ', false, Json::error_handler_t::replace);
  text.pop_back();
  return text;
}

/// As JSON, without a detour: its texts need no quoting, and are long.
std::string cracks_text(const std::vector<CrackEvent>& cracks, double quantum) {
  std::vector<std::uint32_t> pairs;
  std::vector<std::int16_t> shapes;
  std::vector<std::uint8_t> kinds;
  for (const CrackEvent& c : cracks) {
    pairs.insert(pairs.end(), {c.a, c.b});
    shapes.insert(shapes.end(), {steps(c.normal.x, 1.0 / 32767.0), steps(c.normal.y, 1.0 / 32767.0),
                                 steps(c.size, quantum)});
    kinds.push_back(static_cast<std::uint8_t>(report::crack_kind(c)));
  }
  return R"({"pairs":")" + packed(pairs) + R"(","shapes":")" + packed(shapes) + R"(","kinds":")" +
         packed(kinds) + R"("})";
}

double displacement_quantum(const Frame& frame) {
  double largest = 0.0;
  for (const auto& u : frame.u)
    for (const float part : u)
      if (std::isfinite(part)) largest = std::max(largest, std::abs(static_cast<double>(part)));
  // Rescaled with every picture: a specimen that flies apart moves further than 16 bits of fine steps.
  return std::max(finest, largest / largest_steps);
}

}  // namespace

PressWatch::PressWatch(const std::string& folder, const PressWatchOptions& options)
    : file_((std::filesystem::path(folder) / press_file).string()), options_(options) {}

PressWatch::~PressWatch() { clear(); }

void PressWatch::clear() {
  const std::lock_guard lock(mutex_);
  shown_ = nullptr;
  std::erase_if(pressed_, [&](const auto& p) {
    return p.second.over || Clock::now() - p.second.heard >= options_.patience;
  });
  std::error_code none;
  std::filesystem::remove(file_, none);
}

bool PressWatch::shown_is_over(Clock::time_point now) const {
  if (shown_ == nullptr) return true;
  const Pressed& p = pressed_.at(shown_);
  return now - p.heard >= (p.over ? linger : options_.patience);
}

void PressWatch::choose(const RunningTest& test, Clock::time_point now) {
  // One to its end: a picture that jumps between specimens shows the breaking of none.
  if (test.over || &test.specimen == shown_ || !shown_is_over(now)) return;
  // It was kept for the moment after its end alone.
  if (shown_ != nullptr && pressed_.at(shown_).over) pressed_.erase(shown_);
  shown_ = &test.specimen;
  written_ = {};  // a new one is seen at once
}

void PressWatch::reading(const RunningTest& test) {
  // Workers on all threads report here, each its own test.
  const std::lock_guard lock(mutex_);
  const Clock::time_point now = Clock::now();
  Pressed& p = pressed_[&test.specimen];
  // It starts, or another does at this address.
  if (p.over || (!p.strain.empty() && test.strain < p.strain.back())) p = {};
  p.heard = now, p.over = test.over;
  // While the specimen settles its strain is 0 many times; one point of that is enough.
  if (test.strain > 0.0 || p.strain.empty()) p.strain.push_back(test.strain), p.stress.push_back(test.stress);
  if (p.strain.size() > most_points) keep_every_second(p.strain), keep_every_second(p.stress);
  choose(test, now);
  if (shown_ == &test.specimen && (test.over || now - written_ >= period) && may_cost(test.over))
    write(test, p);
  // Nobody looked at it, so its end need not linger; the address may be given to another specimen.
  if (test.over && shown_ != &test.specimen) pressed_.erase(&test.specimen);
}

/// Whether the last picture was no more than its share of what has been computed since. An end is worth more.
bool PressWatch::may_cost(bool over) const {
  return cost_ <= (over ? 2.0 : 1.0) * options_.most_share * static_cast<double>(std::clock() - written_at_) /
                      CLOCKS_PER_SEC;
}

void PressWatch::write(const RunningTest& test, Pressed& p) {
  const double before = system::thread_seconds();
  written_ = Clock::now();
  // Most of the file, and the same in each picture: packed once.
  if (p.head.empty()) p.head = head_of(test);
  // The expensive part, a copy out of the lanes: only made when it will be written.
  const SpecimenNow seen = test.look();
  const double quantum = displacement_quantum(seen.moved);
  std::vector<std::int16_t> moves;
  for (const auto& u : seen.moved.u)
    for (const float part : u) moves.push_back(steps(static_cast<double>(part), quantum));
  const Json curve = {{"over", p.over},
                      {"strain", p.strain},
                      {"stress [Pa]", p.stress},
                      {"displacement_quantum [m]", quantum}};
  std::string text = p.head + "," + curve.dump().substr(1);
  text.pop_back();
  text += R"(,"moves":")" + packed(moves) + R"(","cracks":)" +
          cracks_text(seen.cracks, quantum_of(*test.specimen.packing)) + "}\n";
  // Not synced to the disk, as results are: the workers wait meanwhile.
  io::write_passing(file_, text);
  // Thread time of this, process time of all: on a busy machine wall time would count others' work.
  cost_ = system::thread_seconds() - before, written_at_ = std::clock();
}

}  // namespace phy::jobs
