#include "io/scene.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/check.hpp"
#include "base/largest_file.hpp"
#include "io/deflate.hpp"
#include "io/json.hpp"
#include "records/test_description.hpp"

namespace phy::io {
namespace {

using Json = nlohmann::ordered_json;
using Numbers = std::vector<std::int32_t>;

constexpr int scene_format = 1;
constexpr double finest = 0.25e-6;       // [m]: far below a grain, also when drawn twenty times enlarged
constexpr double largest_steps = 32000;  // displacements stay within 16 bits
constexpr double most_steps = 32001;     // with rounding
constexpr double size_steps = 65000;
constexpr double force_steps = 127;
constexpr double farthest = 10.0;  // displacement over the larger side: beyond it a test has blown up

/// Maps small numbers of either sign to small unsigned ones, so that the upper bytes are zero.
std::uint32_t zigzag(std::int32_t v) {
  return (static_cast<std::uint32_t>(v) << 1U) ^ static_cast<std::uint32_t>(v >> 31);
}
std::int32_t unzigzag(std::uint32_t v) { return static_cast<std::int32_t>((v >> 1U) ^ (~(v & 1U) + 1U)); }

/// Appends sections of numbers as byte planes and lists them as [count, planes].
struct SectionWriter {
  std::string bytes;
  std::int64_t n_lost = 0;  // displacements and forces that no picture can show
  Json sections = Json::array();
  void add(const Numbers& numbers) {
    // As many byte planes as the largest number needs: planes of zeros cost little once packed, but memory
    // when read.
    std::uint32_t all = 0;
    for (const std::int32_t v : numbers) all |= zigzag(v);
    const int planes = all < 1U << 8U ? 1 : all < 1U << 16U ? 2 : all < 1U << 24U ? 3 : 4;
    for (int p = 0; p < planes; ++p)
      for (const std::int32_t v : numbers)
        bytes += static_cast<char>(static_cast<unsigned char>(zigzag(v) >> (8U * static_cast<unsigned>(p))));
    sections.push_back({numbers.size(), planes});
  }
};

struct SectionReader {
  const std::string& bytes;
  const Json& sections;
  std::size_t at = 0, section = 0;
  Numbers next(std::size_t count) {
    const auto size = whole_number<std::size_t>(sections.at(section).at(0));
    const auto planes = whole_number<std::size_t>(sections.at(section).at(1));
    ++section;
    // Checked before anything is read: the file may be damaged.
    if (size != count || planes < 1 || planes > 4 || size > (bytes.size() - at) / planes)
      throw std::out_of_range("sections do not fit");
    Numbers numbers(count);
    for (std::size_t i = 0; i < count; ++i) {
      std::uint32_t v = 0;
      for (std::size_t p = 0; p < planes; ++p)
        v |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[at + p * size + i])) << (8U * p);
      numbers[i] = unzigzag(v);
    }
    at += size * planes;
    return numbers;
  }
};

std::int32_t steps(double value, double quantum) {
  return static_cast<std::int32_t>(std::lround(value / quantum));
}

void add_discs(SectionWriter& w, const Scene& scene, double quantum) {
  for (double Disc::*part : {&Disc::x, &Disc::y, &Disc::r}) {
    Numbers numbers;
    for (const Disc& d : scene.discs) numbers.push_back(steps(d.*part, quantum));
    w.add(numbers);
  }
}

/// Of a test that has blown up displacements may be no numbers, or too large to leave room for the others.
bool is_shown(const Scene& scene, float u) {
  return std::abs(static_cast<double>(u)) <= farthest * std::max(scene.width, scene.height);  // not so NaN
}

/// Second differences over the frames, all x then all y. What is lost stays where it was in the frame before.
void add_frames(SectionWriter& w, const Scene& scene, double quantum) {
  const std::size_t n = scene.discs.size();
  Numbers before(2 * n, 0), change(2 * n, 0);
  for (const Frame& frame : scene.frames) {
    PHY_CHECK(frame.u.size() == n, "a displacement for every disc");
    Numbers second(2 * n);
    for (std::size_t i = 0; i < 2 * n; ++i) {
      const float u = frame.u[i % n][i / n];
      const bool shown = is_shown(scene, u);
      // Lost values repeat the frame before, with a change of zero.
      w.n_lost += shown ? 0 : 1;
      const std::int32_t now = shown ? steps(static_cast<double>(u), quantum) : before[i];
      // Second difference: what remains after assuming that the grain goes on as between the two frames
      // before.
      second[i] = now - before[i] - change[i];
      change[i] = now - before[i];
      before[i] = now;
    }
    w.add(second);
  }
}

