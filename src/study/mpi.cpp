#include "study/mpi.hpp"

#ifdef PHY_MPI
#include <mpi.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <nlohmann/json.hpp>
#include <thread>

#include "base/hash.hpp"
#include "base/nan.hpp"
#include "base/parallel.hpp"
#include "io/csv.hpp"
#include "system/process.hpp"
#endif

#include "base/check.hpp"

namespace phy::study {

#ifndef PHY_MPI

Ranks::Ranks() {
  throw InputError(Problem{"command line", "--mpi", "", "a program built with MPI",
                           "build it with cmake -DPHY_MPI=ON, or run shards (--shard i/n)"});
}
Ranks::~Ranks() = default;
int Ranks::sum(int value) const { return value; }
void Ranks::check_same(const Plan&) const {}
WorkReport work_as_host(const Ranks&, StoreQueue& queue, const Plan& plan, const MachineOptions& machine) {
  return work_at(queue, plan, machine);
}
void work_as_guest(const Ranks&, const Plan&, const MachineOptions&, const std::atomic<bool>&) {}

#else

namespace {

using nlohmann::json;
constexpr int request_tag = 1, answer_tag = 2;
constexpr std::chrono::microseconds pause{
    500};  // between looks for a message; MPI's own waiting would take a core

void send(const json& message, int to, int tag) {
  const std::string text = message.dump();
  // As text: plans and results are small beside the time of a test, and JSON carries exact doubles and NaN.
  MPI_Send(text.data(), static_cast<int>(text.size()), MPI_CHAR, to, tag, MPI_COMM_WORLD);
}

json receive(const MPI_Status& status) {
  int size = 0;
  MPI_Get_count(&status, MPI_CHAR, &size);
  std::string text(static_cast<std::size_t>(size), '\0');
  MPI_Recv(text.data(), size, MPI_CHAR, status.MPI_SOURCE, status.MPI_TAG, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  return json::parse(text);
}

/// Looks for a message without waiting; false if there is none.
bool look(int from, int tag, MPI_Status& status) {
  int there = 0;
  MPI_Iprobe(from, tag, MPI_COMM_WORLD, &there, &status);
  return there != 0;
}

// What the store keeps of a result and the progress counts, nothing more. NaN travels as null.
json packed(const TestResult& r) {
  json numbers = json::array();
  for (const Number& n : r.numbers) numbers.push_back({n.name, n.value, n.unit, n.definition, n.note});
  return {{"name", r.name},
          {"intact", r.intact},
          {"theta", r.theta},
          {"outcome", {static_cast<int>(r.outcome.status), r.outcome.reason, r.outcome.advice}},
          {"numbers", numbers},
          {"history", io::history_csv(r.history)},
          {"cracks", io::cracks_csv(r.cracks, r.history.kind)},
          {"dt", r.dt},
          {"counts", {r.n_steps, r.n_contacts, r.n_grains}},
          {"seconds", r.seconds},
          {"hash", r.hash}};
}

double number_or_nan(const json& value) { return value.is_null() ? nan : value.get<double>(); }

TestResult unpacked(const json& j) {
  TestResult r;
  r.name = j["name"], r.intact = j["intact"], r.theta = j["theta"];
  r.outcome = {static_cast<Status>(j["outcome"][0].get<int>()), j["outcome"][1], j["outcome"][2]};
  for (const json& n : j["numbers"]) r.numbers.push_back({n[0], number_or_nan(n[1]), n[2], n[3], n[4]});
  r.history = io::parse_history(j["history"].get<std::string>(), "a result of another rank");
  r.cracks = io::parse_cracks(j["cracks"].get<std::string>(), "a result of another rank");
  r.dt = number_or_nan(j["dt"]);
  r.n_steps = j["counts"][0], r.n_contacts = j["counts"][1], r.n_grains = j["counts"][2];
  r.seconds = j["seconds"], r.hash = j["hash"];
  return r;
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
    // The answer is awaited by looking now and then: MPI_Recv would keep a core busy.
    send(request, 0, request_tag);
    MPI_Status status;
    while (!look(0, answer_tag, status)) std::this_thread::sleep_for(pause);
    return receive(status);
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

std::uint64_t fingerprint(const Plan& plan) {
  Hash h;
  // Keys are fingerprints of complete recipes: equal lists of keys mean equal plans.
  for (const PlannedTest& t : plan.tests) h.add(t.key);
  return h.value();
}

}  // namespace

Ranks::Ranks() {
  int provided = 0;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &provided);
  // Workers call MPI from several threads, one at a time (mutex in RemoteQueue; only the server on rank 0).
  PHY_CHECK(provided >= MPI_THREAD_SERIALIZED, "MPI can be called from several threads in turn");
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &size_);
}

// Behind an error the other ranks may wait for an answer that will not come: mpirun ends them when this one
// leaves without finalising.
Ranks::~Ranks() {
  if (std::uncaught_exceptions() == 0) MPI_Finalize();
}

int Ranks::sum(int value) const {
  int total = 0;
  MPI_Allreduce(&value, &total, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
  return total;
}

void Ranks::check_same(const Plan& plan) const {
  const std::uint64_t mine = fingerprint(plan);
  // Equal least and greatest value: all ranks hold the same.
  std::uint64_t least = 0, most = 0;
  MPI_Allreduce(&mine, &least, 1, MPI_UINT64_T, MPI_MIN, MPI_COMM_WORLD);
  MPI_Allreduce(&mine, &most, 1, MPI_UINT64_T, MPI_MAX, MPI_COMM_WORLD);
  if (least != most)
    throw InputError(Problem{"command line", "--mpi", "", "the same study and recipe on every rank",
                             "let all ranks read the same files"});
}

WorkReport work_as_host(const Ranks& ranks, StoreQueue& queue, const Plan& plan,
                        const MachineOptions& machine) {
  Server server(queue, ranks.size() - 1);
  WorkReport report;
  std::atomic<bool> broken{false};
  on_threads(
      // Thread 0 serves, thread 1 starts the workers of this rank. If either fails the queue is closed, so
      // that the other ends.
      2, broken, [&](std::size_t i) { i == 0 ? server.run() : void(report = work_at(queue, plan, machine)); },
      [&] {
        if (broken) queue.close();
      });
  // By default all ranks have equally many workers; the idle share takes them so. Each counts its own wall
  // time.
  double busy = report.wall_seconds * (1.0 - report.idle), wall = report.wall_seconds;
  for (const WorkReport& r : server.reports) {
    report.cpu_seconds += r.cpu_seconds;
    report.lanes.add(r.lanes);
    busy += r.wall_seconds * (1.0 - r.idle);
    wall = std::max(wall, r.wall_seconds);
  }
  report.wall_seconds = wall;
  report.idle = 1.0 - busy / (wall * ranks.size());
  return report;
}

void work_as_guest(const Ranks&, const Plan& plan, const MachineOptions& machine,
                   const std::atomic<bool>& stop) {
  RemoteQueue queue(stop);
  try {
    queue.end(work_at(queue, plan, machine));
  } catch (...) {
    queue.end({});  // or rank 0 would wait for ever
    throw;
  }
}

#endif

}  // namespace phy::study
