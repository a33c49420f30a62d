#include "study/mpi.hpp"

#ifdef PHY_MPI
#include <mpi.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <exception>
#include <limits>
#include <nlohmann/json.hpp>
#include <thread>
#include <type_traits>

#include "base/hash.hpp"
#include "base/parallel.hpp"
#include "base/version.hpp"
#include "io/toml_in.hpp"
#include "records/test_description.hpp"
#include "system/process.hpp"
#endif

#include "base/check.hpp"
#include "study/store_queue.hpp"
#include "study/worker.hpp"

namespace phy::study {

#ifndef PHY_MPI

Ranks::Ranks(int) {
  throw InputError(Problem{"command line", "--mpi", "", "a program built with MPI",
                           "build it with cmake -DPHY_MPI=ON, or run the shards of a study (--shard i/n)"});
}
Ranks::~Ranks() = default;
WorkReport work_as_host(const Ranks*, StoreQueue& queue, const Plan& plan, const MachineOptions& machine) {
  return work_at(queue, plan, machine);
}
void work_as_guest(const Ranks&, const MachineOptions&, const std::atomic<bool>&) {}

#else

namespace {

using nlohmann::json;
constexpr int request_tag = 1, answer_tag = 2, plan_tag = 3;
constexpr std::chrono::microseconds pause{
    500};  // between looks for a message; MPI's own waiting would take a core

void send(const json& message, int to, int tag) {
  // CBOR: exact doubles, NaN among them, and blocks of bytes.
  const std::vector<std::uint8_t> bytes = json::to_cbor(message);
  PHY_CHECK(bytes.size() <= static_cast<std::size_t>(std::numeric_limits<int>::max()),
            "a message between ranks has less than 2 GB");
  MPI_Send(bytes.data(), static_cast<int>(bytes.size()), MPI_BYTE, to, tag, MPI_COMM_WORLD);
}

json receive(const MPI_Status& status) {
  int size = 0;
  MPI_Get_count(&status, MPI_BYTE, &size);
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(size));
  MPI_Recv(bytes.data(), size, MPI_BYTE, status.MPI_SOURCE, status.MPI_TAG, MPI_COMM_WORLD,
           MPI_STATUS_IGNORE);
  return json::from_cbor(bytes);
}

/// Looks for a message without waiting; false if there is none.
bool look(int from, int tag, MPI_Status& status) {
  int there = 0;
  MPI_Iprobe(from, tag, MPI_COMM_WORLD, &there, &status);
  return there != 0;
}

/// The next message of rank 0, awaited by looking now and then.
json await(int tag) {
  MPI_Status status;
  while (!look(0, tag, status)) std::this_thread::sleep_for(pause);
  return receive(status);
}

// Rows of plain numbers travel as their bytes: all ranks run one version of the program (plan_in).
template <class Row>
json packed(const std::vector<Row>& rows) {
  static_assert(std::is_trivially_copyable_v<Row>);
  const auto* first = reinterpret_cast<const std::uint8_t*>(rows.data());
  return json::binary({first, first + rows.size() * sizeof(Row)});
}

template <class Row>
std::vector<Row> rows_of(const json& packed) {
  const auto& bytes = packed.get_binary();
  std::vector<Row> rows(bytes.size() / sizeof(Row));
  if (!rows.empty()) std::memcpy(rows.data(), bytes.data(), bytes.size());
  return rows;
}

/// Numbers, history, cracks, acoustic events, wall of an opening, pictures.
json packed(const TestResult& r) {
  json numbers = json::array(), snapshots = json::array(), frames = json::array();
  for (const Number& n : r.numbers)
    numbers.push_back({n.name, n.value, n.unit, n.definition, n.note, n.upper_bound});
  // A store has no room for pictures, but rank 0 writes the specimens of a calibration with theirs.
  for (const Snapshot& s : r.snapshots)
    snapshots.push_back({s.step, s.axial_strain, s.axial_stress, packed(s.grains), packed(s.contacts)});
  for (const Frame& f : r.frames) frames.push_back({f.step, f.axial_strain, f.axial_stress, packed(f.u)});
  return {{"name", r.name},
          {"kinds", {r.kind->name, r.history.kind->name}},
          {"intact", r.intact},
          {"theta", r.theta},
          {"outcome", {static_cast<int>(r.outcome.status), r.outcome.reason, r.outcome.advice}},
          {"numbers", numbers},
          {"history", {r.history.width, r.history.height, packed(r.history.rows)}},
          {"cracks", packed(r.cracks)},
          {"events", packed(r.events)},
          {"wall", packed(r.wall)},
          {"snapshots", snapshots},
          {"frames", frames},
          {"dt", r.dt},
          {"counts", {r.n_steps, r.n_contacts, r.n_grains}},
          {"seconds", r.seconds},
          {"hash", r.hash}};
}

TestResult unpacked(const json& j) {
  TestResult r;
  r.name = j["name"], r.intact = j["intact"], r.theta = j["theta"];
  r.kind = TestKind(j["kinds"][0].get<std::string>());
  r.outcome = {static_cast<Status>(j["outcome"][0].get<int>()), j["outcome"][1], j["outcome"][2]};
  for (const json& n : j["numbers"]) r.numbers.push_back({n[0], n[1], n[2], n[3], n[4], n[5]});
  const json& history = j["history"];
  r.history = {TestKind(j["kinds"][1].get<std::string>()), history[0], history[1],
               rows_of<HistoryRow>(history[2])};
  r.cracks = rows_of<CrackEvent>(j["cracks"]);
  r.events = rows_of<AcousticEvent>(j["events"]);
  r.wall = rows_of<WallPoint>(j["wall"]);
  for (const json& s : j["snapshots"])
    r.snapshots.push_back({s[0], s[1], s[2], rows_of<GrainState>(s[3]), rows_of<ContactState>(s[4])});
  for (const json& f : j["frames"])
    r.frames.push_back({f[0], f[1], f[2], rows_of<std::array<float, 2> >(f[3])});
  r.dt = j["dt"];
  r.n_steps = j["counts"][0], r.n_contacts = j["counts"][1], r.n_grains = j["counts"][2];
  r.seconds = j["seconds"], r.hash = j["hash"];
  return r;
}

/// What a plan is about: the program, and keys that are fingerprints of complete recipes.
std::uint64_t fingerprint(const Plan& plan) {
  Hash h;
  h.add(std::string_view(version));
  for (const PlannedTest& t : plan.tests) h.add(t.key);
  return h.value();
}

json packed(const Plan& plan) {
  json recipes = json::array();
  for (const PlannedTest& t : plan.tests) recipes.push_back(io::write_recipe(t.recipe));
  return {{"solver", static_cast<int>(plan.study.solver)},
          {"recipes", recipes},
          {"fingerprint", fingerprint(plan)}};
}

/// Batches and groups are numbered as on rank 0, in the order of the tests; those of a shard hold all tests.
Plan plan_in(const json& j) {
  std::vector<Recipe> recipes;
  for (const json& text : j["recipes"])
    recipes.push_back(io::parse_recipe(text.get<std::string>(), "a recipe of rank 0"));
  Plan plan = plan_of(recipes, static_cast<Solver>(j["solver"].get<int>()));
  if (fingerprint(plan) != j["fingerprint"].get<std::uint64_t>())
    throw InputError(Problem{"command line", "--mpi", "", "one version of the program on every rank",
                             "let all ranks run the same file, and read the same packing.file"});
  return plan;
}

/// The task queue of rank 0 as seen from another rank.
class RemoteQueue : public TaskQueue {
 public:
  /// `stop`: this rank is to end soon, whatever the others do.
  explicit RemoteQueue(const std::atomic<bool>& stop) : stop_(stop) {}
  Assignment enter() override {
    const json a = ask({{"ask", "enter"}});
    return {static_cast<Assignment::Kind>(a[0].get<int>()), a[1], a[2]};
  }
  void leave(std::size_t batch, std::optional<std::size_t> last) override {
    ask(at_batch("leave", batch, last));
  }
  std::optional<std::size_t> take(std::size_t batch, std::optional<std::size_t> last) override {
    const json a = ask(at_batch("take", batch, last));
    return a.is_null() ? std::nullopt : std::optional<std::size_t>(a.get<std::size_t>());
  }
  void deliver(std::size_t test, TestResult result) override {
    ask({{"ask", "deliver"}, {"test", test}, {"host", system::host_name()}, {"result", packed(result)}});
  }
  void count(double work) override { stopped_ = ask({{"ask", "count"}, {"work", work}}).get<bool>(); }
  bool stopped() override { return stop_ || stopped_; }  // of rank 0: as of the last block
  void end(const WorkReport& report) {
    const LaneUse& use = report.lanes;
    ask({{"ask", "end"},
         {"cpu", report.cpu_seconds},
         {"wall", report.wall_seconds},
         {"idle", report.idle},
         {"lanes", {use.test_steps, use.lane_steps, use.alone_steps, use.contact_steps, use.seconds}}});
  }

