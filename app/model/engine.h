#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "model/event.h"
#include "model/workbench.h"

namespace isorelax::model {

/// What the worker is doing, for a status line.
struct Progress {
  bool busy = false;
  std::string label;
  double share = 0;  ///< 0..1; negative when it is not known
};

class Engine;

/// What a job may use while it runs on the worker.
class JobContext {
 public:
  explicit JobContext(Engine& engine) : engine_(engine) {}
  /// True once the user asked to stop: the job should end soon, with what it has.
  [[nodiscard]] bool cancelled() const;
  void progress(std::string label, double share) const;
  void publish(Event event) const;
  /// Whether the view has taken everything published so far. A run measures a new state for the view only
  /// then.
  [[nodiscard]] bool view_is_waiting() const;
  /// Whether another job waits: one that is nice to have should give way.
  [[nodiscard]] bool others_wait() const;
  /// The same after a while, or as soon as one does.
  [[nodiscard]] bool others_wait(std::chrono::milliseconds while_resting) const;
  [[nodiscard]] Workbench& bench() const;

 private:
  Engine& engine_;
};

/// One worker thread that runs jobs in order and hands their events to whoever collects them. Collecting and
/// posting never wait for a job.
class Engine {
 public:
  using Job = std::function<void(JobContext&)>;

  Engine();
  /// Cancels what runs, drops what waits, and joins.
  ~Engine();
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;

  /// Queues a job. A waiting job with the same non-empty `key` is replaced. An exception of type Error that
  /// leaves the job becomes a Failed event.
  void post(std::string key, Job job);
  /// Asks the running job to stop and drops the waiting ones.
  void cancel();
  /// Everything published since the last call, oldest first.
  [[nodiscard]] std::vector<Event> collect();
  [[nodiscard]] Progress progress() const;
  /// Whether a job runs or waits, or events are still to be collected.
  [[nodiscard]] bool busy() const;
  /// Blocks until there is an event to collect or nothing runs. For tests and programs without a window.
  void wait() const;
  /// How the words are understood that a recorded run was made with; without one only those for which the
  /// editor has settings. It is called on the worker. Precondition: no job was posted yet.
  void set_plan_reader(PlanReader reader);
  /// Called on the worker after each event: wakes a window that sleeps.
  void set_wake(std::function<void()> wake);

 private:
  friend class JobContext;
  struct Waiting {
    std::string key;
    Job job;
  };
  void work(const std::stop_token& stop);
  void run_one(const Job& job);
  void publish(Event event);

  mutable std::mutex mutex_;
  mutable std::condition_variable_any changed_;
  std::deque<Waiting> waiting_;
  std::vector<Event> events_;
  Progress progress_;
  bool running_ = false;
  std::function<void()> wake_;
  std::atomic<bool> cancelled_{false};
  Workbench bench_;
  std::jthread thread_;  // last: it uses all of the above
};

}  // namespace isorelax::model
