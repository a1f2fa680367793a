#include "model/engine.h"

#include <algorithm>
#include <new>
#include <utility>

#include "mesh/error.h"

namespace isorelax::model {

bool JobContext::cancelled() const {
  return engine_.cancelled_;
}

void JobContext::progress(std::string label, double share) const {
  const std::scoped_lock lock(engine_.mutex_);
  engine_.progress_ = {true, std::move(label), share};
}

void JobContext::publish(Event event) const {
  engine_.publish(std::move(event));
}

bool JobContext::view_is_waiting() const {
  const std::scoped_lock lock(engine_.mutex_);
  return engine_.events_.empty();
}

bool JobContext::others_wait() const {
  const std::scoped_lock lock(engine_.mutex_);
  return !engine_.waiting_.empty() || engine_.cancelled_;
}

bool JobContext::others_wait(std::chrono::milliseconds while_resting) const {
  std::unique_lock lock(engine_.mutex_);
  return engine_.changed_.wait_for(lock, while_resting,
                                   [&] { return !engine_.waiting_.empty() || engine_.cancelled_; });
}

Workbench& JobContext::bench() const {
  return engine_.bench_;
}

Engine::Engine() : thread_([this](const std::stop_token& stop) { work(stop); }) {}

Engine::~Engine() {
  cancel();
  thread_.request_stop();
}

void Engine::post(std::string key, Job job) {
  const std::scoped_lock lock(mutex_);
  const auto same =
      std::ranges::find_if(waiting_, [&](const Waiting& w) { return !key.empty() && w.key == key; });
  if (same != waiting_.end()) waiting_.erase(same);
  waiting_.push_back({std::move(key), std::move(job)});
  changed_.notify_all();
}

void Engine::cancel() {
  const std::scoped_lock lock(mutex_);
  waiting_.clear();
  if (running_) cancelled_ = true;
}

std::vector<Event> Engine::collect() {
  const std::scoped_lock lock(mutex_);
  return std::exchange(events_, {});
}

Progress Engine::progress() const {
  const std::scoped_lock lock(mutex_);
  return progress_;
}

bool Engine::busy() const {
  const std::scoped_lock lock(mutex_);
  return running_ || !waiting_.empty() || !events_.empty();
}

void Engine::wait() const {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return !events_.empty() || (!running_ && waiting_.empty()); });
}

void Engine::set_plan_reader(PlanReader reader) {
  const std::scoped_lock lock(mutex_);
  bench_.set_plan_reader(std::move(reader));
}

void Engine::set_wake(std::function<void()> wake) {
  const std::scoped_lock lock(mutex_);
  wake_ = std::move(wake);
}

void Engine::work(const std::stop_token& stop) {
  while (true) {
    Job job;
    {
      std::unique_lock lock(mutex_);
      if (!changed_.wait(lock, stop, [&] { return !waiting_.empty(); })) return;
      job = std::move(waiting_.front().job);
      waiting_.pop_front();
      running_ = true;
      cancelled_ = false;
    }
    run_one(job);
    std::function<void()> wake;
    {
      const std::scoped_lock lock(mutex_);
      running_ = false;
      progress_ = {};
      wake = wake_;
      changed_.notify_all();
    }
    if (wake) wake();
  }
}

void Engine::run_one(const Job& job) {
  JobContext context(*this);
  try {
    job(context);
  } catch (const InputError& error) {
    publish(Failed{error.what(), Topic::reading});
  } catch (const OutputError& error) {
    publish(Failed{error.what(), Topic::saving});
  } catch (const Error& error) {
    publish(Failed{error.what()});
  } catch (const std::bad_alloc&) {
    publish(Failed{"not enough memory for this"});
  } catch (const std::exception& error) {
    publish(Failed{std::string("unexpected failure: ") + error.what()});
  }
}

void Engine::publish(Event event) {
  std::function<void()> wake;
  {
    const std::scoped_lock lock(mutex_);
    events_.push_back(std::move(event));
    wake = wake_;
    changed_.notify_all();
  }
  if (wake) wake();
}

}  // namespace isorelax::model
