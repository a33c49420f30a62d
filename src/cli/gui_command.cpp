// `phyllite gui FOLDER`: a page to work in, for a browser on this machine.
#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <system_error>

#include "base/check.hpp"
#include "cli/commands.hpp"
#include "cli/machine.hpp"
#include "cli/terminal.hpp"
#include "gui/api.hpp"
#include "gui/way_in.hpp"
#include "io/file.hpp"
#include "system/browser.hpp"
#include "system/terminal.hpp"

namespace phy::cli {
namespace {

struct GuiArguments {
  std::string folder = ".";
  int port = usual;
  bool browser = false, no_browser = false;  // neither: where somebody sits before it
  static constexpr int usual = -1, first = 7337;
};

/// The same port every time, where it is free: browsers keep what was typed by address and port.
std::unique_ptr<gui::Server> server_at(int port, const gui::Tokens& tokens, const gui::Handler& handler) {
  const auto at = [&](int p) {
    return std::make_unique<gui::Server>(static_cast<unsigned short>(p), tokens, handler);
  };
  if (port != GuiArguments::usual) return at(port);
  try {
    return at(GuiArguments::first);
    // Another folder's page has that port already, or another program: both should go on.
  } catch (const IoError&) {
    return at(0);
  }
}

int run_gui(const GuiArguments& args, const Session& session) {
  io::check_writable(args.folder);
  // Commands of the page are typed with names relative to this folder, so the process works in it.
  std::filesystem::current_path(args.folder);
  // A token for everything, and another for files alone: scripts of a page in a result must not get the
  // first.
  const gui::Tokens tokens = {gui::kept_token(gui::way_in_file), gui::random_token()};
  gui::Api api(session.threads, tokens.file);
  const auto server =
      server_at(args.port, tokens, [&](const gui::Request& request) { return api.answer(request); });
  const int width = session.terminal_width;
  // After the server has its port: the file holds the whole address.
  gui::write_way_in(gui::way_in_file, server->address());
  // The address stands alone on its line, so that terminals make a link of it and scripts can read it.
  print_out("{}\n", server->address());
  print_wrapped(
      width, 2,
      "a page to work in, for a browser on this machine; the address is a key: whoever has it can use "
      "the page. Files are in {}\n",
      std::filesystem::current_path().string());
  print_wrapped(width, 2, "Ctrl-C ends it; its commands keep their finished tests\n");
  // On a pipe the address would else wait in a buffer for as long as the server runs.
  flush_out();
  if (args.browser ||
      (!args.no_browser && system::is_terminal(system::standard_output) && system::has_desktop()))
    // A file in place of the address: what a command line says every user of the machine can read.
    system::open_in_browser(std::filesystem::absolute(gui::way_in_file).string());
  const bool all_answered = server->run(*stop_on_interrupt());
  // Told before they end: after Ctrl-C nobody should wonder where a calibration has gone.
  for (const std::string& folder : api.running())
    print_wrapped(width, 2, "stopping what writes {}: `phyllite gui`, started again, can go on with it\n",
                  folder);
  flush_out();
  api.end();
  // Nobody will read what is still being answered, and it may take long.
  if (!all_answered) std::_Exit(0);
  return 0;
}

}  // namespace

void add_gui_command(CLI::App& app, Session& session) {
  auto args = std::make_shared<GuiArguments>();
  CLI::App* verb = app.add_subcommand(
      "gui", "a page to work in: type a table, calibrate, test (in a browser on this machine)");
  verb->add_option("folder", args->folder, "where its files are; made if it is missing")
      ->capture_default_str()
      ->type_name("FOLDER");
  verb->add_option(
          "--port", args->port,
          fmt::format("port on 127.0.0.1; 0: one that is free; default: {}, or one that is free where "
                      "that is taken",
                      GuiArguments::first))
      ->check(CLI::Range(0, 65535));
  auto* open = verb->add_flag("--browser", args->browser,
                              "open the page in the browser; default: in a terminal on a desktop");
  verb->add_flag("--no-browser", args->no_browser, "open no browser")->excludes(open);
  verb->callback([args, &session] { session.exit_code = run_gui(*args, session); });
}

}  // namespace phy::cli