 private:
  std::mutex mutex_;  // one question of this rank at a time
  const std::atomic<bool>& stop_;
  std::atomic<bool> stopped_{false};
  static json at_batch(const char* what, std::size_t batch, std::optional<std::size_t> last) {
    json request = {{"ask", what}, {"batch", batch}};
    if (last) request["last"] = *last;
    return request;
  }
  json ask(const json& request) {
    const std::lock_guard lock(mutex_);
    send(request, 0, request_tag);
    return await(answer_tag);
  }
};

/// Answers the other ranks until all have ended, also after an error here: they are asked to stop and end
/// soon.
class Server {
 public:
  Server(StoreQueue& queue, int n_guests) : queue_(queue), n_left_(n_guests) {}
  std::vector<WorkReport> reports;

  /// Throws the first error again, at the end.
  void run() {
    std::exception_ptr error;
    while (n_left_ > 0) {
      MPI_Status status;
      if (!look(MPI_ANY_SOURCE, request_tag, status)) {
        std::this_thread::sleep_for(pause);
        continue;
      }
      const json request = receive(status);
      json reply = true;  // stop
      try {
        reply = answer(request);
      } catch (...) {  // of the store
        if (!error) error = std::current_exception();
        queue_.close();
        // The guest waits for an answer and must get one. Delivering again could fail again; everything else
        // is answered "stop" by the closed queue.
        if (request["ask"] != "deliver") reply = answer(request);  // a closed queue touches no store
      }
      send(reply, status.MPI_SOURCE, answer_tag);
    }
    if (error) std::rethrow_exception(error);
  }

