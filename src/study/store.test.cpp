// Does the store keep every bit, does nothing run twice, and what is lost when a process is killed?
#include "study/store.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <set>

#include "base/check.hpp"
#include "base/in_folder_fixture.hpp"
#include "base/nan.hpp"
#include "io/toml_in.hpp"
#include "records/test_description.hpp"

namespace phy::study {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

TestResult some_result(int i) {
  TestResult r;
  r.name = "theta = 30 deg", r.intact = false, r.theta = 30.0;
  r.outcome = {Status::peaked, "peak 1/3", ""};
  r.numbers = {{"ucs", 1e8 / 3.0 + i, "Pa", "largest axial stress", ""},
               {"E_tangent", nan, "Pa", "slope", "too few rows"},
               {"A", 1.0, "1", "", "names are not sorted"}};
  for (int k = 0; k < 300; ++k) {
    HistoryRow row;
    row.step = k, row.axial_strain = k / 3.0, row.axial_stress = std::sqrt(k) * 1e6, row.unbalanced = 1e-300;
    r.history.rows.push_back(row);
  }
  CrackEvent c;
  c.step = 4, c.time = 0.1 + i, c.a = 4000000000U, c.mode = CrackMode::shear, c.place = CrackPlace::bedding;
  c.position = {0.1, -1e-17};
  r.cracks = {c, c};
  r.dt = 1e-7 / 3.0, r.n_steps = 1234567890123, r.n_contacts = 7, r.seconds = 1.5;
  r.hash = "hash" + std::to_string(i);
  return r;
}

class StoreTest : public InFolder {
 protected:
  std::string file() const { return at("study.sqlite"); }
  /// A process of its own; it ends without any destructor, as if killed.
  static pid_t start(const std::function<void()>& body) {
    const pid_t child = ::fork();
    if (child != 0) return child;
    try {
      body();
    } catch (...) {
      ::_exit(9);
    }
    ::_exit(0);
  }
  static int wait_for(pid_t child) {
    int status = 0;
    ::waitpid(child, &status, 0);
    return status;
  }
};

TEST_F(StoreTest, GivesBackEveryBit) {
  const TestResult in = some_result(1);
  { Store(file()).put("k", "recipe text", in); }
  const Store store(file());
  const auto row = store.find("k");
  ASSERT_TRUE(row);
  const TestResult& out = row->result;
  EXPECT_EQ(row->recipe, "recipe text");
  EXPECT_EQ(row->n_cracks, 2);
  EXPECT_THAT(row->program, HasSubstr("phyllite "));
  EXPECT_EQ(out.name, in.name);
  EXPECT_EQ(out.theta, in.theta);
  EXPECT_EQ(out.outcome.reason, in.outcome.reason);
  EXPECT_EQ(out.hash, in.hash);
  EXPECT_EQ(out.dt, in.dt);
  EXPECT_EQ(out.n_steps, in.n_steps);
  ASSERT_EQ(out.numbers.size(), in.numbers.size());
  for (std::size_t i = 0; i < in.numbers.size(); ++i) {
    EXPECT_EQ(out.numbers[i].name, in.numbers[i].name);
    EXPECT_EQ(out.numbers[i].unit, in.numbers[i].unit);
    EXPECT_EQ(out.numbers[i].note, in.numbers[i].note);
    if (i != 1) {
      EXPECT_EQ(out.numbers[i].value, in.numbers[i].value);
    }
  }
  EXPECT_TRUE(std::isnan(out.numbers[1].value));
  EXPECT_EQ(phy::hash_of(out), phy::hash_of(in)) << "history and cracks, bit by bit";
  EXPECT_FALSE(store.find("other"));
  EXPECT_EQ(store.rows().size(), 1u);
  EXPECT_EQ(store.rows().front().result.numbers.size(), 3u);
  EXPECT_TRUE(store.rows().front().result.history.rows.empty());
}

TEST_F(StoreTest, ASpecimenIsGivenOutOnce) {
  Store one(file()), two(file());
  EXPECT_EQ(one.claim("k"), Claim::mine);
  EXPECT_EQ(two.claim("k"), Claim::elsewhere);
  EXPECT_EQ(one.claim("k"), Claim::elsewhere) << "it is running already";
  EXPECT_EQ(two.n_claimed(), 1u);
  one.release("k");
  EXPECT_EQ(two.claim("k"), Claim::mine);
  two.put("k", "r", some_result(1));
  EXPECT_EQ(one.claim("k"), Claim::done);
  EXPECT_EQ(one.n_claimed(), 0u);
}

TEST_F(StoreTest, TheFirstRowStays) {
  Store store(file());
  store.put("k", "r", some_result(1));
  store.put("k", "r", some_result(2));
  EXPECT_EQ(store.find("k")->result.hash, "hash1");
  EXPECT_EQ(store.size(), 1u);
}

TEST_F(StoreTest, WhatIsRemovedMayBeRunAgain) {
  Store store(file());
  store.put("k", "r", some_result(1)), store.put("other", "r", some_result(2));
  store.remove("k");
  EXPECT_FALSE(store.find("k"));
  EXPECT_EQ(store.claim("k"), Claim::mine);
  store.put("k", "r", some_result(3));
  EXPECT_EQ(store.find("k")->result.hash, "hash3");
  EXPECT_EQ(store.find("other")->result.hash, "hash2");
}

TEST_F(StoreTest, InterruptedTestsAreNoResults) {
  TestResult r = some_result(1);
  r.outcome.status = Status::interrupted;
  EXPECT_THROW(Store(file()).put("k", "r", r), InternalError);
}

TEST_F(StoreTest, ClaimsOfAKilledProcessAreFreeAtOnce) {
  const pid_t child = start([&] {
    Store store(file());
    store.claim("k");
    store.put("done", "r", some_result(1));
    ::raise(SIGKILL);
  });
  EXPECT_TRUE(WIFSIGNALED(wait_for(child)));
  Store store(file());
  EXPECT_EQ(store.n_claimed(), 0u);
  EXPECT_EQ(store.claim("k"), Claim::mine);
  EXPECT_EQ(store.claim("done"), Claim::done);
}

TEST_F(StoreTest, ClaimsFromElsewhereLastAsLongAsTheirLease) {
  Store store(file());
  const auto foreign = [&](double seconds) {
    io::Database database(file());
    io::Statement(database,
                  "INSERT OR REPLACE INTO claim VALUES ('k', 'other machine|boot|1|1|1', unixepoch() + ?)")
        .bind(seconds)
        .run();
  };
  foreign(30.0);
  EXPECT_EQ(store.claim("k"), Claim::elsewhere);
  foreign(-30.0);
  EXPECT_EQ(store.claim("k"), Claim::mine);
}

TEST_F(StoreTest, ClaimsOfThisMachineBeforeItWasStartedAnewAreFreeAtOnce) {
  Store before(file()), store(file());
  EXPECT_EQ(before.claim("k"), Claim::mine);
  EXPECT_EQ(store.claim("k"), Claim::elsewhere);
  std::string boot;
  std::getline(std::ifstream("/proc/sys/kernel/random/boot_id"), boot);
  io::Database database(file());
  io::Statement(database, "UPDATE claim SET owner = replace(owner, ?, 'an earlier boot')").bind(boot).run();
  EXPECT_EQ(store.n_claimed(), 0u);
  EXPECT_EQ(store.claim("k"), Claim::mine);
}

TEST_F(StoreTest, RenewingProlongsTheLease) {
  Store store(file());
  store.claim("k");
  io::Database database(file());
  database.execute("UPDATE claim SET until = 1");
  store.renew();
  io::Statement until(database, "SELECT until > unixepoch() + 100 FROM claim");
  ASSERT_TRUE(until.step());
  EXPECT_EQ(until.integer(0), 1);
}

TEST_F(StoreTest, ManyProcessesNeverRunASpecimenTwice) {
  constexpr int n_keys = 60, n_processes = 4;
  std::vector<pid_t> children;
  for (int p = 0; p < n_processes; ++p)
    children.push_back(start([&, p] {
      Store store(file());
      std::ofstream log(at(("log" + std::to_string(p)).c_str()));
      for (int i = 0; i < n_keys; ++i) {
        const std::string key = "key" + std::to_string((i + 15 * p) % n_keys);
        if (store.claim(key) != Claim::mine) continue;
        log << key << std::endl;
        store.put(key, "r", some_result(1));
      }
    }));
  for (const pid_t child : children) EXPECT_EQ(wait_for(child), 0);
  std::multiset<std::string> run;
  for (int p = 0; p < n_processes; ++p) {
    std::ifstream log(at(("log" + std::to_string(p)).c_str()));
    for (std::string key; log >> key;) run.insert(key);
  }
  EXPECT_EQ(run.size(), n_keys);
  EXPECT_EQ(std::set<std::string>(run.begin(), run.end()).size(), n_keys);
  EXPECT_EQ(Store(file()).size(), n_keys);
}

TEST_F(StoreTest, HashDependsOnResultsOnly) {
  Store a(at("a.sqlite")), b(at("b.sqlite"));
  a.put("1", "r", some_result(1)), a.put("2", "r", some_result(2));
  TestResult slow = some_result(1);
  slow.seconds = 99.0;
  b.put("2", "r", some_result(2)), b.put("1", "r", slow);
  EXPECT_EQ(hash_of(a.rows({"1", "2"})), hash_of(b.rows({"2", "1"})));
  b.put("3", "r", some_result(3));
  EXPECT_EQ(b.keys(), (std::vector<std::string>{"1", "2", "3"}));
  EXPECT_NE(hash_of(a.rows(a.keys())), hash_of(b.rows(b.keys())));
  EXPECT_EQ(hash_of(a.rows({"1", "2", "3"})), hash_of(b.rows({"1", "2"}))) << "of the rows asked for";
}

TEST_F(StoreTest, MergeAddsWhatIsMissingAndTellsWhatDiffers) {
  Store a(at("a.sqlite"));
  a.put("1", "r", some_result(1)), a.put("2", "r", some_result(2));
  {
    Store b(at("b.sqlite"));
    b.put("2", "r", some_result(22)), b.put("3", "r", some_result(3)), b.put("1", "r", some_result(1));
  }
  const MergeReport report = a.merge(at("b.sqlite"));
  EXPECT_EQ(report.n_added, 1u);
  EXPECT_EQ(report.n_known, 2u);
  EXPECT_EQ(report.different, std::vector<std::string>{"2"});
  EXPECT_EQ(a.find("3")->result.numbers.size(), 3u);
  EXPECT_EQ(phy::hash_of(a.find("3")->result), phy::hash_of(some_result(3)));
  EXPECT_EQ(a.find("2")->result.hash, "hash2");
  EXPECT_THAT(message_of<IoError>([&] { a.merge(at("none.sqlite")); }), HasSubstr("no such file"));
  EXPECT_FALSE(fs::exists(at("none.sqlite")));
}

TEST_F(StoreTest, WhatIsNoStoreIsRefused) {
  fs::create_directories(folder);
  std::ofstream(file()) << std::string(2000, 'x');
  EXPECT_THAT(message_of<IoError>([&] { Store s(file()); }), HasSubstr("no store or a damaged one"));
  io::Database(at("foreign.sqlite")).execute("CREATE TABLE mine (x)");
  EXPECT_THAT(message_of<IoError>([&] { Store s(at("foreign.sqlite")); }),
              HasSubstr("is no store of phyllite"));
  { Store s(at("new.sqlite")); }
  io::Database(at("new.sqlite")).execute("PRAGMA user_version = 99");
  EXPECT_THAT(message_of<IoError>([&] { Store s(at("new.sqlite")); }), HasSubstr("has format 99"));
  fs::create_directories(at("folder.sqlite"));
  EXPECT_THAT(message_of<IoError>([&] { Store s(at("folder.sqlite")); }), HasSubstr("cannot be"));
}

TEST_F(StoreTest, AnEarlierFormatIsRefusedAndLeftAsItIs) {
  { Store(file()).put("k", "r", some_result(1)); }
  io::Database(file()).execute("PRAGMA user_version = 2");
  for (const Sharing sharing : {Sharing::shared, Sharing::alone, Sharing::reading})
    EXPECT_THAT(message_of<IoError>([&] { Store s(file(), sharing); }),
                testing::AllOf(HasSubstr("has format 2, not 3"), HasSubstr("an earlier version")));
  io::Database(file()).execute("PRAGMA user_version = 3");
  EXPECT_EQ(phy::hash_of(Store(file()).find("k")->result), phy::hash_of(some_result(1)));
}

TEST_F(StoreTest, AShardHasItsStoreForItself) {
  {
    Store mine(file(), Sharing::alone);
    mine.put("k", "r", some_result(1));
    EXPECT_FALSE(fs::exists(file() + "-shm")) << "no memory shared with other processes";
    io::Database other(file(), 10);
    EXPECT_THAT(message_of<IoError>([&] { other.execute("SELECT * FROM specimen"); }),
                HasSubstr("keeps it locked"));
  }
  EXPECT_EQ(Store(file()).size(), 1u);
}

// What a hand or a failing disk may do to a file, each for itself.
TEST_F(StoreTest, WhatWasChangedIsTold) {
  Store store(file());
  store.put("k", "r", some_result(1)), store.put("whole", "r", some_result(2));
  for (const char* change :
       {"number SET value = value * 2 WHERE name = 'ucs'", "number SET value = 1 WHERE name = 'E_tangent'",
        "number SET unit = 'MPa'", "specimen SET status = 'not peaked'", "specimen SET result_hash = 'hash9'",
        "specimen SET recipe = 'r2'", "specimen SET theta = 31", "specimen SET program = 'phyllite 9'",
        "specimen SET history = substr(history, 1, 100)",
        "specimen SET cracks = (SELECT history FROM specimen WHERE key = 'whole')",
        "specimen SET checksum = ''"}) {
    io::Database database(file());
    database.execute("BEGIN; UPDATE " + std::string(change) +
                     (std::string(change).find("WHERE name") == std::string::npos ? " WHERE key = 'k'"
                                                                                  : " AND key = 'k'") +
                     "; COMMIT");
    EXPECT_THAT(message_of<IoError>([&] { store.find("k"); }),
                testing::AllOf(HasSubstr("not as this program stored them"), HasSubstr("k (theta = 30 deg)")))
        << change;
    EXPECT_NO_THROW(store.find("whole"));
    database.execute("DELETE FROM specimen WHERE key = 'k'");  // as the message says
    store.put("k", "r", some_result(1));
    EXPECT_EQ(phy::hash_of(store.find("k")->result), phy::hash_of(some_result(1)));
    EXPECT_EQ(store.rows().size(), 2u);
  }
}

TEST_F(StoreTest, TheHashOfAStudyCoversItsNumbers) {
  Store a(at("a.sqlite")), b(at("b.sqlite"));
  TestResult other = some_result(1);
  other.numbers[0].value *= 2.0;
  a.put("1", "r", some_result(1)), b.put("1", "r", other);
  EXPECT_NE(hash_of(a.rows({"1"})), hash_of(b.rows({"1"})));
  EXPECT_EQ(a.merge(at("b.sqlite")).different, std::vector<std::string>{"1"});
}

TEST_F(StoreTest, ARecordThatWasRemovedAsAdvisedIsMergedAnew) {
  Store a(at("a.sqlite"));
  a.put("1", "r", some_result(1));
  { Store(at("b.sqlite")).put("1", "r", some_result(1)); }
  io::Database(at("a.sqlite")).execute("DELETE FROM specimen WHERE key = '1'");  // numbers stay behind
  EXPECT_EQ(a.merge(at("b.sqlite")).n_added, 1u);
  EXPECT_EQ(phy::hash_of(a.find("1")->result), phy::hash_of(some_result(1)));
}

TEST_F(StoreTest, ADamagedRecordIsNotMerged) {
  Store a(at("a.sqlite"));
  a.put("1", "r", some_result(1));
  { Store(at("b.sqlite")).put("2", "r", some_result(2)); }
  io::Database(at("b.sqlite")).execute("UPDATE number SET value = 2 * value");
  EXPECT_THAT(message_of<IoError>([&] { a.merge(at("b.sqlite")); }),
              testing::AllOf(HasSubstr("b.sqlite"), HasSubstr("not as this program stored them")));
  EXPECT_EQ(a.rows().size(), 1u);
}

TEST_F(StoreTest, IsNotMergedWithItself) {
  Store store(file());
  fs::create_symlink(file(), at("link.sqlite"));
  for (const std::string& name : {file(), at("link.sqlite")})
    EXPECT_THAT(message_of<InputError>([&] { store.merge(name); }), HasSubstr("another store"));
}

}  // namespace
}  // namespace phy::study
