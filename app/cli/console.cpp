#include "cli/console.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>

#include "mesh/error.h"

namespace isorelax::cli {
namespace {

constexpr auto kFirstLine = std::chrono::seconds(3);
constexpr auto kLineInterval = std::chrono::seconds(5);
constexpr auto kRedrawInterval = std::chrono::milliseconds(100);

[[noreturn]] void throw_stdout_error() {
  const int code = errno;
  throw OutputError("standard output", code != 0 ? std::strerror(code) : "cannot be written");
}

void write_line(std::string_view prefix, std::string_view text) {
  const std::string line = std::string(prefix) + one_line(text) + "\n";
  std::fwrite(line.data(), 1, line.size(), stderr);
}

}  // namespace

std::string one_line(std::string_view text) {
  std::string line(text);
  for (char& c : line) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  }
  const std::size_t end = line.find_last_not_of(' ');
  line.erase(end == std::string::npos ? 0 : end + 1);
  return line;
}

void Console::result(std::string_view text) {
  errno = 0;
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size()) throw_stdout_error();
}

void Console::finish() {
  errno = 0;
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) throw_stdout_error();
}

void Console::message(std::string_view text) {
  if (verbosity_ == Verbosity::normal) write_line("isorelax: ", text);
}

void Console::error(std::string_view text) {
  write_line("isorelax: error: ", text);
}

Progress::Progress(Console& console, std::string task)
    : console_(console), task_(std::move(task)), terminal_(isatty(STDERR_FILENO) == 1) {
  next_ = Clock::now() + (terminal_ ? Clock::duration(kRedrawInterval) : Clock::duration(kFirstLine));
}

Progress::~Progress() {
  if (drawn_ > 0) std::fprintf(stderr, "\r%*s\r", static_cast<int>(drawn_), "");
}

void Progress::update(double fraction, std::string_view detail) {
  if (console_.verbosity() == Verbosity::quiet) return;
  const auto now = Clock::now();
  if (now < next_) return;
  next_ = now + (terminal_ ? Clock::duration(kRedrawInterval) : Clock::duration(kLineInterval));
  const long percent = std::lround(100 * std::clamp(fraction, 0.0, 1.0));
  std::string text = task_ + ": " + std::to_string(percent) + " %";
  if (!detail.empty()) text += ", " + one_line(detail);
  if (!terminal_) {
    console_.message(text);
    return;
  }
  const std::size_t width = text.size();
  if (width < drawn_) text.append(drawn_ - width, ' ');
  drawn_ = width;
  std::fprintf(stderr, "\r%s", text.c_str());
}

}  // namespace isorelax::cli
