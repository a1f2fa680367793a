#pragma once

#include <chrono>
#include <string>
#include <string_view>

namespace isorelax::cli {

enum class Verbosity { normal, quiet };

/// The two streams of a command: results on standard output, everything else on standard error.
class Console {
 public:
  void set_verbosity(Verbosity verbosity) { verbosity_ = verbosity; }
  [[nodiscard]] Verbosity verbosity() const { return verbosity_; }

  /// Writes a result to standard output as it stands. Throws OutputError when it cannot be written.
  void result(std::string_view text);
  /// Flushes the results. Throws OutputError.
  void finish();
  /// One line of information on standard error ("isorelax: ..."); none when quiet.
  void message(std::string_view text);
  /// One line that is printed even when quiet: "isorelax: error: ...".
  void error(std::string_view text);

 private:
  Verbosity verbosity_ = Verbosity::normal;
};

/// Text on one line: line breaks and control characters become spaces.
[[nodiscard]] std::string one_line(std::string_view text);

/// How far a long task has come, on standard error: redrawn in place on a terminal, elsewhere a line every
/// few seconds and only when the task takes that long. Silent when the console is quiet.
class Progress {
 public:
  Progress(Console& console, std::string task);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// `fraction` 0..1; `detail` is free text ("iteration 12, min angle 21.3"). Cheap to call often.
  void update(double fraction, std::string_view detail = {});

 private:
  using Clock = std::chrono::steady_clock;
  Console& console_;
  std::string task_;
  Clock::time_point next_;
  std::size_t drawn_ = 0;
  bool terminal_;
};

}  // namespace isorelax::cli
