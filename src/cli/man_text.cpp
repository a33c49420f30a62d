#include "cli/man_text.hpp"

#include <algorithm>

#include "base/check.hpp"

namespace phy::cli {
namespace {

const std::vector<ManText>& texts() {
  static const std::vector<ManText> all = {
      {"",
       "Phyllite is a laboratory for layered rock: shale, slate, schist, gneiss. Discs held by parallel "
       "bonds or "
       "flat joints, bedding planes as smooth joints, in two dimensions. It runs laboratory tests on such "
       "specimens: uniaxial and biaxial compression, direct tension, Brazilian test, direct shear, "
       "semi-circular bend. It calibrates their micro-parameters from the table of a laboratory, with "
       "intervals, and verifies them on packings that the fit has not seen.\n\n"
       "Recipes, studies and rocks are files in TOML. `phyllite recipe --template` prints a recipe, "
       "`phyllite recipe --explain KEY` explains a key, `phyllite rock new` writes the template of a "
       "table. Every verb has a page of its own.\n\n"
       "Results do not depend on threads, lanes or the instruction set: the program chooses SSE2, AVX2 or "
       "AVX-512 at run time and gives the same bits by each. Ctrl-C lets a verb that runs tests end soon and "
       "keep finished tests; the second one ends it at once.",
       {{"~/.cache/phyllite",
         "packings that were made before, or in $XDG_CACHE_HOME/phyllite; may be removed at any "
         "time"},
        {"/usr/share/doc/phyllite/examples",
         "recipes, studies and rocks, beside data, docs and README.md. Installed below another prefix all of "
         "it is "
         "in share/doc/phyllite there"},
        {".written-by-phyllite",
         "beside results: which files the program wrote, and with which content; it replaces no others"}},
       {{"Take the examples and the tables that some of them read:",
         "cp -r /usr/share/doc/phyllite/examples /usr/share/doc/phyllite/data ."},
        {"Press a specimen of 750 discs at one bedding angle and without bedding, look at the tables again:",
         "phyllite run examples/pfc2d/specimen.toml --out results/pfc2d"},
        {"", "phyllite show results/pfc2d"},
        {"Hold this build against closed forms, one case of them:", "phyllite verify V6"}}},
      {"run",
       "Makes the packing of a recipe (or takes it from the cache), bonds it, and lays the bedding. Then it "
       "runs "
       "the recipe's test at each of its angles and, if asked, on intact rock. Specimens run side by side on "
       "all cores. Several recipes have a folder each, named after their files.\n\n"
       "The results of a folder are of one recipe: other angles of it are added, another recipe is refused "
       "unless --replace removes the older results. With --ensemble the recipe is the calibrated.toml of a "
       "calibration, and the test runs on every draw of its ensemble.",
       {{"results/NAME/result.json", "numbers with units and definitions, outcome, quality, packing, recipe"},
        {"results/NAME/history.csv, cracks.csv", "the test row by row; every crack"},
        {"results/NAME/grains.pvd, contacts.pvd", "snapshots for ParaView"},
        {"results/report.html", "all of it, for a browser"}},
       {{"One bedding angle and intact rock, 750 discs, in a few seconds:",
         "phyllite run examples/pfc2d/specimen.toml --out results/pfc2d"},
        {"The Brazilian test on the specimen of the paper behind this project:",
         "phyllite run examples/lab/brazilian.toml --out results/brazilian"}}},
      {"specimen",
       "Makes the packing and the bedding of a recipe, measures them (porosity, coordination, joints, "
       "bridges), and runs no test.",
       {{"discs.csv",
         "centre and radius of every disc of the specimen, which packing.file of a recipe reads"},
        {"contacts_NAME.csv", "per specimen: every contact with kind, gap, stiffnesses, strengths"}},
       {{"", "phyllite specimen examples/pfc2d/specimen.toml --out specimen"}}},
      {"verify",
       "Computes cases whose answer is known in closed form: elasticity, waves, contact laws, joints, whole "
       "bodies. Prints expected and computed value, difference and tolerance of each. Exit status 1 says "
       "that a check failed.\n\n"
       "With --hash small tests of every kind and contact model are run and their bits compared with those "
       "that "
       "were recorded when the program was tested.",
       {},
       {{"One case:", "phyllite verify V6"},
        {"All of them:", "phyllite verify"},
        {"", "phyllite verify --hash"}}},
      {"recipe",
       "Explains the keys of a recipe, prints a complete one with comments, or reads a recipe, reports all "
       "its "
       "problems at once, and prints it completed. A quantity carries its unit, in quotes; a key that is "
       "left "
       "out has its default.",
       {},
       {{"A recipe to begin with:", "phyllite recipe --template"},
        {"What a key means, its range, its default, its name in PFC:",
         "phyllite recipe --explain bedding.spacing"},
        {"A recipe checked and completed:", "phyllite recipe examples/lab/brazilian.toml"}}},
      {"contact",
       "Drives one contact of two discs along a path by the code that the tests run. Prints per step its "
       "place, forces and moment by the law and by its closed form, energies, and where it broke. Without a "
       "law all laws are listed with their parameters. Without --to and --path a path is "
       "taken that closes, slides, pulls and turns the contact. The largest difference from the closed form "
       "goes to "
       "standard error.",
       {},
       {{"All laws:", "phyllite contact"},
        {"A bond that is pressed, then sheared:",
         "phyllite contact parallel_bond --to \"1 um, 0 um, 0 deg\" --to \"1 um, 8 um, 0 deg\" --steps 10"}}},
      {"study",
       "Runs the tests of a study file: a design over keys of a recipe (one at a time, factorial, list, "
       "Latin "
       "hypercube, Sobol, Morris, Saltelli), packings, bond seeds, angles. Every test that is finished is in "
       "the "
       "store at once, so that a study may be killed at any moment: the same command, or `phyllite study "
       "resume`, goes on. With --shard parts run on several machines, each into a store of its own, which "
       "`phyllite study merge` joins.\n\n"
       "Options of the study itself do not go with a verb below it.",
       {{"results/NAME/study.sqlite", "the store: every test with its recipe, numbers, history and cracks"},
        {"results/NAME/results.csv", "one row per specimen"},
        {"results/NAME/responses.csv, effects.csv", "what the parameters do, over the replicates"},
        {"results/NAME/report.html", "for a browser"}},
       {{"What the paper's parametric study would cost; nothing is run:",
         "phyllite study examples/paper/study.toml --dry-run"},
        {"The stiffness of joints by direct elastic solutions:",
         "phyllite study examples/paper/elastic.toml --out results/elastic"},
        {"What is finished, and what came out:", "phyllite study status results/elastic"},
        {"", "phyllite study effects results/elastic"}}},
      {"elastic",
       "Solves the elastic problem of every specimen of a recipe directly, without time steps. Prints E and "
       "Poisson's ratio over the inclination, macro stiffnesses K_n and K_s of the joints, and sensitivities "
       "to micro-parameters. Writes no file.",
       {},
       {{"", "phyllite elastic examples/pfc2d/specimen.toml"}}},
      {"rock",
       "Laboratory tables before a calibration. A rock is a file in TOML that names a table in CSV: one row "
       "per "
       "angle or test, units in the header.\n\n"
       "`phyllite rock check` begins with its doubts and says how the table was understood. It lists what "
       "the "
       "table determines, which test would determine more, and how a calibration will probably end. "
       "`phyllite rock "
       "twin` makes a table from a recipe, whose parameters are thereby known.",
       {{"NAME.toml, NAME.csv", "written by `phyllite rock new NAME`, with comments"}},
       {{"A rock to be filled in:", "phyllite rock new slate"},
        {"One whose table is there, CSV or .xlsx:",
         "phyllite rock new gneiss --data data/rocks/augen-gneiss/table.csv"},
        {"The same, begun like a rock that was calibrated before:",
         "phyllite rock new schist --data data/rocks/augen-gneiss/table.csv --like augen-gneiss"},
        {"What a measured table determines:", "phyllite rock check data/rocks/augen-gneiss/rock.toml"},
        {"What a key means:", "phyllite rock --explain E_is"}}},
      {"rocks",
       "Measured rocks that come with the program: table, sources, and the errors of a calibration of each "
       "on unseen packings. Without a name it lists them; with a name it shows the card of "
       "one.\n\n"
       "`phyllite rock check` names the nearest of them to a table, and `phyllite rock new NAME --like ROCK` "
       "begins with the grain size, spacing and model of one.",
       {{"FOLDER/rock.toml, table.csv, calibrated.toml, card.json",
         "written by --out: the rock, its table, its calibrated model as a recipe for `phyllite run`, its "
         "card"}},
       {{"The list:", "phyllite rocks"}, {"One of them:", "phyllite rocks boryeong-shale"}}},
      {"show",
       "Prints the tables of a run again, from its folder: packing, strengths, moduli, cracks, quality. A "
       "file that "
       "was changed or cut short since it was written is reported and not shown.",
       {},
       {{"", "phyllite run examples/pfc2d/specimen.toml --out results/pfc2d"},
        {"", "phyllite show results/pfc2d"}}},
      {"replay",
       "Runs stored tests again from their stored recipes, all of a run or an envelope, some of a store, and "
       "compares every number, row and crack with what is stored. Exit status 1 says that something differs.",
       {},
       {{"", "phyllite run examples/pfc2d/specimen.toml --out results/pfc2d"},
        {"", "phyllite replay results/pfc2d"}}},
      {"calibrate",
       "Finds the micro-parameters by which a model meets the table of a rock, with intervals of 95 %. "
       "Moduli "
       "come first, by direct elastic solutions, then strengths, by laboratory tests and a surrogate. The "
       "result is tested on packings that the fit has not seen. Each strength is predicted without its own "
       "value. A verdict says whether the table is met, except for what, or why not. It takes minutes to "
       "hours: "
       "`phyllite rock check` forecasts the end in a second.\n\n"
       "An interrupted calibration goes on with --resume. Exit status 1 says that the rock is out of reach "
       "of the "
       "model, or that the calibration was stopped.",
       {{"calibrated.toml", "the calibrated model as a recipe for `phyllite run`"},
        {"ensemble/", "joint draws from all models that the table allows, for --ensemble"},
        {"calibration.json, tables.txt", "everything found; what was printed"},
        {"report.html", "laboratory beside model, verdict, determined and open parameters"},
        {"calibrated.p2dat, calibrated-yade.py", "for PFC2D and Yade"},
        {"runs.sqlite", "every test that was run"}},
       {{"Moduli of a synthetic shale:",
         "phyllite calibrate examples/twin/twin.toml --elastic --out results/moduli"},
        {"All of it, some minutes on a fast machine:",
         "phyllite calibrate examples/twin/twin.toml --out results/twin"}}},
      {"report",
       "Writes report.html of a run, a study or a calibration anew: one file that a browser opens without a "
       "network.",
       {{"report.html", "in the folder of the result, or as --out says"}},
       {{"", "phyllite run examples/pfc2d/specimen.toml --out results/pfc2d"},
        {"", "phyllite report results/pfc2d --out press.html"}}},
      {"figure",
       "Draws a figure for print from a run, a study or a calibration, through gnuplot, which must be "
       "installed. Figures have the width of a journal's column. Of a calibration, anisotropy shows "
       "laboratory "
       "and model over the inclination; the other kinds of a run draw the specimens that it has kept.",
       {},
       {{"", "phyllite run examples/pfc2d/specimen.toml --out results/pfc2d"},
        {"", "phyllite figure results/pfc2d --kind stress_strain --out curves.pdf"}}},
      {"film",
       "Draws a test frame by frame, with displacements magnified, and encodes it through ffmpeg, which must "
       "be "
       "installed. The ending of the file chooses WebM, MP4 or GIF.",
       {},
       {{"", "phyllite run examples/pfc2d/specimen.toml --out results/pfc2d"},
        {"", "phyllite film results/pfc2d --seconds 1 --width 320 --out press.webm"}}},
      {"export",
       "Writes specimens for another program. `phyllite export pfc2d` writes two command files of PFC2D per "
       "specimen: every disc, platen, bond and joint, and the test. Nobody has run them in PFC2D yet.",
       {{"NAME-specimen.p2dat, NAME-test.p2dat", "the specimen; the test, which calls it"}},
       {{"", "phyllite export pfc2d examples/pfc2d/specimen.toml --out pfc2d"}}},
      {"compare",
       "Reads a stress-strain curve of another program or of a laboratory. Columns are found by name, units "
       "stand in brackets in the header. Prints moduli, strength and strain at the peak beside a result's, "
       "all by the same definitions. Uniaxial compression only.",
       {},
       {{"A result beside itself:", "phyllite run examples/pfc2d/specimen.toml --out results/pfc2d"},
        {"", "phyllite compare results/pfc2d/intact/history.csv results/pfc2d/intact"}}},
      {"envelope",
       "Runs the specimens of a recipe under several confining stresses and fits Mohr-Coulomb, Hoek-Brown "
       "and, "
       "over the inclination, a plane of weakness, with standard errors.",
       {{"envelope.csv, fits.csv", "every test; what was fitted"},
        {"sigma_3_5_MPa/", "a folder per confining stress, which is the folder of a run"}},
       {{"",
         "phyllite envelope examples/pfc2d/specimen.toml --confining \"0 MPa,5 MPa,10 MPa\" --out "
         "results/envelope"}}},
      {"design",
       "Tests draws of a calibration under several confining stresses and fits the constants that other "
       "codes ask for. These are transversely isotropic elasticity, a plane of weakness in a rock, tensile "
       "cut-offs, Hoek-Brown by inclination, and a fabric. Each has a 95 % interval. Tests are kept in the "
       "folder, and the same command goes on with them.",
       {{"results/design/design.csv, covariance.csv", "every constant; covariances of each part"},
        {"results/design/tests.csv, runs.sqlite", "what was fitted; the store of the tests"},
        {"results/design/report.html, design.json", "one sheet, for a browser and for programs"},
        {"results/design/flac-*.dat, plaxis-*.csv, rs2-*.py, ogs-*.xml", "a file per code and model"}},
       {{"Four draws between 0 and 20 MPa:",
         "phyllite design results/twin --draws 4 --stresses \"0 MPa,5 MPa,10 MPa,20 MPa\" --out "
         "results/design"}}},
      {"gui",
       "Serves a page to work in on 127.0.0.1, for a browser on the same machine, and prints its address, "
       "which "
       "is a key: whoever has it can use the page. On it a table is typed or pasted and checked, a rock "
       "calibrated, and tests on the calibrated rock are set up and run. Each button is a command of this "
       "program, which is shown, and leaves the same files in FOLDER. It runs until it is stopped. It then "
       "stops its commands as Ctrl-C does, and they can be resumed.",
       {{"NAME.toml, NAME.csv", "a rock and its table"},
        {"NAME-calibration/, NAME-calibration.log", "its calibration, and what that printed"},
        {"NAME-tests/", "recipes of tests on the calibrated rock, and their results"}},
       {}},
      {"man",
       "Prints a manual page in the language of man(7), or writes all of them, made from the tree of verbs "
       "and "
       "options that also parses the command line.",
       {},
       {{"Read a page of a program that is not installed:", "phyllite man run"},
        {"All pages as files:", "phyllite man --out man1"}}},
      {"completion",
       "Prints a script by which a shell completes verbs, options, their values, files and folders of "
       "`phyllite` at "
       "the key Tab. The Debian package and `make install` put the scripts where the shells look for them. "
       "By hand, "
       "in bash, `source <(phyllite completion bash)` for this session. In zsh the script is a file named "
       "_phyllite in a folder of $fpath. In fish `phyllite completion fish | source`.\n\n"
       "With words behind -- it answers the script. The first line says what else to offer: nothing (words), "
       "files or folders. Every other line is a word, and behind two spaces its meaning.",
       {},
       {{"", "phyllite completion bash"},
        {"What bash would offer:", "phyllite completion bash -- study --"}}}};
  return all;
}

}  // namespace

const ManText& man_text(const std::string& verb) {
  const auto text =
      std::find_if(texts().begin(), texts().end(), [&](const ManText& t) { return t.verb == verb; });
  PHY_CHECK(text != texts().end(), "every verb has its text in cli/man_text.cpp");
  return *text;
}

const std::vector<ManEntry>& exit_codes() {
  static const std::vector<ManEntry> all = {
      {"0", "all well"},
      {"1",
       "a test did not succeed (no peak, unstable, untrusted), a check or comparison failed, a verdict is "
       "out of reach, or a signal stopped the verb"},
      {"2", "the input cannot be used; every problem is reported before anything runs"},
      {"3", "a file cannot be read or written, or standard output could not take everything"},
      {"4", "an error of the program itself"}};
  return all;
}

const std::vector<ManEntry>& environment_variables() {
  static const std::vector<ManEntry> all = {
      {"XDG_CACHE_HOME", "folder of the cache of packings, if it is an absolute path; default: ~/.cache"},
      {"PHYLLITE_ISA", "sse2, avx2 or avx512: at most this instruction set. Changes the speed only"},
      {"LC_ALL, LC_CTYPE, LANG, TERM", "whether curves are drawn on the terminal while tests run"}};
  return all;
}

}  // namespace phy::cli
