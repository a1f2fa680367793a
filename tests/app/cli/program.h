#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

namespace isorelax::test {

/// A folder of its own for one test, removed at the end.
class Workspace {
 public:
  Workspace() {
    std::string pattern = (std::filesystem::temp_directory_path() / "isorelax-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no temporary folder");
    folder_ = pattern;
  }
  ~Workspace() { std::filesystem::remove_all(folder_); }
  Workspace(const Workspace&) = delete;
  Workspace& operator=(const Workspace&) = delete;

  [[nodiscard]] std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(path(name), std::ios::binary) << text;
    return path(name);
  }

 private:
  std::filesystem::path folder_;
};

struct Outcome {
  int status = -1;
  std::string out;
  std::string err;
};

inline std::string contents(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

/// The built program as a word for the shell.
inline std::string quoted_program() {
  return std::string("'") + ISORELAX_PROGRAM + "' ";
}

/// Runs the built program through the shell: `arguments` as one would type them.
inline Outcome run_program(const std::string& arguments) {
  const Workspace workspace;
  const std::string out = workspace.path("out");
  const std::string err = workspace.path("err");
  const std::string command = quoted_program() + arguments;
  const int code = std::system(("{ " + command + " ; } >'" + out + "' 2>'" + err + "'").c_str());
  return {WIFEXITED(code) ? WEXITSTATUS(code) : -1, contents(out), contents(err)};
}

inline constexpr const char* kTriangle = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

/// Exactly one line, of the agreed form.
inline void expect_one_error_line(const Outcome& outcome) {
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_EQ(outcome.err.rfind("isorelax: error: ", 0), 0U) << outcome.err;
  EXPECT_EQ(outcome.out, "");
}

/// A mistake of whoever typed these arguments, told in one line.
inline void expect_refused(const std::string& arguments) {
  SCOPED_TRACE(arguments);
  const Outcome outcome = run_program(arguments);
  EXPECT_EQ(outcome.status, 2);
  expect_one_error_line(outcome);
}

}  // namespace isorelax::test