void add_links(SectionWriter& w, const std::vector<SceneLink>& links) {
  Numbers a, b, kind;
  std::uint32_t last = 0;
  for (const SceneLink& l : links) {
    // Differences in place of grain numbers: small where links are sorted, so most byte planes are zero.
    a.push_back(static_cast<std::int32_t>(l.a - last));
    b.push_back(static_cast<std::int32_t>(l.b - l.a));
    kind.push_back(static_cast<std::int32_t>(l.kind));
    last = l.a;
  }
  w.add(a), w.add(b), w.add(kind);
}

double largest_of(const std::vector<float>& values) {
  double largest = 0.0;
  for (const float v : values)
    if (std::isfinite(v)) largest = std::max(largest, std::abs(static_cast<double>(v)));
  return largest;
}

void add_forces(SectionWriter& w, const ForceField& field) {
  const double largest = largest_of(field.F_n);
  Numbers numbers;
  for (const float f : field.F_n) {
    const bool shown = std::isfinite(f);
    w.n_lost += shown ? 0 : 1;
    // The square root gives small forces more of the 127 steps: chains are seen as well as the largest
    // forces.
    const double part = shown && largest > 0.0 ? std::sqrt(std::abs(static_cast<double>(f)) / largest) : 0.0;
    numbers.push_back(static_cast<std::int32_t>(std::lround(std::copysign(force_steps * part, f))));
  }
  w.add(numbers);
}

double displacement_quantum(const Scene& scene) {
  double largest = 0.0;
  for (const Frame& frame : scene.frames)
    for (const auto& u : frame.u)
      for (const float part : u)
        if (is_shown(scene, part)) largest = std::max(largest, std::abs(static_cast<double>(part)));
  // Quarter micrometres, or coarser where the largest displacement would not fit into 16 bits.
  return std::max(finest, largest / largest_steps);
}

/// A strain stands under its bare name, whatever the test; a displacement with its unit.
std::string loading_key(TestKind kind) {
  return kind->loads_by_strain() ? "axial_strain" : heading(kind->loading_column());
}
/// Of the stress.
std::string stress_key(TestKind kind) {
  return kind->loads_by_strain() ? "axial_stress [Pa]" : heading(kind->stress_column());
}

template <class Moment>
Json moment_json(const Moment& m, TestKind kind) {
  return {{"step", m.step}, {loading_key(kind), m.axial_strain}, {stress_key(kind), m.axial_stress}};
}

template <class Moment>
void read_moment(const Json& j, Moment& m) {
  j.at("step").get_to(m.step);
  TestKind kind;
  for (const TestDescription* test : laboratory_tests())
    // The key of the loading names the kind of test.
    if (j.contains(loading_key(*test))) kind = *test;
  j.at(loading_key(kind)).get_to(m.axial_strain);
  j.at(stress_key(kind)).get_to(m.axial_stress);
}

/// Of damaged bytes and headers come numbers that the writer never makes; what follows reckons with its own.
double within(double value, double largest) {
  if (!(std::abs(value) <= largest)) throw std::out_of_range("a number beyond the scene");
  return value;
}
float to_float(double value) {
  return static_cast<float>(within(value, static_cast<double>(std::numeric_limits<float>::max())));
}
double side_in(const Json& head, const char* key) {
  constexpr double largest_side = 1e6;
  const double side = head.at(key).get<double>();
  if (!(side > 0.0)) throw std::out_of_range("no size");
  return within(side, largest_side);
}

void read_frames(SectionReader& r, Scene& scene, double quantum) {
  const std::size_t n = scene.discs.size();
  std::vector<std::int64_t> now(2 * n, 0), change(2 * n, 0);
  for (Frame& frame : scene.frames) {
    const Numbers second = r.next(2 * n);
    frame.u.resize(n);
    for (std::size_t i = 0; i < 2 * n; ++i) {
      change[i] += second[i];
      now[i] += change[i];
      frame.u[i % n][i / n] = to_float(within(static_cast<double>(now[i]), most_steps) * quantum);
    }
  }
}

void read_links(SectionReader& r, std::vector<SceneLink>& links, std::size_t n_discs) {
  const Numbers a = r.next(links.size()), b = r.next(links.size()), kind = r.next(links.size());
  std::uint32_t last = 0;
  for (std::size_t i = 0; i < links.size(); ++i) {
    last += static_cast<std::uint32_t>(a[i]);
    links[i] = {last, last + static_cast<std::uint32_t>(b[i]), static_cast<ContactKind>(kind[i])};
    // A number outside would be used as an index by the page.
    if (links[i].a >= n_discs || links[i].b >= n_discs || kind[i] < 0 ||
        kind[i] > static_cast<int>(ContactKind::joint))
      throw std::out_of_range("a link to a disc that is not there, or of no kind");
  }
}

