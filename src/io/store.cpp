#include "io/store.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "base/check.hpp"
#include "base/exact_math.hpp"
#include "base/units.hpp"
#include "io/toml_in.hpp"
#include "io/vtk.hpp"
#include "laws/laws.hpp"

namespace phy {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

[[noreturn]] void fail(const std::string& path, const std::string& doing, int error) {
  std::string remedy;
  if (error == ENOSPC || error == EDQUOT) remedy = "; free some space, or choose another folder with --out";
  if (error == EACCES || error == EROFS || error == EPERM)
    remedy = "; choose a folder you may write to with --out";
  if (error == EEXIST || error == ENOTDIR)
    remedy = "; a file of that name is in the way: move it, or use another --out";
  throw IoError(path + ": cannot " + doing + ": " + std::strerror(error) + remedy);
}

/// Writes, syncs and closes; removes what was written when anything fails.
void write_synced(const fs::path& path, const std::string& content) {
  const int fd = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (fd < 0) fail(path.string(), "be written", errno);
  std::size_t done = 0;
  int error = 0;
  while (done < content.size() && error == 0) {
    const ssize_t n = ::write(fd, content.data() + done, content.size() - done);
    if (n >= 0)
      done += static_cast<std::size_t>(n);
    else if (errno != EINTR)
      error = errno;
  }
  if (error == 0 && ::fsync(fd) != 0) error = errno;
  if (::close(fd) != 0 && error == 0) error = errno;
  if (error == 0) return;
  ::unlink(path.c_str());
  fail(path.string(), "be written", error);
}

void make_folder(const fs::path& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) fail(path.string(), "be created", error.value());
  if (!fs::is_directory(path)) fail(path.string(), "be used as a folder", ENOTDIR);
}

Json number_or_null(double v) { return std::isfinite(v) ? Json(v) : Json(nullptr); }

Json packing_json(const Packing& p) {
  const PackingReport& r = p.report;
  return {{"hash", p.hash},
          {"n_grains", p.discs.size()},
          {"porosity", r.porosity},
          {"coordination", r.coordination},
          {"fabric", r.fabric},
          {"stress_left [Pa]", r.stress_left},
          {"n_floaters", r.n_floaters},
          {"mean_overlap", r.mean_overlap},
          {"unbalanced", r.unbalanced},
          {"stress_free", p.stress_free}};
}

std::string result_json(const Recipe& recipe, const std::string& version, const Specimen& specimen,
                        const TestResult& result) {
  Json j;
  j["format"] = result_format;
  j["program"] = "phyllite " + version;
  j["specimen"] = result.name;
  if (!result.intact) j["theta [deg]"] = result.theta;
  j["outcome"] = {{"status", to_string(result.outcome.status)},
                  {"reason", result.outcome.reason},
                  {"advice", result.outcome.advice}};
  for (const Number& n : result.numbers) {
    Json entry = {{"value", number_or_null(n.value)}, {"unit", n.unit}, {"definition", n.definition}};
    if (!n.note.empty()) entry["note"] = n.note;
    j["numbers"][n.name] = entry;
  }
  j["packing"] = packing_json(*specimen.packing);
  j["bedding"] = Json::array();
  for (std::size_t i = 0; i < specimen.bedding.size(); ++i) {
    const BeddingReport& b = specimen.bedding_report[i];
    j["bedding"].push_back({{"theta [deg]", specimen.bedding[i].theta},
                            {"overlap_ratio", b.overlap_ratio},
                            {"bridge_fraction", b.bridge_fraction},
                            {"non_crossing_fraction", b.non_crossing_fraction}});
  }
  j["run"] = {{"dt [s]", result.dt},
              {"n_steps", result.n_steps},
              {"n_contacts", result.n_contacts},
              {"n_cracks", result.cracks.size()},
              {"cpu_seconds", result.seconds},
              {"platen_speed [m/s]", recipe.test.platen_speed}};
  j["result_hash"] = result.hash;
  j["recipe"] = write_recipe(recipe);
  return j.dump(1) + "\n";
}

