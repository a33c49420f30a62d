// What the page of `phyllite gui` can ask for: the folder, its rocks, checks, calibrations and tests. Every
// answer is made from the files as they are now, so that pages, terminals and editors may work side by side;
// this process alone knows only what it has started (gui/child.hpp).
//
//   GET  /                the page
//   GET  /api/project     folder, rocks, choices
//   GET  /api/rock        ?name=&calibration=: files, calibrations, tests of a rock; one calibration in full
//   GET  /api/press       ?name=&calibration=&test=: the specimen that is in the press there; null: none
//   GET  /api/results     ?name=&calibration=: figures of laboratory, calibration and tests
//   GET  /api/broken      ?name=&test=: the specimens of a test as they broke
//   GET  /api/base        ?name=: table and rock file of a measured rock of the program
//   POST /api/table       ?name=: a workbook; answers its table as text
//   POST /api/check       what `phyllite rock check` says of texts that are being typed
//   POST /api/discs       the specimen that a rock file describes
//   POST /api/moduli      E and nu of the calibrated rock at an angle
//   POST /api/save        the rock and its table
//   POST /api/calibrate   starts, goes on with, or begins afresh
//   POST /api/report      of a calibration, anew
//   POST /api/stop        a calibration, or a test
//   POST /api/recipe      a recipe for a test on the calibrated rock
//   POST /api/test        saves it and runs it
//   GET  /files/...       a file of the folder
#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "gui/child.hpp"
#include "gui/server.hpp"
#include "gui/table_check.hpp"

namespace phy::gui {

class Api {
 public:
  /// Works in the working directory. `threads` of what it starts; 0: all cores.
  /// `file_token`: by which the page names files.
  Api(int threads, std::string file_token) : threads_(threads), file_token_(std::move(file_token)) {}
  /// From any thread.
  Response answer(const Request& request);
  /// Folders in which something writes that was started here.
  std::vector<std::string> running();
  /// Asks all of it to end, and waits.
  void end();

 private:
  /// What works in a folder.
  struct Work {
    int process = 0;  ///< started here or elsewhere, as jobs::working_in()
    bool here = false;
    int exit_code = -1;  ///< of what was started here and runs no more
  };
  /// What calibration.json says in short, as long as it stays the same.
  struct Brief {
    std::array<std::uint64_t, 4> identity;  ///< of the file
    std::shared_ptr<const Json> json;
  };
  int threads_;
  std::string file_token_;
  std::mutex changes_;  // one at a time
  std::mutex mutex_;    // of the following; while it is held, no file is read and nobody waited for
  std::map<std::string, std::unique_ptr<Child>> children_;  // by the folder of the results
  std::map<std::string, Ending> others_;                    // of what was not started here
  std::map<std::string, Brief> briefs_;                     // by folder

  Response route(const Request& request);
  Response read(const Request& request);
  Response changed(const Request& request);
  Json project();
  Json rock(const std::string& name, const std::string& chosen);
  Json calibration(const std::string& name, const std::string& folder);
  Json brief(const std::string& folder);
  Json result_in_brief(const std::string& folder);
  std::string state_of_calibration(const std::string& folder);
  Json test(const std::string& rock, const std::string& name);
  Json save(const Json& asked);
  Json calibrate(const Json& asked);
  Json report(const Json& asked);
  Json stop(const Json& asked);
  Json run_test(const Json& asked);
  Response saved(const Json& asked);
  Json start(const std::vector<std::string>& words, const std::string& folder);
  Work work_in(const std::string& folder);
  void check_started(const std::string& folder, const std::string& log);
};

}  // namespace phy::gui
