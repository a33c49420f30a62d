// `phyllite verify`: closed forms beside the program's numbers, so that nobody has to believe us; and with
// --hash the bits of this build beside those that were tested.
#include <fmt/format.h>

#include <algorithm>

#include "base/check.hpp"
#include "base/version.hpp"
#include "cli/commands.hpp"
#include "cli/machine.hpp"
#include "cli/suggested.hpp"
#include "cli/terminal.hpp"
#include "verification/cases.hpp"
#include "verification/golden.hpp"

namespace phy::cli {
namespace {

/// One check on one line if it fits, else its quantity, and the numbers below each other.
void print_check(const verification::Check& k, int width) {
  const char* verdict = k.passed() ? "ok  " : "FAIL";
  const std::string line =
      fmt::format("     {} expected {:< 16.9e} measured {:< 16.9e} tolerance {:.2g}  {}\n", verdict,
                  k.expected, k.measured, k.tolerance, k.what);
  // The line break counts as a character of the line and takes no column.
  if (width <= 0 || line.size() <= static_cast<std::size_t>(width) + 1) {
    print_out("{}", line);
    return;
  }
  print_wrapped(width, 10, "     {} {}\n", verdict, k.what);
  print_out("{0:10}expected  {1:< .9e}\n{0:10}measured  {2:< .9e}\n{0:10}tolerance  {3:.0e}\n", "",
            k.expected, k.measured, k.tolerance);
}

void print_plain(const verification::VerificationCase& c, const std::vector<verification::Check>& checks,
                 int width) {
  print_wrapped(width, 5, "{:4} {}\n     source: {}\n     tolerance: {}\n", c.id, c.claim, c.source, c.why);
  for (const verification::Check& k : checks) print_check(k, width);
}

/// A bar would end the cell.
std::string in_a_cell(std::string text) {
  for (std::size_t at = 0; (at = text.find('|', at)) != text.npos; at += 2) text.insert(at, "\\");
  return text;
}

void print_markdown(const verification::VerificationCase& c, const std::vector<verification::Check>& checks) {
  print_out("\n## {} - {}\n\nSource: {}. Tolerance: {}.\n\n", c.id, c.claim, c.source, c.why);
  print_out("| quantity | expected | measured | tolerance | |\n|---|---|---|---|---|\n");
  for (const verification::Check& k : checks)
    print_out("| {} | {:.9e} | {:.9e} | {:.2g} | {} |\n", in_a_cell(k.what), k.expected, k.measured,
              k.tolerance, k.passed() ? "ok" : "FAIL");
}

std::vector<std::string> ids_of_cases() {
  std::vector<std::string> names;
  for (const verification::VerificationCase& c : verification::verification_cases())
    if (std::find(names.begin(), names.end(), c.id) == names.end()) names.push_back(c.id);
  // By length first: V2 stands before V10.
  std::sort(names.begin(), names.end(), [](const std::string& a, const std::string& b) {
    return a.size() != b.size() ? a.size() < b.size() : a < b;
  });
  return names;
}

/// What hashes that differ, or the lack of recorded ones, mean.
std::string verdict_of(const std::vector<verification::GoldenHash>& hashes) {
  const auto n = static_cast<std::size_t>(std::count_if(
      hashes.begin(), hashes.end(), [](const verification::GoldenHash& h) { return !h.equal(); }));
  if (n == 0)
    return fmt::format(
        "{} hashes, all as recorded: this build on this processor computes, bit for bit, the numbers that "
        "were tested\n",
        hashes.size());
  return fmt::format(
      "{} of {} hashes are not the recorded ones: {} on this processor computes other numbers than the "
      "program that was tested{}. How far they differ the hashes do not say (`phyllite verify` holds this "
      "build against closed forms), but results of both must not be mixed in one study. A compiler that was "
      "told to contract or reorder floating-point operations (-ffast-math, -ffp-contract=fast) does this; so "
      "does a change of the source: there `make record` writes new ones down. In a build as it was "
      "published it is an error: please report it with compiler and processor\n",
      n, hashes.size(), phy::program,
      // The first hash is that of the packing: where it differs, every test starts from other discs.
      hashes.front().equal() ? "" : ", from its packing on, which all others follow from");
}

/// Prints the golden hashes beside the recorded ones; the exit code.
int compare_hashes(const Session& session) {
  const study::MachineOptions machine = machine_of(session);
  const std::atomic<bool>* stop = stop_on_interrupt();
  const std::vector<verification::GoldenHash> hashes = verification::golden_hashes(machine, stop);
  if (hashes.empty()) {
    print_out("stopped, no hash was compared\n");
    return 1;
  }
  for (const verification::GoldenHash& h : hashes)
    print_out("{:<46} {}  {}\n", h.name, h.hash,
              h.equal()            ? "equal"
              : h.recorded.empty() ? "DIFFERS: none was recorded"
                                   : "DIFFERS: recorded " + h.recorded);
  print_wrapped(session.terminal_width, 2, "{}, {}, {} thread(s): {}", phy::program,
                engine::to_string(machine.isa), machine.threads, verdict_of(hashes));
  return std::all_of(hashes.begin(), hashes.end(), [](const auto& h) { return h.equal(); }) ? 0 : 1;
}

/// Runs the cases, or `only` one of them; the exit code.
int verify(const std::string& only, bool markdown, int width) {
  int n_failed = 0, n_checks = 0;
  if (markdown)
    print_out(
        "# Verification\n\nWritten by `phyllite verify --markdown`. Every number below was computed by the "
        "program that users run.\nA tolerance is relative; where the expected value is 0 it is "
        "absolute.\n");
  for (const verification::VerificationCase& c : verification::verification_cases()) {
    if (!only.empty() && c.id != only) continue;
    const std::vector<verification::Check> checks = c.run();
    for (const verification::Check& k : checks) n_failed += k.passed() ? 0 : 1, ++n_checks;
    if (markdown)
      print_markdown(c, checks);
    else
      print_plain(c, checks, width);
  }
  // Found after the loop: only the list of cases knows their names.
  if (n_checks == 0)
    throw InputError(
        Problem{"command line", "case", only, fmt::format("one of {}", fmt::join(ids_of_cases(), ", ")), ""});
  // Whoever counts the cases finds a gap at V16; the page says where it went.
  if (only.empty()) print_out("{}V16 is a unit test of src/genesis (make test).\n", markdown ? "\n" : "");
  print_out("{}{} checks, {} failed\n", markdown ? "\n" : "", n_checks, n_failed);
  return n_failed == 0 ? 0 : 1;
}

}  // namespace

void add_verify_command(CLI::App& app, Session& session) {
  auto markdown = std::make_shared<bool>(false);
  auto hash = std::make_shared<bool>(false);
  auto only = std::make_shared<std::string>();
  CLI::App* verb = app.add_subcommand("verify", "compare the program with closed forms");
  CLI::Option* page = verb->add_flag("--markdown", *markdown, "print the page docs/verification.md");
  CLI::Option* one = verb->add_option("case", *only, "run one case only, for example V6")
                         ->type_name("CASE")
                         ->check(suggested(ids_of_cases));
  verb->add_flag("--hash", *hash,
                 "compare the bits of small tests of every kind and contact model with the recorded ones")
      ->excludes(page)
      ->excludes(one);
  verb->callback([=, &session] {
    session.exit_code = *hash ? compare_hashes(session) : verify(*only, *markdown, session.terminal_width);
  });
}

}  // namespace phy::cli