std::string history_csv(const History& history) {
  std::string text;
  for (const HistoryColumn& c : history_columns())
    text += (text.empty() ? "" : ",") + std::string(c.name) + " [" + c.unit + "]";
  text += "\n";
  for (const HistoryRow& row : history.rows) {
    bool first = true;
    for (const HistoryColumn& c : history_columns()) {
      text += (first ? "" : ",") + print_number(row.*c.value);
      first = false;
    }
    text += "\n";
  }
  return text;
}

std::string cracks_csv(const std::vector<CrackEvent>& cracks) {
  std::string text =
      "step [1],time [s],axial_strain [1],grain_a,grain_b,mode,place,x [m],y [m],normal_x,normal_y,size "
      "[m],energy [J/m]\n";
  for (const CrackEvent& c : cracks) {
    text += std::to_string(c.step) + "," + print_number(c.time) + "," + print_number(c.strain) + "," +
            std::to_string(c.a) + "," + std::to_string(c.b) + "," +
            (c.mode == CrackMode::tension ? "tension" : "shear") + "," +
            (c.place == CrackPlace::matrix ? "matrix" : "bedding");
    for (const double v : {c.position.x, c.position.y, c.normal.x, c.normal.y, c.size, c.energy})
      text += "," + print_number(v);
    text += "\n";
  }
  return text;
}

void write_snapshots(const fs::path& folder, const Packing& packing, const TestResult& result) {
  make_folder(folder / "snapshots");
  std::vector<std::pair<double, std::string>> grains, contacts;
  for (std::size_t i = 0; i < result.snapshots.size(); ++i) {
    const Snapshot& shot = result.snapshots[i];
    const std::string n = std::to_string(i);
    grains.emplace_back(shot.axial_strain, "snapshots/grains_" + n + ".vtp");
    contacts.emplace_back(shot.axial_strain, "snapshots/contacts_" + n + ".vtp");
    write_synced(folder / grains.back().second, grains_vtp(packing, shot));
    write_synced(folder / contacts.back().second, contacts_vtp(packing, shot));
  }
  write_synced(folder / "snapshots/cracks.vtp", cracks_vtp(result.cracks));
  write_synced(folder / "grains.pvd", collection_pvd(grains));
  write_synced(folder / "contacts.pvd", collection_pvd(contacts));
}

}  // namespace

void check_writable(const std::string& folder) {
  make_folder(folder);
  const fs::path probe = fs::path(folder) / (".write-test-" + std::to_string(::getpid()));
  write_synced(probe, "phyllite\n");
  ::unlink(probe.c_str());
}

void write_file(const std::string& path, const std::string& content) {
  const std::string temporary = path + ".part-" + std::to_string(::getpid());
  write_synced(temporary, content);
  if (std::rename(temporary.c_str(), path.c_str()) != 0) {
    const int error = errno;
    ::unlink(temporary.c_str());
    fail(path, "be replaced", error);
  }
}

void write_result(const std::string& folder, const Recipe& recipe, const std::string& version,
                  const Specimen& specimen, const TestResult& result) {
  const fs::path place(folder);
  if (place.has_parent_path()) make_folder(place.parent_path());
  const fs::path part = folder + ".part-" + std::to_string(::getpid());
  const fs::path old = folder + ".old-" + std::to_string(::getpid());
  std::error_code ignored;
  fs::remove_all(part, ignored);
  try {
    make_folder(part);
    write_synced(part / "recipe.toml", write_recipe(recipe));
    write_synced(part / "history.csv", history_csv(result.history));
    write_synced(part / "cracks.csv", cracks_csv(result.cracks));
    write_snapshots(part, *specimen.packing, result);
    write_synced(part / "result.json", result_json(recipe, version, specimen, result));
    std::error_code error;
    if (fs::exists(place)) fs::rename(place, old, error);
    if (!error) fs::rename(part, place, error);
    if (error) fail(folder, "be replaced", error.value());
  } catch (...) {
    fs::remove_all(part, ignored);
    if (!fs::exists(place, ignored) && fs::exists(old, ignored)) fs::rename(old, place, ignored);
    throw;
  }
  fs::remove_all(old, ignored);
}

