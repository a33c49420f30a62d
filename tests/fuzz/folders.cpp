// Readers of several files that name each other, and of stores.
#include <algorithm>

#include "contract.hpp"
#include "io/load.hpp"
#include "io/load_variation.hpp"
#include "io/regressions.hpp"
#include "io/rock_in.hpp"
#include "io/scene.hpp"
#include "io/store.hpp"
#include "study/store.hpp"
#include "study/study_in.hpp"

namespace phy::fuzz {

bool read_rock(std::string_view bytes) {
  const Files files(bytes, {"rock.toml", "table.csv", "model.toml"});
  return accepts([&] { io::read_rock(files.at("rock.toml")); });
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
