// Readers of several files that name each other, and of stores.
#include <zip.h>

#include <algorithm>
#include <map>

#include "contract.hpp"
#include "io/load.hpp"
#include "io/load_variation.hpp"
#include "io/regressions.hpp"
#include "io/scene.hpp"
#include "io/store.hpp"
#include "io/workbook.hpp"
#include "rock/file.hpp"
#include "rock/table.hpp"
#include "study/store.hpp"
#include "study/study_in.hpp"

namespace phy::fuzz {
namespace {

std::string archive_of(const Files& files, const std::map<std::string, std::string>& places) {
  const std::string path = files.at("archive");
  zip_t* zip = zip_open(path.c_str(), ZIP_CREATE | ZIP_TRUNCATE, nullptr);
  for (const auto& [name, place] : places) {
    if (files.read(name).empty()) continue;
    zip_source_t* source = zip_source_file(zip, files.at(name).c_str(), 0, -1);
    const zip_int64_t at = zip_file_add(zip, place.c_str(), source, ZIP_FL_OVERWRITE);
    zip_set_file_compression(zip, static_cast<zip_uint64_t>(at), ZIP_CM_STORE, 0);
  }
  zip_close(zip);
  return files.read("archive");
}

}  // namespace

/// An archive as it is, or the files of one that is put together here without compression, so that changed
/// bytes are read and not refused by its checksums.
bool read_workbook(std::string_view bytes) {
  const std::map<std::string, std::string> places = {{"sheet", "xl/worksheets/sheet1.xml"},
                                                     {"workbook", "xl/workbook.xml"},
                                                     {"links", "xl/_rels/workbook.xml.rels"},
                                                     {"texts", "xl/sharedStrings.xml"},
                                                     {"styles", "xl/styles.xml"}};
  std::string archive(bytes);
  if (!io::is_archive(bytes)) {
    std::vector<std::string> names;
    for (const auto& [name, place] : places) names.push_back(name);
    const Files files(bytes, names);
    archive = archive_of(files, places);
  }
  const io::Table table = io::parse_workbook(archive, "", "t.xlsx");
  for (const io::TableRow& row : table.rows)
    if (row.cells.size() != table.header.size()) throw Finding("a row that is not as long as the header");
  if (table.problems.empty() && table.rows.empty()) throw Finding("no row, and no problem");
  std::vector<Problem> problems;
  std::vector<std::string> notes;
  rock::parse_readings(archive, "t.xlsx", {}, problems, notes);
  return table.problems.empty();
}

bool read_rock(std::string_view bytes) {
  const Files files(bytes, {"rock.toml", "table.csv", "model.toml"});
  return accepts([&] { rock::read_rock(files.at("rock.toml")); });
}

/// The files that a study leaves in its folder are that study again.
bool read_study(std::string_view bytes) {
  const Files files(bytes, {"study.toml", "recipe.toml", "points.csv", "lines.toml"});
  return accepts([&] {
    const auto written = study::study_files(study::read_study(files.at("study.toml")));
    for (const auto& [name, content] : written) files.write(name, content);
    const auto again = study::study_files(study::read_study(files.at("study.toml")));
    if (again.size() != written.size()) throw Finding("read again it has other files");
    for (std::size_t i = 0; i < written.size(); ++i) same(written[i].second, again[i].second);
  });
}

bool read_regressions(std::string_view bytes) {
  const Files files(bytes, {"lines.toml"});
  return accepts([&] {
    const std::string text = io::write_regressions(io::read_regressions(files.at("lines.toml")));
    files.write("lines.toml", text);
    same(text, io::write_regressions(io::read_regressions(files.at("lines.toml"))));
  });
}

/// A result folder: what is read of result.json is written as another one, and read again.
bool read_result(std::string_view bytes) {
  const Files files(bytes, {"result.json", "history.csv", "cracks.csv", ".written-by-phyllite", "scene.bin"});
  return accepts([&] {
    const RunRecord run = io::read_run(files.folder());
    const std::string text = io::result_json(run.tests.front());
    files.write(".written-by-phyllite", "");
    files.write("result.json", text);
    same(text, io::result_json(io::read_run(files.folder()).tests.front()));
  });
}

bool read_variation(std::string_view bytes) {
  const Files files(bytes, {"results.csv", "recipe.toml", "study.toml", "regressions.toml"});
  return accepts([&] { io::read_variation(files.folder()); });
}

bool read_store(std::string_view bytes) {
  const Files files("", {"none"});
  files.write("study.sqlite", bytes);
  return accepts([&] {
    const study::Store store(files.at("study.sqlite"));
    store.n_claimed();
    for (const study::StoredResult& row : store.rows()) store.find(row.key);
  });
}

}  // namespace phy::fuzz