/// The stream behind the header, which says how long it is.
std::string plain_stream(std::string_view compressed, const Json& head) {
  const auto size = whole_number<std::size_t>(head.at("size"));
  // The size in the header bounds what is unpacked: a few bytes can unpack to gigabytes.
  if (size > largest_file) throw std::out_of_range("more than 1 GiB");
  const std::optional<std::string> plain = inflated(compressed, size);
  if (!plain || plain->size() != size) throw std::out_of_range("the compressed part is damaged");
  // Every disc and link has three bytes at least: what the header says is held against that before it is made
  // room.
  for (const char* count : {"n_discs", "n_links"})
    if (whole_number<std::size_t>(head.at(count)) > size / 3)
      throw std::out_of_range(std::string(count) + " beyond the stream");
  return *plain;
}

Scene read_scene(std::string_view bytes) {
  const std::size_t end = bytes.find('\n');
  if (end == bytes.npos) throw std::out_of_range("no header");
  const Json head = parse_json<Json>(bytes.substr(0, end));
  if (head.at("format") != scene_format) throw std::out_of_range("another version of the format");
  const std::string plain = plain_stream(bytes.substr(end + 1), head);
  SectionReader r{plain, head.at("sections")};
  Scene scene;
  scene.width = side_in(head, "width [m]"), scene.height = side_in(head, "height [m]");
  scene.discs.resize(head.at("n_discs").get<std::size_t>());
  for (double Disc::*part : {&Disc::x, &Disc::y, &Disc::r}) {
    const Numbers numbers = r.next(scene.discs.size());
    for (std::size_t i = 0; i < numbers.size(); ++i)
      scene.discs[i].*part = within(numbers[i] * head.at("disc_quantum [m]").get<double>(),
                                    farthest * std::max(scene.width, scene.height));
  }
  scene.frames.resize(head.at("frames").size());
  for (std::size_t i = 0; i < scene.frames.size(); ++i) read_moment(head.at("frames")[i], scene.frames[i]);
  read_frames(r, scene, head.at("displacement_quantum [m]").get<double>());
  scene.links.resize(head.at("n_links").get<std::size_t>());
  read_links(r, scene.links, scene.discs.size());
  for (const Json& j : head.at("forces")) {
    ForceField field;
    read_moment(j, field);
    const double largest = j.at("F_max [N/m]").get<double>();
    for (const std::int32_t v : r.next(scene.links.size()))
      // Inverse of the square root, with its sign.
      field.F_n.push_back(
          to_float(within(v, force_steps) * std::abs(v) * largest / (force_steps * force_steps)));
    scene.forces.push_back(std::move(field));
  }
  return scene;
}

}  // namespace

std::string pack_scene(const Scene& scene, TestKind kind) {
  // A scene without a size would divide by zero.
  const double size_quantum = std::max({scene.width, scene.height, 1e-9}) / size_steps;
  const double quantum = displacement_quantum(scene);
  SectionWriter w;
  add_discs(w, scene, size_quantum);
  add_frames(w, scene, quantum);
  add_links(w, scene.links);
  Json frames = Json::array(), forces = Json::array();
  for (const Frame& frame : scene.frames) frames.push_back(moment_json(frame, kind));
  for (const ForceField& field : scene.forces) {
    add_forces(w, field);
    forces.push_back(moment_json(field, kind));
    forces.back()["F_max [N/m]"] = largest_of(field.F_n);
  }
  Json head = {{"format", scene_format},
               {"width [m]", scene.width},
               {"height [m]", scene.height},
               {"n_discs", scene.discs.size()},
               {"n_links", scene.links.size()},
               {"disc_quantum [m]", size_quantum},
               {"displacement_quantum [m]", quantum},
               {"frames", frames},
               {"forces", forces},
               {"sections", w.sections},
               {"size", w.bytes.size()}};
  // Only where something is missing, so that other scenes keep their bytes.
  if (w.n_lost > 0) head["lost"] = w.n_lost;
  return head.dump() + "\n" + deflated(w.bytes);
}

Scene unpack_scene(std::string_view bytes, const std::string& where) {
  try {
    return read_scene(bytes);
  } catch (const std::exception& e) {
    // Any failure while reading means that this is not a scene of ours.
    throw InputError(Problem{where, "", "", "a scene that this program wrote", in_words(e)});
  }
}

}  // namespace phy::io
