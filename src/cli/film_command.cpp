// `phyllite film RESULT`: an animation of the test, encoded by ffmpeg.
#include <fmt/format.h>

#include <filesystem>

#include "base/check.hpp"
#include "cli/machine.hpp"
#include "cli/provenance.hpp"
#include "cli/terminal.hpp"
#include "io/load.hpp"
#include "io/program.hpp"
#include "report/film.hpp"

namespace phy::cli {
namespace {

struct FilmArguments {
  std::string result, out = "film.webm";
  report::FilmOptions film;
};

/// The exit code.
int make_film(const FilmArguments& args) {
  const RunRecord run = io::read_run(args.result);
  // Throws before ffmpeg starts where the run has kept no frames: no empty file is left.
  const report::Film film(run, args.film);
  const std::atomic<bool>* stop = stop_on_interrupt();
  make_file_or_stop(args.out, [&](const std::string& temporary) {
    io::run_program("ffmpeg", film.encoder_arguments(temporary), "ffmpeg", [&](const auto& write) {
      for (int i = 0; i < film.n_frames(); ++i) {
        // Between frames: the encoder is ended with its input.
        if (*stop) throw IoError("stopped");
        write(film.frame(i).rgb());
      }
    });
  });
  print_out("{}: {} frames, {} x {}, {:.1f} MB\n", args.out, film.n_frames(), film.width(), film.height(),
            1e-6 * static_cast<double>(std::filesystem::file_size(args.out)));
  return tell_provenance(run, 0);
}

}  // namespace

void add_film_command(CLI::App& app, Session& session) {
  auto args = std::make_shared<FilmArguments>();
  CLI::App* verb =
      app.add_subcommand("film", "write an animation of the test (WebM, MP4 or GIF) through ffmpeg");
  verb->add_option("result", args->result,
                   "folder that `phyllite run` wrote, `specimens` of a calibration, or one specimen of them")
      ->required()
      ->type_name("FOLDER");
  // ffmpeg chooses container and codec by the ending, and others would fail only after the first frame.
  verb->add_option("--out", args->out, "file that ends in .webm, .mp4 or .gif")
      ->type_name("FILE")
      ->check([](const std::string& name) {
        const bool known = name.ends_with(".webm") || name.ends_with(".mp4") || name.ends_with(".gif");
        return known ? "" : "name a file that ends in .webm, .mp4 or .gif";
      })
      ->capture_default_str();
  verb->add_option("--width", args->film.width, "pixels")
      ->check(CLI::Range(320, 3840))
      ->capture_default_str();
  verb->add_option("--seconds", args->film.seconds, "length of the film")
      ->check(within(0.5, 120.0))
      ->capture_default_str();
  verb->add_option("--magnify", args->film.magnify, "factor on displacements")
      ->check(within(0.0, 200.0))
      ->capture_default_str();
  verb->callback([args, &session] { session.exit_code = make_film(*args); });
}

}  // namespace phy::cli
