#include "genesis/cache.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <sstream>
#include <string_view>

#include "base/check.hpp"
#include "base/hash.hpp"
#include "genesis/packing.hpp"
#include "io/csv.hpp"
#include "io/file.hpp"
#include "records/recipe_schema.hpp"
#include "system/process.hpp"

namespace phy::genesis {
namespace {

constexpr const char* first_line = "phyllite packing, format 1";
constexpr std::size_t largest_entry = 128 * max_recipe_grains;  // bytes: three numbers a line
constexpr std::string_view last_line = "end ";                  // and the fingerprint of all text before it

/// Hexadecimal and exact, the same in every locale.
std::string hex(double x) {
  std::array<char, 40> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), x, std::chars_format::hex).ptr;
  return {text.data(), end};
}

bool read_hex(std::istream& in, double& x) {
  std::string word;
  if (!(in >> word)) return false;
  const char* end = word.data() + word.size();
  const auto r = std::from_chars(word.data(), end, x, std::chars_format::hex);
  return r.ec == std::errc{} && r.ptr == end;
}

std::array<double*, 6> numbers_of(PackingReport& r) {
  return {&r.porosity, &r.coordination, &r.fabric, &r.stress_left, &r.mean_overlap, &r.unbalanced};
}

std::string fingerprint(std::string_view text) {
  Hash h;
  h.add(text);
  return h.text();
}

/// True if nothing was lost or changed since to_text.
bool is_whole(std::string_view text) {
  const std::size_t end = text.rfind(last_line);
  if (end == text.npos) return false;
  // A disk that was full, or a process killed: half a packing would be another rock.
  return text.substr(end) == std::string(last_line) + fingerprint(text.substr(0, end)) + "\n";
}

std::string to_text(const std::string& key, const Packing& p) {
  std::string text = std::string(first_line) + "\n" + key + "\n";
  text += hex(p.width) + " " + hex(p.height) + " " + (p.stress_free ? "1" : "0") + " " + p.hash + "\n";
  PackingReport report = p.report;
  // Hexadecimal: decimal digits would have to be read back to the same bits.
  for (const double* number : numbers_of(report)) text += hex(*number) + " ";
  text += std::to_string(report.n_rattlers) + "\n" + std::to_string(p.discs.size()) + "\n";
  for (const Disc& d : p.discs) text += hex(d.x) + " " + hex(d.y) + " " + hex(d.r) + "\n";
  return text + std::string(last_line) + fingerprint(text) + "\n";
}

/// A checksum says that a file is as it was written, not that a packing was written.
bool is_packing(const Packing& p) {
  const auto is_disc = [](const Disc& d) { return std::isfinite(d.x + d.y + d.r) && d.r > 0.0; };
  return std::isfinite(p.width + p.height) && p.width > 0.0 && p.height > 0.0 && !p.discs.empty() &&
         std::all_of(p.discs.begin(), p.discs.end(), is_disc) && packing_hash(p.discs) == p.hash;
}

std::optional<Packing> from_text(const std::string& text, const std::string& key) {
  if (!is_whole(text)) return {};
  std::istringstream in(text);
  std::string line;
  if (!std::getline(in, line) || line != first_line) return {};
  // Names of files are hashes of keys: two keys could share one.
  if (!std::getline(in, line) || line != key) return {};
  Packing p;
  if (!read_hex(in, p.width) || !read_hex(in, p.height) || !(in >> p.stress_free >> p.hash)) return {};
  for (double* number : numbers_of(p.report))
    if (!read_hex(in, *number)) return {};
  std::size_t n = 0;
  // A damaged number must not ask for all memory.
  if (!(in >> p.report.n_rattlers >> n) || n > text.size()) return {};
  p.discs.resize(n);
  for (Disc& d : p.discs)
    if (!read_hex(in, d.x) || !read_hex(in, d.y) || !read_hex(in, d.r)) return {};
  if (!is_packing(p)) return {};
  return p;
}

}  // namespace

std::filesystem::path default_cache_folder() {
  const std::filesystem::path folder = system::cache_folder();
  return folder.empty() ? folder : folder / "phyllite";
}

std::string packing_key(const SpecimenSize& size, const PackingRecipe& r, const MatrixRecipe& matrix) {
  std::string key = "generation=" + std::to_string(packing_generation);
  const auto add = [&](const char* name, const std::string& value) {
    key += std::string(" ") + name + "=" + value;
  };
  add("width", hex(size.width));
  add("height", hex(size.height));
  add("radius_min", hex(r.radius_min));
  add("radius_max", hex(r.radius_max));
  add("distribution", r.distribution == RadiusDistribution::by_number ? "by_number" : "by_area");
  if (r.n_grains > 0)
    add("n_grains", std::to_string(r.n_grains));
  else
    add("porosity", hex(r.porosity));
  add("seed", std::to_string(r.seed));
  if (r.initial_stress == InitialStress::isotropic) {
    add("isotropic_stress", hex(r.isotropic_stress));
    add("E_c", hex(matrix.E_c));
    add("stiffness", matrix.stiffness_convention == StiffnessConvention::pfc31 ? "pfc31" : "pfc5");
  }
  return key;
}

std::filesystem::path cache_file(const std::filesystem::path& folder, const std::string& key) {
  return folder / ("packing-" + fingerprint(key) + ".txt");
}

bool is_cached(const Recipe& r, const std::filesystem::path& folder) {
  std::error_code unreadable;
  return r.packing.file.empty() && !folder.empty() &&
         std::filesystem::is_regular_file(cache_file(folder, packing_key(r.specimen, r.packing, r.matrix)),
                                          unreadable);
}

std::shared_ptr<const Packing> cached_packing(const SpecimenSize& size, const PackingRecipe& recipe,
                                              const MatrixRecipe& matrix, const std::filesystem::path& folder,
                                              const std::function<bool()>& stop) {
  if (folder.empty()) return std::make_shared<Packing>(make_packing(size, recipe, matrix, stop));
  const std::string key = packing_key(size, recipe, matrix);
  const std::filesystem::path file = cache_file(folder, key);
  if (const auto text = io::read_if_file(file.string(), largest_entry))
    if (std::optional<Packing> p = from_text(*text, key)) return std::make_shared<Packing>(std::move(*p));
  auto packing = std::make_shared<Packing>(make_packing(size, recipe, matrix, stop));
  io::remove_leftovers(folder.string());  // a process may have been killed as it wrote this very packing
  try {
    io::write_file(file.string(), to_text(key, *packing));
  } catch (const IoError&) {  // made anew next time
  }
  return packing;
}

std::shared_ptr<const Packing> packing_of(const Recipe& r, const std::filesystem::path& folder,
                                          const std::function<bool()>& stop) {
  if (r.packing.file.empty()) return cached_packing(r.specimen, r.packing, r.matrix, folder, stop);
  return std::make_shared<const Packing>(
      adopt_packing(r.specimen, r.packing, r.matrix, io::read_discs(r.packing.file)));
}

}  // namespace phy::genesis