std::string discs_csv(const Packing& packing) {
  std::string text = "# width [m] = " + print_number(packing.width) +
                     ", height [m] = " + print_number(packing.height) + "\nx [m],y [m],r [m]\n";
  for (const Disc& d : packing.discs)
    text += print_number(d.x) + "," + print_number(d.y) + "," + print_number(d.r) + "\n";
  return text;
}

std::vector<Disc> read_discs(const std::string& path) {
  std::ifstream in(path);
  if (!in) throw IoError(path + ": cannot be read; check the name and the permissions");
  std::vector<Disc> discs;
  std::vector<Problem> problems;
  std::string line;
  bool header = true;
  for (int number = 1; std::getline(in, line); ++number) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (line.empty() || line[0] == '#') continue;
    const std::string where = path + ":" + std::to_string(number);
    if (header) {
      header = false;
      if (line != "x [m],y [m],r [m]")
        throw InputError(
            Problem{where, "header", line, "x [m],y [m],r [m]", "name the columns so, in this order"});
      continue;
    }
    double v[3] = {};
    const char* p = line.data();
    const char* end = p + line.size();
    bool ok = true;
    for (int i = 0; i < 3 && ok; ++i) {
      const auto [next, error] = std::from_chars(p, end, v[i]);
      ok =
          error == std::errc() && std::isfinite(v[i]) && (i == 2 ? next == end : next != end && *next == ',');
      p = next + 1;
    }
    if (!ok || !(v[2] > 0.0)) problems.push_back({where, "disc", line, "three numbers x,y,r with r > 0", ""});
    discs.push_back({v[0], v[1], v[2]});
  }
  if (problems.size() > 20) {
    const std::size_t more = problems.size() - 20;
    problems.resize(20);
    problems.push_back({path, "", "", "", std::to_string(more) + " more bad lines"});
  }
  if (!problems.empty()) throw InputError(std::move(problems));
  return discs;
}

std::string contacts_csv(const Specimen& s) {
  std::string text =
      "grain_a,grain_b,kind,set,normal_x,normal_y,gap [m],k_n [N/m per m],k_s [N/m per m],sigma_c [Pa],tau_c "
      "[Pa]\n";
  const bool pfc5 = s.matrix.stiffness_convention == StiffnessConvention::pfc5;
  for (const Contact& c : s.contacts) {
    const Disc &a = s.packing->discs[c.a], &b = s.packing->discs[c.b];
    const Vec2 d{b.x - a.x, b.y - a.y};
    const double distance = norm(d);
    Vec2 n = (1.0 / distance) * d;
    double k_n = s.matrix.E_c * linear::stiffness_factor(pfc5, a.r, b.r), k_s = s.matrix.ks_over_kn * k_n;
    const char* kind = "touching";
    if (c.kind == ContactKind::bonded) {
      const auto g = parallel_bond::geometry(s.matrix.radius_multiplier, a.r, b.r);
      k_n += s.matrix.E_b / g.L * g.A, k_s += s.matrix.bond_ks_over_kn * s.matrix.E_b / g.L * g.A;
      kind = "bonded";
    } else if (c.kind == ContactKind::joint) {
      const BeddingRecipe& set = s.bedding[c.set];
      const SinCos sc = sin_cos_degrees(set.theta);
      const double A = smooth_joint::area(set.radius_multiplier, a.r, b.r);
      k_n = set.k_n * A, k_s = set.k_s * A;
      n = static_cast<double>(c.side) * Vec2{-sc.sin, sc.cos};
      kind = "joint";
    }
    text += std::to_string(c.a) + "," + std::to_string(c.b) + "," + kind + "," + std::to_string(c.set);
    for (const double v : {n.x, n.y, distance - a.r - b.r, k_n, k_s, c.sigma_c, c.tau_c})
      text += "," + print_number(v);
    text += "\n";
  }
  return text;
}

}  // namespace phy
