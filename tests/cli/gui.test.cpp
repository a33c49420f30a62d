// `phyllite gui`: what its page asks for, over the wire. The page itself: tests/browser/gui.test.mjs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/stat.h>

#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>
#include <thread>

#include "../program.hpp"
#include "gui/http_fixture.hpp"

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using phy::gui::Answer;
using testing::HasSubstr;

/// The program as a server, in a folder of its own.
class Gui : public ProgramTest {
 protected:
  pid_t process = 0;
  int port = 0;
  std::string token;
  const std::string home = at("rocks");

  void SetUp() override {
    ProgramTest::SetUp();
    fs::create_directory(home);
    std::ofstream(fs::path(home) / "model.toml")
        << "[specimen]\nwidth = \"8 mm\"\nheight = \"16 mm\"\n[packing]\nn_grains = 330\n[[bedding]]\n"
           "spacing = \"2 mm\"\n[test]\nplaten_speed = \"0.2 m/s\"\n";
    begin();
  }
  void TearDown() override { end(SIGTERM); }

  void begin() {
    const std::string said = at("said.txt");
    fs::remove(said);
    const std::string line =
        "exec " + std::string(PHY_PROGRAM) + " --threads 2 gui " + home + " --port 0 > " + said + " 2>&1";
    const char* arguments[] = {"sh", "-c", line.c_str(), nullptr};
    ASSERT_EQ(posix_spawn(&process, "/bin/sh", nullptr, nullptr, const_cast<char**>(arguments), environ), 0);
    const std::string mark = "?token=";
    for (int i = 0; i < 200 && read(said).find("Ctrl-C") == std::string::npos; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    const std::string address = read(said).substr(0, read(said).find('\n'));
    ASSERT_THAT(address, HasSubstr("http://127.0.0.1:"));
    port = std::stoi(address.substr(std::string("http://127.0.0.1:").size()));
    token = address.substr(address.find(mark) + mark.size());
  }
  /// The exit code, 128 + signal where a signal ended it.
  int end(int signal) {
    if (process == 0) return -1;
    ::kill(process, signal);
    int status = 0;
    ::waitpid(process, &status, 0);
    process = 0;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }
  std::string known() const {
    return "Host: 127.0.0.1:" + std::to_string(port) + "\r\nX-Phyllite-Token: " + token + "\r\n";
  }
  Json get(const std::string& target) const {
    const Answer answer = phy::gui::ask(port, "GET " + target, known());
    EXPECT_EQ(answer.status, 200) << target << "\n" << answer.body;
    return Json::parse(answer.body, nullptr, false);
  }
  Answer post(const std::string& target, const Json& asked) const {
    return phy::gui::ask(port, "POST " + target, known(), asked.dump());
  }
  Json done(const std::string& target, const Json& asked) const {
    const Answer answer = post(target, asked);
    EXPECT_EQ(answer.status, 200) << target << "\n" << answer.body;
    return Json::parse(answer.body, nullptr, false);
  }
  Json calibration() const { return get("/api/rock?name=shale")["calibration"]; }
  /// Asks until nothing runs, as long as ctest lets it; the last answer.
  Json waited() const {
    Json now = calibration();
    while (now["state"] == "running") {
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
      now = calibration();
    }
    return now;
  }
  void save_rock() const {
    done("/api/save",
         {{"name", "shale"},
          {"toml", "data = \"shale.csv\"\nrecipe = \"model.toml\"\nE_is = \"small strain\"\n"},
          {"table",
           "theta [deg],E [GPa],nu,UCS [MPa]\n0,23.2,0.2,105\n30,16.6,0.3,67\n60,21,0.3,50\n90,59,0.2,138\n"},
          {"stamp", ""}});
  }
};

TEST_F(Gui, WhatThePageStartsIsTheCommandThatItShows) {
  save_rock();
  EXPECT_EQ(calibration()["state"], "new");
  const std::string command =
      done("/api/calibrate", {{"name", "shale"}, {"options", {{"elastic", true}}}})["command"];
  const Json finished = waited();
  EXPECT_EQ(finished["state"], "finished") << finished;
  EXPECT_FALSE(finished["verdict"]["sentence"].get<std::string>().empty());
  EXPECT_EQ(finished["progress"]["state"], "finished");
  EXPECT_FALSE(finished["progress"]["parameters"].empty());
  EXPECT_THAT(finished["log"].get<std::string>(), testing::StartsWith("$ " + command + "\n"));
  // the same by hand, elsewhere
  fs::create_directory(at("hand"));
  for (const char* file : {"shale.toml", "shale.csv", "model.toml"})
    fs::copy_file(fs::path(home) / file, fs::path(at("hand")) / file);
  const std::string words = command.substr(std::string("phyllite").size());
  run_line("cd " + at("hand") + " && " + PHY_PROGRAM + words);
  EXPECT_EQ(read(at("hand/shale-calibration/calibrated.toml")),
            read(fs::path(home) / "shale-calibration/calibrated.toml"));
  // begun afresh, the first one stays
  done("/api/calibrate", {{"name", "shale"}, {"options", {{"elastic", true}}}, {"anew", true}});
  EXPECT_EQ(waited()["folder"], "shale-calibration-2");
  EXPECT_TRUE(fs::exists(fs::path(home) / "shale-calibration/report.html"));
  const Answer report = phy::gui::ask(port, "GET /files/shale-calibration/report.html", known());
  EXPECT_EQ(report.status, 200);
  EXPECT_THAT(report.head, HasSubstr("sandbox"));
}

TEST_F(Gui, ATestIsARecipeAndItsResults) {
  save_rock();
  done("/api/calibrate", {{"name", "shale"}, {"options", {{"elastic", true}}}});
  waited();
  const Json recipe = done("/api/recipe", {{"name", "shale"},
                                           {"changes",
                                            {{"test.kind", "direct_tension"},
                                             {"test.platen_speed", "0.02 m/s"},
                                             {"test.angles", "[\"0 deg\", \"90 deg\"]"}}}});
  ASSERT_TRUE(recipe["problems"].empty()) << recipe;
  done("/api/test", {{"name", "shale"}, {"test", "pull"}, {"toml", recipe["toml"]}});
  Json test;
  for (int i = 0; i < 600; ++i) {
    test = get("/api/rock?name=shale")["tests"].at(0);
    if (test["state"] != "running") break;
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  EXPECT_EQ(test["state"], "finished") << test;
  ASSERT_EQ(test["specimens"].size(), 2U);
  EXPECT_EQ(test["specimens"][0]["status"], "peaked");
  EXPECT_GT(test["specimens"][0]["value"].get<double>(), 1e6);
  EXPECT_EQ(read(fs::path(home) / "shale-tests/pull.toml"), recipe["toml"].get<std::string>());
  EXPECT_EQ(post("/api/test", {{"name", "shale"}, {"test", "pull"}, {"toml", "another"}}).status, 400);
}

TEST_F(Gui, StoppedAndTakenUpAgainAlsoByAnotherServer) {
  save_rock();
  done("/api/calibrate", {{"name", "shale"}, {"options", {{"max_tests", 72}}}});
  EXPECT_EQ(post("/api/calibrate", {{"name", "shale"}}).status, 400);  // one at a time
  const auto n_done = [&] {
    const Json progress = calibration()["progress"];
    return progress.is_null() ? 0 : progress["n_done"].get<int>();
  };
  for (int i = 0; i < 600 && n_done() == 0; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(50));
  done("/api/stop", {{"name", "shale"}});
  post("/api/stop", {{"name", "shale"}});  // impatient: still not killed
  Json stopped = waited();
  EXPECT_EQ(stopped["state"], "stopped") << stopped;
  EXPECT_EQ(stopped["progress"]["state"], "stopped");
  done("/api/calibrate", {{"name", "shale"}, {"resume", true}});
  // the server goes, and what it runs with it; nothing is lost
  EXPECT_EQ(end(SIGTERM), 0);
  begin();
  stopped = calibration();
  EXPECT_EQ(stopped["state"], "stopped") << stopped;
  EXPECT_THAT(stopped["command"].get<std::string>(), HasSubstr("--max-tests 72 --resume"));
  done("/api/calibrate", {{"name", "shale"}, {"resume", true}});
  EXPECT_EQ(waited()["state"], "finished");
}

TEST_F(Gui, WhatCannotRunIsRefusedWithItsReason) {
  EXPECT_EQ(post("/api/calibrate", {{"name", "shale"}}).status, 400);  // not saved
  save_rock();
  const Answer few = post("/api/calibrate", {{"name", "shale"}, {"options", {{"max_tests", 5}}}});
  EXPECT_EQ(few.status, 400);
  EXPECT_THAT(few.body, HasSubstr("--max-tests = 5"));
  EXPECT_EQ(calibration()["state"], "new");  // and nothing has been begun
  EXPECT_FALSE(fs::exists(fs::path(home) / "shale-calibration"));
  for (const Json& n : {Json(-5), Json(1.5), Json("many"), Json(nullptr), Json::array({72})})
    EXPECT_EQ(post("/api/calibrate", {{"name", "shale"}, {"options", {{"max_tests", n}}}}).status, 400) << n;
  EXPECT_EQ(
      post("/api/test", {{"name", "shale"}, {"test", "x"}, {"toml", "[test]\nkind = \"no such\"\n"}}).status,
      400);
  EXPECT_FALSE(fs::exists(fs::path(home) / "shale-tests"));
  EXPECT_EQ(post("/api/stop", {{"name", "shale"}}).status, 400);
  for (const char* body :
       {"", "{", "[]", "{\"name\": 3}", "{\"name\": \"../x\", \"toml\": \"\", \"table\": null}"})
    EXPECT_EQ(phy::gui::ask(port, "POST /api/check", known(), std::string(body) + " ").status, 400) << body;
  EXPECT_EQ(phy::gui::ask(port, "GET /api/no-such", known()).status, 404);
}

TEST_F(Gui, ACalibrationOfATerminalIsSeenStoppedAndNotDisturbed) {
  save_rock();
  const std::string calibrate =
      std::string(PHY_PROGRAM) + " calibrate shale.toml --out shale-calibration --max-tests 72";
  std::thread terminal([&] {
    EXPECT_EQ(std::system(("cd " + home + " && " + calibrate + " > /dev/null 2>&1").c_str()), 256);
  });
  for (int i = 0; i < 600 && calibration()["state"] != "running"; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_EQ(calibration()["here"], false);
  EXPECT_EQ(post("/api/calibrate", {{"name", "shale"}, {"resume", true}}).status, 400);
  EXPECT_EQ(run_line("cd " + home + " && " + calibrate + " --resume"), 2);
  EXPECT_THAT(output, HasSubstr("no other process"));
  done("/api/stop", {{"name", "shale"}});
  terminal.join();
  EXPECT_EQ(calibration()["state"], "stopped");
}

/// Requests that must be answered, with pipes and devices where files are looked for. `end` of a server that
/// waits would not come back: the alarm ends the tests then.
TEST_F(Gui, WhatIsNoFileIsNotWaitedFor) {
  ::alarm(120);
  save_rock();
  const fs::path calibration = fs::path(home) / "shale-calibration", tests = fs::path(home) / "shale-tests";
  fs::create_directories(calibration), fs::create_directories(tests / "pull");
  const auto pipe = [](const fs::path& name) { ASSERT_EQ(::mkfifo(name.c_str(), 0600), 0) << name; };
  for (const fs::path& name :
       {fs::path(home) / "shale-calibration.log", calibration / ".progress.json",
        calibration / "calibration.json", calibration / "request.toml", calibration / "report.html",
        tests / "pull.toml", tests / "pull.log", tests / "pull" / "result.json", fs::path(home) / "p.csv",
        fs::path(home) / "pipe.toml", fs::path(home) / "shale-calibration.log.begun"})
    pipe(name);
  fs::create_symlink("/dev/zero", fs::path(home) / "zero.toml");
  std::ofstream(fs::path(home) / "zero2.toml") << "data = \"/dev/zero\"\n";
  for (int i = 0; i < 6; ++i) {  // more than there are threads that answer
    EXPECT_EQ(get("/api/project")["rocks"].size(), 2U);
    EXPECT_EQ(get("/api/rock?name=shale")["tests"].size(), 1U);
    for (const char* data : {"p.csv", "/dev/zero", "/dev/urandom", "shale-tests", "zero.toml"}) {
      const Json answer =
          done("/api/check",
               {{"name", "x"}, {"toml", "data = \"" + std::string(data) + "\"\n"}, {"table", nullptr}});
      EXPECT_THAT(answer["problems"].dump(), HasSubstr("a file that can be read")) << data;
    }
    EXPECT_EQ(phy::gui::ask(port, "GET /files/p.csv", known()).status, 404);
  }
  EXPECT_EQ(post("/api/calibrate", {{"name", "shale"}, {"options", {{"elastic", true}}}}).status,
            400);  // calibration.json is there
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(end(SIGINT), 0);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10));
  ::alarm(0);
}

TEST_F(Gui, CtrlCIsNotKeptByAnAnswer) {
  ::alarm(60);
  std::string table = "theta [deg],E [GPa]\n";
  while (table.size() < 12'000'000)  // 14 MB as JSON, of 16 that may come
    table += "0,20\n45,22\n90,30\n";
  const std::string body = Json{{"name", "x"}, {"toml", "data = \"x.csv\"\n"}, {"table", table}}.dump();
  phy::gui::Wire wire(port);
  ASSERT_TRUE(wire.send("POST /api/check HTTP/1.1\r\n" + known() +
                        "Content-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body));
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(end(SIGINT), 0);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(3));
  ::alarm(0);
}

// A halted process takes no notice of the signal that asks it to end.
TEST_F(Gui, WhatDoesNotStopIsEnded) {
  ::alarm(300);
  save_rock();
  done("/api/calibrate", {{"name", "shale"}, {"options", {{"max_tests", 72}}}});
  const std::string own = std::to_string(process);
  ASSERT_EQ(run_line("ps -o pid= --ppid " + own), 0);
  const pid_t child = std::stoi(output);
  ASSERT_EQ(::kill(child, SIGSTOP), 0);
  done("/api/stop", {{"name", "shale"}});
  done("/api/stop", {{"name", "shale"}});  // impatient
  EXPECT_EQ(calibration()["state"], "running");
  EXPECT_EQ(waited()["state"], "stopped");
  EXPECT_NE(::kill(child, 0), 0);
  ::alarm(0);
}

TEST_F(Gui, ARefusedStartLeavesTheLogThatWasThere) {
  save_rock();
  EXPECT_EQ(post("/api/calibrate", {{"name", "shale"}, {"options", {{"max_tests", 5}}}}).status, 400);
  EXPECT_FALSE(fs::exists(fs::path(home) / "shale-calibration.log"));
  std::ofstream(fs::path(home) / "shale-calibration.log") << "$ phyllite calibrate earlier\n";
  EXPECT_EQ(post("/api/calibrate", {{"name", "shale"}, {"options", {{"max_tests", 5}}}}).status, 400);
  EXPECT_EQ(read(fs::path(home) / "shale-calibration.log"), "$ phyllite calibrate earlier\n");
  for (const auto& entry : fs::directory_iterator(home)) EXPECT_NE(entry.path().extension(), ".begun");
}

TEST_F(Gui, ALogOfAnyLengthIsShownByItsEnd) {
  save_rock();
  const std::string log = (fs::path(home) / "shale-calibration.log").string();
  std::ofstream(log) << "$ phyllite calibrate\n";
  fs::resize_file(log, std::uintmax_t{6} << 30U);
  std::ofstream(log, std::ios::app) << "\nthe last line\n";
  const std::string shown = calibration()["log"];
  EXPECT_THAT(shown, testing::EndsWith("the last line\n"));
  EXPECT_LT(shown.size(), 100000U);
}

TEST_F(Gui, AFolderThatHasGoneIsSaid) {
  save_rock();
  fs::remove_all(home);
  for (const char* target : {"/api/project", "/api/rock?name=shale", "/files/shale.csv"}) {
    const Answer answer = phy::gui::ask(port, std::string("GET ") + target, known());
    EXPECT_EQ(answer.status, 500) << target;
    EXPECT_THAT(answer.body, HasSubstr("The folder of `phyllite gui` is no longer there. End the program"))
        << target;
  }
}

TEST_F(Gui, ARequestOfBracketsIsRefused) {
  const Answer answer = phy::gui::ask(port, "POST /api/check", known(), std::string(100000, '['));
  EXPECT_EQ(answer.status, 400);
  EXPECT_THAT(answer.body, HasSubstr("nested too deep"));
}

TEST_F(Gui, ItsOwnInput) {
  EXPECT_EQ(run("gui " + at("x") + " --port 70000"), 2);
  EXPECT_EQ(run("gui " + at("x") + " --port " + std::to_string(port)), 3);
  EXPECT_THAT(output, HasSubstr("choose another --port"));
  write("file", "");
  EXPECT_EQ(run("gui " + at("file")), 3);
}

}  // namespace
