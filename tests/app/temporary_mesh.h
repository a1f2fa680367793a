#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "generate/generate.h"
#include "io/mesh_file.h"

namespace isorelax::test {

/// A folder of one test, removed with it.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    path_ = std::filesystem::temp_directory_path() /
            ("isorelax-" + std::string(info->test_suite_name()) + "-" + info->name() + "-" +
             std::to_string(::testing::UnitTest::GetInstance()->random_seed()));
    std::filesystem::create_directories(path_);
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  [[nodiscard]] std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  /// A random square of so many triangles in a file of this folder.
  [[nodiscard]] std::filesystem::path make_square(std::size_t triangles = 400,
                                                  const std::string& name = "square.off") const {
    GenerateOptions options;
    options.triangles = triangles;
    std::filesystem::path path = path_ / name;
    (void)write_mesh(path, generate(ShapeKind::random_square, options));
    return path;
  }

 private:
  std::filesystem::path path_;
};

}  // namespace isorelax::test
