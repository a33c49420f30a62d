// `phyllite verify`: closed forms beside the program's numbers, so that nobody has to believe us.
#include <fmt/format.h>

#include <algorithm>

#include "base/check.hpp"
#include "cli/commands.hpp"
#include "cli/terminal.hpp"
#include "verification/cases.hpp"

namespace phy::cli {
namespace {

/// One check on one line if it fits, else its quantity, and the numbers below each other.
void print_check(const verification::Check& k, int width) {
  const char* verdict = k.passed() ? "ok  " : "FAIL";
  const std::string line =
      fmt::format("     {} expected {:< 16.9e} measured {:< 16.9e} tolerance {:.0e}  {}\n", verdict,
                  k.expected, k.measured, k.tolerance, k.what);
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

void print_markdown(const verification::VerificationCase& c, const std::vector<verification::Check>& checks) {
  print_out("\n## {} - {}\n\nSource: {}. Tolerance: {}.\n\n", c.id, c.claim, c.source, c.why);
  print_out("| quantity | expected | measured | tolerance | |\n|---|---|---|---|---|\n");
  for (const verification::Check& k : checks)
    print_out("| {} | {:.9e} | {:.9e} | {:.0e} | {} |\n", k.what, k.expected, k.measured, k.tolerance,
              k.passed() ? "ok" : "FAIL");
}

std::string names_of_cases() {
  std::vector<std::string> names;
  for (const verification::VerificationCase& c : verification::verification_cases())
    if (std::find(names.begin(), names.end(), c.id) == names.end()) names.push_back(c.id);
  std::sort(names.begin(), names.end(), [](const std::string& a, const std::string& b) {
    return a.size() != b.size() ? a.size() < b.size() : a < b;
  });
  return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace

void add_verify_command(CLI::App& app, Session& session) {
  auto markdown = std::make_shared<bool>(false);
  auto only = std::make_shared<std::string>();
  CLI::App* verb = app.add_subcommand("verify", "compare the program with closed forms");
  verb->add_flag("--markdown", *markdown, "write the page docs/verification.md");
  verb->add_option("case", *only, "run one case only, for example V6");
  verb->callback([markdown, only, &session] {
    int n_failed = 0, n_checks = 0;
    if (*markdown)
      print_out(
          "# Verification\n\nWritten by `phyllite verify --markdown`. Every number below was computed by the "
          "program that users run.\nA tolerance is relative; where the expected value is 0 it is "
          "absolute.\n");
    for (const verification::VerificationCase& c : verification::verification_cases()) {
      if (!only->empty() && c.id != *only) continue;
      const std::vector<verification::Check> checks = c.run();
      for (const verification::Check& k : checks) n_failed += k.passed() ? 0 : 1, ++n_checks;
      if (*markdown)
        print_markdown(c, checks);
      else
        print_plain(c, checks, session.terminal_width);
    }
    if (n_checks == 0)
      throw InputError(Problem{"command line", "case", *only, "one of " + names_of_cases(), ""});
    if (only->empty()) print_out("{}V16 is a unit test of src/genesis (make test).\n", *markdown ? "\n" : "");
    print_out("{}{} checks, {} failed\n", *markdown ? "\n" : "", n_checks, n_failed);
    session.exit_code = n_failed == 0 ? 0 : 1;
  });
}

}  // namespace phy::cli