 private:
  StoreQueue& queue_;
  int n_left_;

  json answer(const json& q) {
    const std::string what = q["ask"];
    if (what == "enter") {
      const Assignment a = queue_.enter();
      return {static_cast<int>(a.kind), a.batch, a.n_tests};
    }
    std::optional<std::size_t> last;
    if (q.contains("last")) last = q["last"].get<std::size_t>();
    if (what == "leave") queue_.leave(q["batch"], last);
    if (what == "take") {
      const auto test = queue_.take(q["batch"], last);
      return test ? json(*test) : json(nullptr);
    }
    if (what == "deliver") queue_.deliver_from(q["host"], q["test"], unpacked(q["result"]));
    if (what == "count") queue_.count(q["work"]);
    // An ended rank asks no more: the server runs until all have ended.
    if (what == "end") {
      --n_left_;
      const json& use = q["lanes"];
      reports.push_back({q["cpu"], q["wall"], q["idle"], {use[0], use[1], use[2], use[3], use[4]}});
    }
    return queue_.stopped();
  }
};

}  // namespace

Ranks::Ranks(int threads) {
  int provided = 0;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &provided);
  // Workers call MPI from several threads, one at a time (mutex in RemoteQueue; only the server on rank 0).
  PHY_CHECK(provided >= MPI_THREAD_SERIALIZED, "MPI can be called from several threads in turn");
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &size_);
  MPI_Allreduce(&threads, &n_threads_, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
}

// Behind an error the other ranks may wait for an answer that will not come: mpirun ends them when this one
// leaves without finalising.
Ranks::~Ranks() {
  if (std::uncaught_exceptions() > 0) return;
  // No plan is the last one.
  for (int guest = 1; rank_ == 0 && guest < size_; ++guest) send(nullptr, guest, plan_tag);
  MPI_Finalize();
}

WorkReport work_as_host(const Ranks* ranks, StoreQueue& queue, const Plan& plan,
                        const MachineOptions& machine) {
  if (ranks == nullptr) return work_at(queue, plan, machine);
  const json work = packed(plan);
  for (int guest = 1; guest < ranks->size(); ++guest) send(work, guest, plan_tag);
  Server server(queue, ranks->size() - 1);
  WorkReport report;
  std::atomic<bool> broken{false};
  on_threads(
      // Thread 0 serves, thread 1 starts the workers of this rank. If either fails the queue is closed, so
      // that the other ends.
      2, broken, [&](std::size_t i) { i == 0 ? server.run() : void(report = work_at(queue, plan, machine)); },
      [&] {
        if (broken) queue.close();
      });
  // Left by a rank that was stopped alone when no worker was here to take it.
  if (const Progress p = queue.progress(); !queue.stopped() && p.n_done < p.n_total)
    server.reports.push_back(work_at(queue, plan, machine));
  // By default all ranks have equally many workers; the idle share takes them so. Each counts its own wall
  // time.
  double busy = report.wall_seconds * (1.0 - report.idle), wall = report.wall_seconds;
  for (const WorkReport& r : server.reports) {
    report.cpu_seconds += r.cpu_seconds;
    report.lanes.add(r.lanes);
    busy += r.wall_seconds * (1.0 - r.idle);
    wall = std::max(wall, r.wall_seconds);
  }
  report.n_guest = queue.progress().n_guest;
  report.wall_seconds = wall;
  report.idle = 1.0 - busy / (wall * ranks->size());
  return report;
}

void work_as_guest(const Ranks&, const MachineOptions& machine, const std::atomic<bool>& stop) {
  // A stopped guest still answers every plan, with no test: rank 0 counts those that have ended.
  for (json work = await(plan_tag); !work.is_null(); work = await(plan_tag)) {
    RemoteQueue queue(stop);
    try {
      const Plan plan = plan_in(work);
      queue.end(work_at(queue, plan, machine));
    } catch (...) {
      queue.end({});  // or rank 0 would wait for ever
      throw;
    }
  }
}

#endif

}  // namespace phy::study
