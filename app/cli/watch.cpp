#include "cli/watch.h"

#include <CLI/App.hpp>

#include "cli/console.h"
#include "cli/table.h"
#include "mesh/error.h"

namespace isorelax::cli {
namespace {

std::string iteration_text(const Trace& trace) {
  const TraceIteration& one = trace.iterations.back();
  return "iteration " + std::to_string(trace.iterations.size()) + ": energy " +
         number_text(one.after.energy) + ", angles " + number_text(one.quality.min_angle_deg) + " to " +
         number_text(one.quality.max_angle_deg) + " deg: ";
}

Moment moment(const Trace& trace, const StepRecord& record, std::span<const Vec3> positions, bool stop) {
  return {.iteration = trace.iterations.size(),
          .numbers = trace.iterations.back(),
          .record = record,
          .positions = positions,
          .triangles = trace.triangles,
          .inverted_at_start = trace.quality.inverted,
          .stop = stop};
}

void read(const char* option, const std::vector<std::string>& typed, std::vector<Predicate>& predicates) {
  for (const std::string& text : typed) {
    try {
      predicates.emplace_back(text);
    } catch (const UsageError& error) {
      throw UsageError(std::string(option) + " " + error.what());
    }
  }
}

void check_ids(const char* option, const std::vector<Predicate>& predicates, const TriangleMesh& mesh) {
  for (const Predicate& predicate : predicates) {
    try {
      predicate.check(mesh.positions.size(), mesh.triangles.size());
    } catch (const UsageError& error) {
      throw UsageError(std::string(option) + " " + error.what());
    }
  }
}

}  // namespace

void Watch::declare(CLI::App& app) {
  app.add_option("--break", typed_breaks_,
                 "End the run after the first iteration where this holds, such as 'min_angle < 5'; what is "
                 "there then is written (repeatable)")
      ->type_name("PREDICATE")
      ->expected(1)
      ->take_all()
      ->allow_extra_args(false);
  app.add_option("--log", typed_logs_, "Tell of every iteration where this holds (repeatable)")
      ->type_name("PREDICATE")
      ->expected(1)
      ->take_all()
      ->allow_extra_args(false);
}

void Watch::check() {
  read("--break", typed_breaks_, breaks_);
  read("--log", typed_logs_, logs_);
}

void Watch::check(const TriangleMesh& mesh) const {
  check_ids("--break", breaks_, mesh);
  check_ids("--log", logs_, mesh);
}

bool Watch::look(Console& console, const Trace& trace, const StepRecord& record,
                 std::span<const Vec3> positions) {
  if (!wanted()) return true;
  const Moment now = moment(trace, record, positions, false);
  for (const Predicate& log : logs_) {
    if (log.holds(now)) console.message(iteration_text(trace) + log.text());
  }
  for (const Predicate& stop : breaks_) {
    if (!stop.holds(now)) continue;
    console.message(iteration_text(trace) + "stopped because " + stop.text());
    last_positions_.clear();
    broken_by_ = stop.text();
    return false;
  }
  last_ = record;
  last_positions_.assign(positions.begin(), positions.end());
  return true;
}

void Watch::begin_again(Console& console) const {
  if (wanted()) console.message("the run is done again from the start; why is told at the end");
}

void Watch::finish(Console& console, const Trace& trace) const {
  // Empty when a predicate has ended the run.
  if (trace.iterations.empty() || last_positions_.empty()) return;
  const Moment end = moment(trace, last_, last_positions_, true);
  const Moment before = moment(trace, last_, last_positions_, false);
  for (const std::vector<Predicate>* predicates : {&logs_, &breaks_}) {
    for (const Predicate& one : *predicates)
      if (one.holds(end) && !one.holds(before)) console.message(iteration_text(trace) + one.text());
  }
}

}  // namespace isorelax::cli
