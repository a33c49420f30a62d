// What a user has after `make install` or from a package: files, manual pages, completion, one version. The
// tree of verbs is read from --help, which neither pages nor completion are made of.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "../program.hpp"

namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;
using testing::UnorderedElementsAre;
using Words = std::vector<std::string>;

Words lines_of(const std::string& text) {
  Words lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::string slurp(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// A verb as its --help shows it.
struct Help {
  std::set<std::string> verbs, options, closed;  ///< closed: words of "{a,b}"
};

class Install : public ProgramTest {
 protected:
  Help help_of(const std::string& verb) {
    EXPECT_EQ(run(verb + " --help"), 0) << output;
    Help help;
    std::smatch match;
    bool verbs = false;
    for (const std::string& line : lines_of(output)) {
      if (!line.empty() && line[0] != ' ') verbs = line == "Subcommands:";
      if (verbs && std::regex_search(line, match, std::regex("^  ([a-z0-9]+) "))) help.verbs.insert(match[1]);
      if (!verbs && std::regex_search(line, match, std::regex("^  (?:-h,)?(--[A-Za-z-]+)")))
        help.options.insert(match[1]);
      if (!verbs && std::regex_search(line, match, std::regex("^  [^ ].*\\{(.*)\\}"))) {
        std::istringstream words(match[1]);
        for (std::string word; std::getline(words, word, ',');) help.closed.insert(word);
      }
    }
    return help;
  }
  /// All verbs, "study effects" among them, with their help; "" is the program.
  std::map<std::string, Help> tree() {
    std::map<std::string, Help> all = {{"", help_of("")}};
    for (const std::string& verb : all[""].verbs) {
      all[verb] = help_of(verb);
      for (const std::string& below : all[verb].verbs) all[verb + " " + below] = help_of(verb + " " + below);
    }
    return all;
  }
  /// A manual page without the marks of its language.
  std::string page(const std::string& verb) {
    EXPECT_EQ(run("man " + verb), 0) << output;
    std::string text = std::regex_replace(output, std::regex("\\\\f[BIR]"), "");
    return std::regex_replace(text, std::regex("\\\\-"), "-");
  }
  /// What bash offers for the last word, by the script that it loads; what the shell itself would offer
  /// besides comes first, as "-o default".
  Words tab(const Words& words) {
    std::string array;
    for (const std::string& word : words) array += " '" + word + "'";
    write("tab.sh", "source <(\"$1\" completion bash)\ncompopt() { echo \"$*\"; }\nCOMP_WORDS=(\"$1\"" +
                        array + ")\nCOMP_CWORD=" + std::to_string(words.size()) +
                        "\n_phyllite \"$1\"\nprintf '%s\\n' \"${COMPREPLY[@]}\"\n");
    EXPECT_EQ(run_line("cd " + folder.string() + " && bash --norc tab.sh " + PHY_PROGRAM), 0) << output;
    Words offered = lines_of(output);
    std::erase(offered, "");
    return offered;
  }
};

TEST_F(Install, EveryVerbAndOptionHasItsPlaceInTheManualAndInTheCompletion) {
  const auto all = tree();
  ASSERT_GT(all.size(), 25U);
  ASSERT_GT(all.at("study").options.size(), 7U);
  for (const auto& [verb, help] : all) {
    const std::string text = page(verb.substr(0, verb.find(' ')));
    Words words;
    std::istringstream in(verb);
    for (std::string word; in >> word;) words.push_back(word);
    Words with_dash = words, with_verb = words;
    with_dash.push_back("--"), with_verb.push_back("");
    const Words options = tab(with_dash), verbs = tab(with_verb);
    for (const std::string& option : help.options) {
      EXPECT_THAT(text, HasSubstr(option)) << "man page of " << verb;
      EXPECT_THAT(options, Contains(option)) << verb;
    }
    EXPECT_THAT(options, Contains("--threads")) << verb;
    for (const std::string& below : help.verbs) {
      EXPECT_THAT(text, HasSubstr(verb.empty() ? "phyllite-" + below + "(1)" : verb + " " + below));
      EXPECT_THAT(verbs, Contains(below)) << verb;
    }
    for (const std::string& word : help.closed) EXPECT_THAT(text, HasSubstr(word)) << verb;
    for (const char* section : {"NAME", "SYNOPSIS", "DESCRIPTION", "OPTIONS", "EXIT STATUS", "EXAMPLES"})
      EXPECT_THAT(text, HasSubstr(std::string(".SH ") + section + "\n")) << verb;
  }
}

TEST_F(Install, BashCompletesVerbsOptionsValuesFilesAndFolders) {
  EXPECT_THAT(tab({"cal"}), UnorderedElementsAre("calibrate"));
  EXPECT_THAT(tab({"study", "ef"}), UnorderedElementsAre("effects"));
  EXPECT_THAT(tab({"calibrate", "rock.toml", "--met"}), UnorderedElementsAre("--method"));
  EXPECT_THAT(tab({"calibrate", "--method", ""}), UnorderedElementsAre("posterior", "sequence"));
  EXPECT_THAT(tab({"calibrate", "--method", "=", "se"}), UnorderedElementsAre("sequence"));
  EXPECT_THAT(tab({"figure", "results", "--format", "="}),
              UnorderedElementsAre("svg", "pdf", "png", "terminal"));
  EXPECT_THAT(tab({"--threads", "2", "run", "--lanes", "1"}), UnorderedElementsAre("1", "16"));
  EXPECT_THAT(tab({"rock", "twin", "--E-is", "tan"}), UnorderedElementsAre("-o filenames", "tangent 50 %"));
  EXPECT_THAT(tab({"figure", "results", "--kind", "st"}),
              UnorderedElementsAre("stress_strain", "stiffness", "strength"));
  EXPECT_THAT(tab({"contact", "flat"}), UnorderedElementsAre("flat_joint"));
  EXPECT_THAT(tab({"recipe", "--explain", "bedding.k_"}), UnorderedElementsAre("bedding.k_n", "bedding.k_s"));
  EXPECT_THAT(tab({"verify", "V1"}), Contains("V12"));
  EXPECT_THAT(tab({"run", "x.toml", "--out", ""}), UnorderedElementsAre("-o dirnames"));
  EXPECT_THAT(tab({"run", ""}), UnorderedElementsAre("-o default"));
  EXPECT_THAT(tab({"run", "a.toml", "b"}), UnorderedElementsAre("-o default"));  // as many as one likes
  EXPECT_THAT(tab({"show", ""}), UnorderedElementsAre("-o dirnames"));
  EXPECT_THAT(tab({"elastic", "a.toml", "--pr"}), UnorderedElementsAre("--press"));
  EXPECT_THAT(tab({"elastic", "--press", "--pr"}), testing::IsEmpty());  // given already
  EXPECT_THAT(tab({"contact", "linear", "--to", "1 um, 0 um, 0 deg", "--to"}), UnorderedElementsAre("--to"));
  EXPECT_THAT(tab({"crush", "--o"}), testing::IsEmpty());
  write("study-of-mine.toml", "");  // verbs and files
  EXPECT_THAT(tab({"study", "st"}), UnorderedElementsAre("-o filenames", "status", "study-of-mine.toml"));
}

TEST_F(Install, ZshReadsItsScript) {
  if (!has("zsh")) GTEST_SKIP() << "no zsh here";
  EXPECT_EQ(run_line(PHY_PROGRAM " completion zsh > " + at("zsh") + " && zsh -n " + at("zsh")), 0) << output;
}

TEST_F(Install, FishCompletes) {
  if (!has("fish")) GTEST_SKIP() << "no fish here";
  EXPECT_EQ(run_line(PHY_PROGRAM " completion fish > " + at("fish") + " && fish -n " + at("fish")), 0)
      << output;
  const std::string path = "PATH=" + fs::path(PHY_PROGRAM).parent_path().string() + ":$PATH ";
  write("tab.fish",
        "phyllite completion fish | source\ncomplete -C 'phyllite study ef'\n"
        "complete -C 'phyllite figure x --kind ro'\n");
  EXPECT_EQ(run_line("HOME=" + folder.string() + " " + path + "fish --no-config " + at("tab.fish")), 0);
  EXPECT_THAT(output, HasSubstr("effects\tcurves, regressions"));
  EXPECT_THAT(output, HasSubstr("rose"));
}

TEST_F(Install, PagesAreCleanForThoseWhoReadThem) {
  ASSERT_EQ(run("man --out " + out()), 0) << output;
  ASSERT_TRUE(fs::exists(fs::path(out()) / "phyllite-run.1"));
  if (has("man")) {
    EXPECT_EQ(run_line("for f in " + out() + "/*.1; do man --warnings -l $f 2>&1 >/dev/null; done"), 0);
    EXPECT_EQ(output, "");
  }
  if (has("mandoc")) {
    EXPECT_EQ(run_line("mandoc -Tlint -Wwarning " + out() + "/*.1"), 0) << output;
  }
}

/// All but those of minutes, on the examples with a specimen of 330 discs in place of larger ones.
TEST_F(Install, ExamplesOfThePagesRun) {
  fs::copy(fs::path(PHY_SOURCE_DIR) / "examples", at("examples"), fs::copy_options::recursive);
  fs::copy(fs::path(PHY_SOURCE_DIR) / "data", at("data"), fs::copy_options::recursive);
  for (const char* recipe : {"pfc2d/specimen", "paper/press", "lab/brazilian"})
    fs::copy(small_recipe(), at("examples/") + recipe + ".toml", fs::copy_options::overwrite_existing);
  const std::set<std::string> long_ones = {"phyllite verify", "phyllite verify --hash",
                                           "phyllite calibrate examples/twin/twin.toml --out results/twin"};
  const bool figures = has("gnuplot"), films = has("ffmpeg");
  std::set<std::string> done;
  std::string pages = page("");
  for (const std::string& verb : help_of("").verbs) pages += page(verb);
  bool example = false;
  for (std::string line : lines_of(pages)) {
    if (line == ".EX" || line == ".EE") example = line == ".EX";
    if (!example || !line.starts_with("phyllite ") || long_ones.contains(line) || !done.insert(line).second)
      continue;
    if (line.starts_with("phyllite design ")) continue;  // of a calibration, which is one of them
    if ((line.find(" figure ") != line.npos && !figures) || (line.find(" film ") != line.npos && !films))
      continue;
    // 1: of so few discs a test without a peak or a solution is no wonder
    EXPECT_THAT(run_line("cd " + folder.string() + " && " + PHY_PROGRAM + line.substr(8)),
                testing::AnyOf(0, 1))
        << line << "\n"
        << output;
  }
  EXPECT_GT(done.size(), 25U);
}

TEST_F(Install, FilesAreWhereTheyBelongAndTheProgramRunsThere) {
  const std::string build = fs::path(PHY_PROGRAM).parent_path().string();
  for (const auto& [prefix, zsh] : {std::pair<std::string, std::string>{"/usr", "vendor-completions"},
                                    {"/opt/phyllite", "site-functions"}}) {
    const std::string to = at("root" + fs::path(prefix).filename().string());
    ASSERT_EQ(
        run_line("DESTDIR=" + to + " cmake --install " + build + " --component program --prefix " + prefix),
        0)
        << output;
    EXPECT_EQ(std::distance(fs::directory_iterator(to), {}), 1);  // nothing beside the prefix
    const std::string at_prefix = to + prefix;
    for (const std::string& file :
         {std::string("bin/phyllite"), std::string("share/man/man1/phyllite.1.gz"),
          std::string("share/bash-completion/completions/phyllite"),
          std::string("share/fish/vendor_completions.d/phyllite.fish"), "share/zsh/" + zsh + "/_phyllite",
          std::string("share/doc/phyllite/copyright"), std::string("share/doc/phyllite/README.md"),
          std::string("share/doc/phyllite/docs/install.md"),
          std::string("share/doc/phyllite/data/rocks/th26-shale/card.json")})
      EXPECT_TRUE(fs::exists(fs::path(at_prefix) / file)) << file;
    for (const std::string& verb : help_of("").verbs)
      EXPECT_TRUE(fs::exists(at_prefix + "/share/man/man1/phyllite-" + verb + ".1.gz")) << verb;
    const std::string program = at_prefix + "/bin/phyllite ";
    EXPECT_EQ(run_line("cd " + folder.string() + " && " + program + "recipe " + at_prefix +
                       "/share/doc/phyllite/examples/lab/brazilian.toml"),
              0)
        << output;
    EXPECT_EQ(
        run_line(program + "rock check " + at_prefix + "/share/doc/phyllite/data/rocks/th26-shale/rock.toml"),
        0)
        << output;
    EXPECT_EQ(run_line("zcat " + at_prefix + "/share/man/man1/phyllite-run.1.gz"), 0);
    EXPECT_THAT(output, HasSubstr(".SH EXAMPLES"));
  }
}

// Of everything that the program holds, and every text that its holder asks to be handed on.
TEST_F(Install, TheLicencesOfWhatTheProgramContainsAreShown) {
  ASSERT_EQ(run("--licences"), 0) << output;
  EXPECT_EQ(output, slurp(fs::path(PHY_SOURCE_DIR) / "packaging/copyright"));
  for (const char* library : {"CLI11", "xxHash", "toml++", "nlohmann-json", "fmt", "Eigen", "Boost", "SQLite",
                              "pugixml", "zlib", "Observable", "D3"})
    EXPECT_THAT(output, HasSubstr(library));
  std::set<std::string> named, told;
  const std::regex field("(?:^|\\n)License: ([^\\n]*)");
  for (auto m = std::sregex_iterator(output.begin(), output.end(), field); m != std::sregex_iterator(); ++m) {
    std::istringstream words((*m)[1]);
    const bool with_text = output.compare(m->position() + m->length(), 2, "\n ") == 0;
    for (std::string word; words >> word;)
      if (word != "and") (with_text ? told : named).insert(word);
  }
  EXPECT_GE(named.size(), 7U);
  EXPECT_EQ(named, told);
  // The pages carry those of their parts by themselves: whoever gets a report has no other file.
  for (const char* name : {"web/report.html", "web/gui.html"})
    EXPECT_THAT(slurp(fs::path(PHY_SOURCE_DIR) / name),
                HasSubstr("<!-- " + slurp(fs::path(PHY_SOURCE_DIR) / "web/LICENCES").substr(0, 2500)))
        << name;
}

TEST_F(Install, TheProgramIsGuardedAndTellsNoFolder) {
  if (!has("readelf")) GTEST_SKIP() << "no readelf here";
  ASSERT_EQ(run_line("readelf -Wdl " PHY_PROGRAM), 0);
  EXPECT_THAT(output, HasSubstr("GNU_RELRO"));
  EXPECT_THAT(output, testing::ContainsRegex("BIND_NOW|Flags: NOW"));
  EXPECT_THAT(output, HasSubstr("DYN"));                           // can be loaded anywhere
  EXPECT_THAT(output, testing::ContainsRegex("GNU_STACK.* RW "));  // and runs no data
  EXPECT_EQ(slurp(PHY_PROGRAM).find(PHY_SOURCE_DIR "/"), std::string::npos);
#ifdef PHY_GUARDED
  ASSERT_EQ(run_line("readelf -W --dyn-syms " PHY_PROGRAM), 0);
  EXPECT_THAT(output, HasSubstr("__stack_chk_fail"));
  EXPECT_THAT(output, testing::ContainsRegex("__mem(cpy|move|set)_chk|__read_chk|__s?n?printf_chk"));
#endif
}

TEST_F(Install, ThereIsOneVersion) {
  const fs::path root = PHY_SOURCE_DIR;
  const auto found = [&](const std::string& text, const std::string& expression) {
    std::smatch match;
    return std::regex_search(text, match, std::regex(expression)) ? match[1].str()
                                                                  : "nothing of " + expression;
  };
  const std::string changes = slurp(root / "CHANGELOG.md"), citation = slurp(root / "CITATION.cff");
  // the first section: this program, a release or what will be one
  const std::string here = found(changes, "\n## ([0-9.]+(?:-dev)?), [0-9]{4}-[0-9]{2}-[0-9]{2}\n");
  const std::string version = here.substr(0, here.find('-'));
  ASSERT_EQ(run("--version"), 0);
  const bool released = here == version;
  const std::string commit = released ? "" : "(\\+[0-9a-f]{8}(\\.changed)?)?";
  EXPECT_TRUE(std::regex_match(output, std::regex("phyllite " + here + commit + "\n"))) << output;
  const std::string program = output.substr(0, output.size() - 1);
  EXPECT_THAT(page("run"),
              HasSubstr(" " + found(changes, "\n## [0-9.]+(?:-dev)?, ([0-9-]+)\n") + " \"" + program + "\""));
  // what is cited was released
  EXPECT_EQ(found(citation, "\nversion: (\\S+)\n"), found(changes, "\n## ([0-9.]+), [0-9-]+\n"));
  EXPECT_EQ(found(citation, "\ndate-released: (\\S+)\n"), found(changes, "\n## [0-9.]+, ([0-9-]+)\n"));
  const std::string build = fs::path(PHY_PROGRAM).parent_path().string();
  EXPECT_EQ(found(slurp(build + "/CPackConfig.cmake"), "CPACK_PACKAGE_VERSION \"([^\"]+)\""),
            version + (released ? "" : "~dev"));
  // Nowhere else is it written down, but in cards: which program made them.
  EXPECT_NE(run_line("grep -rnFw --exclude=rocks.md '" + version + "' " + (root / "README.md").string() +
                     " " + (root / "docs").string() + " " + (root / "src").string() + " " +
                     (root / "python").string() + " " + (root / "packaging").string() + " " +
                     (root / "web/src").string() + " " + (root / "CMakeLists.txt").string()),
            0)
      << output;
}

}  // namespace
