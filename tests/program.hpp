// The program as a child process, in a folder of its own.
#pragma once
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "base/in_folder_fixture.hpp"

class ProgramTest : public phy::InFolder {
 protected:
  std::string output;
  void SetUp() override { ::setenv("XDG_CACHE_HOME", at("cache").c_str(), 1); }

  int run(const std::string& arguments) { return run_line(PHY_PROGRAM " " + arguments); }
  /// Runs a line of shell; what it prints is in `output`. The exit code, or -1 after a signal.
  int run_line(const std::string& line) {
    output.clear();
    FILE* pipe = ::popen(("{ " + line + "; } 2>&1").c_str(), "r");
    std::array<char, 4096> buffer{};
    while (std::fgets(buffer.data(), buffer.size(), pipe) != nullptr) output += buffer.data();
    const int status = ::pclose(pipe);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  /// Runs the program and sends it `signal` just before its n-th event (tests/count_events.cpp): at the same
  /// place on every machine. The exit code of a shell: 128 + signal where the signal ended it.
  int run_to_event(long n, int signal, const std::string& arguments, const std::string& before = "") {
    return run_line(before + "PHY_SIGNAL_AT=" + std::to_string(n) + " PHY_SIGNAL=" + std::to_string(signal) +
                    " LD_PRELOAD=" + PHY_EVENTS + " " + PHY_PROGRAM + " " + arguments);
  }
  /// Events of a whole run that must end with 0.
  long n_events(const std::string& arguments) {
    const std::string file = at("n_events");
    EXPECT_EQ(run_line("PHY_COUNT_INTO=" + file + " LD_PRELOAD=" + PHY_EVENTS + " " + PHY_PROGRAM + " " +
                       arguments),
              0)
        << output;
    return std::atol(read(file).c_str());
  }
  std::string small_recipe(const std::string& more = "") const {
    return write(
        "small.toml",
        "name = \"small\"\n[specimen]\nwidth = \"8 mm\"\nheight = \"16 mm\"\n[packing]\nn_grains = 330\n"
        "[matrix]\nsigma_c = \"40 MPa\"\ntau_c = \"40 MPa\"\n[[bedding]]\nspacing = \"2 mm\"\n[test]\n"
        "angles = [\"45 deg\", \"60 deg\"]\nintact = true\nplaten_speed = \"0.2 m/s\"\n" +
            more);
  }
  std::string out() const { return at("out"); }
  /// Of "hash 0123456789abcdef", as a study prints it last.
  std::string hash() const {
    const std::size_t place = output.rfind("hash ");
    return place == output.npos ? "no hash in: " + output : output.substr(place + 5, 16);
  }
  /// Whether a tool is there, as a condition to run a test at all. .ci/run installs the tools and says so in
  /// PHY_ALL_TOOLS: there a missing one is a failure, or a test could stay away for ever unseen.
  bool has(const std::string& tool) {
    if (run_line("command -v " + tool) == 0) return true;
    if (std::getenv("PHY_ALL_TOOLS") != nullptr) ADD_FAILURE() << tool << " is missing";
    return false;
  }
  /// Starts the program in the background; what it prints goes to `log`.
  static pid_t start(const std::vector<std::string>& arguments, const std::string& log = "/dev/null") {
    const pid_t child = ::fork();
    if (child != 0) return child;
    std::vector<char*> words = {const_cast<char*>(PHY_PROGRAM)};
    for (const std::string& a : arguments) words.push_back(const_cast<char*>(a.c_str()));
    words.push_back(nullptr);
    const int fd = ::open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    if (fd < 0 || ::dup2(fd, STDOUT_FILENO) < 0 || ::dup2(fd, STDERR_FILENO) < 0) ::_exit(126);
    ::execv(PHY_PROGRAM, words.data());
    ::_exit(127);
  }
};
