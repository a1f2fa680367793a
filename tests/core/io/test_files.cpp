#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>

#include "core/io/mesh_samples.h"
#include "io/atomic_file.h"
#include "io/mesh_file.h"
#include "mesh/error.h"

namespace isorelax {
namespace {

namespace fs = std::filesystem;

/// A folder of its own for every test, removed afterwards.
class Files : public testing::Test {
 protected:
  Files() {
    std::string name = testing::TempDir() + "isorelax-io-XXXXXX";
    folder_ = ::mkdtemp(name.data());
  }
  ~Files() override { fs::remove_all(folder_); }

  [[nodiscard]] fs::path path(const std::string& name) const { return folder_ / name; }

  [[nodiscard]] fs::path put(const std::string& name, const std::string& bytes) const {
    std::ofstream(path(name), std::ios::binary) << bytes;
    return path(name);
  }

  static std::string bytes_of(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  [[nodiscard]] std::size_t file_count() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), {}));
  }

  /// The text of the InputError that reading gives, without the name; and it takes less than a second.
  static std::string refusal(const fs::path& file) {
    const auto start = std::chrono::steady_clock::now();
    std::string text;
    try {
      static_cast<void>(read_mesh(file));
    } catch (const InputError& error) {
      text = error.what();
    }
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(1));
    EXPECT_EQ(text.find('\n'), std::string::npos);
    EXPECT_TRUE(text.starts_with(file.string() + ": ")) << text;
    return text.substr(std::min(text.size(), file.string().size() + 2));
  }

  fs::path folder_;
};

TEST_F(Files, WhatIsNoReadableMeshFileIsRefusedWithTheReason) {
  EXPECT_EQ(refusal(path("nothing.off")), "cannot be read: No such file or directory");
  EXPECT_EQ(refusal(folder_), "cannot be read: Is a directory");
  EXPECT_EQ(refusal(put("empty.ply", "")), "the file is empty");
  EXPECT_EQ(refusal(put("mesh.txt", "hello\n")),
            "unknown format: none of OFF, OBJ, PLY, STL, MSH, VTK, VTP or VTU");
  EXPECT_EQ(refusal(put("mesh.off", "hello\n")), "line 1: expected OFF, found 'hello'");
  EXPECT_EQ(refusal(put("mesh.obj", "hello\n")), "holds no vertices");
  EXPECT_EQ(refusal("/dev/zero"), "is not a regular file");
  ASSERT_EQ(::mkfifo(path("pipe.off").c_str(), 0600), 0);
  EXPECT_EQ(refusal(path("pipe.off")), "is not a regular file");
}

TEST_F(Files, AFileThatMayNotBeReadIsRefused) {
  const fs::path file = put("secret.off", "OFF\n");
  fs::permissions(file, fs::perms::none);
  // Root may read everything: be somebody else meanwhile.
  const bool is_root = ::geteuid() == 0;
  ASSERT_EQ(::chmod(folder_.c_str(), 0755), 0);
  ASSERT_TRUE(!is_root || ::seteuid(65534) == 0);
  const std::string reason = refusal(file);
  ASSERT_TRUE(!is_root || ::seteuid(0) == 0);
  EXPECT_EQ(reason, "cannot be read: Permission denied");
}

TEST_F(Files, ANameWithALineBreakStaysOnOneLine) {
  try {
    static_cast<void>(read_mesh(path("two\nlines.off")));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("two\\x0alines.off"), std::string::npos);
  }
}

TEST_F(Files, AMeshUnderTheNameOfAnotherFormatIsReadAndReported) {
  const EncodedMesh ply = encode_ply(hard_numbers(), FileEncoding::binary_big_endian);
  const MeshFile file = read_mesh(put("mesh.off", ply.bytes));
  EXPECT_EQ(file.format, FileFormat::ply);
  ASSERT_EQ(file.messages.size(), 1U);
  EXPECT_EQ(file.messages[0], "read as PLY, which it is, though its name says OFF");
  expect_same_geometry(file.mesh, hard_numbers());
}

TEST_F(Files, WritingAndReadingByExtensionKeepsTheMesh) {
  for (const char* name : {"mesh.off", "mesh.OBJ", "mesh.ply"}) {
    EXPECT_TRUE(write_mesh(path(name), hard_numbers()).empty());
    expect_same_geometry(read_mesh(path(name)).mesh, hard_numbers());
  }
  EXPECT_EQ(file_count(), 3U);
  EXPECT_THROW(static_cast<void>(write_mesh(path("mesh.xyz"), hard_numbers())), UsageError);
  WriteOptions options;
  options.encoding = FileEncoding::binary_big_endian;
  EXPECT_THROW(static_cast<void>(write_mesh(path("new.off"), hard_numbers(), options)), UsageError);
  options.format = FileFormat::ply;
  EXPECT_TRUE(write_mesh(path("mesh.xyz"), hard_numbers(), options).empty());
  EXPECT_EQ(read_mesh(path("mesh.xyz")).encoding, FileEncoding::binary_big_endian);
  EXPECT_EQ(file_count(), 4U);
}

TEST_F(Files, AMeshThatCannotBeEncodedLeavesTheOldFileUntouched) {
  const fs::path file = put("mesh.stl", "old");
  EXPECT_THROW(static_cast<void>(write_mesh(file, hard_numbers())), OutputError);
  EXPECT_EQ(bytes_of(file), "old");
  EXPECT_EQ(file_count(), 1U);
}

TEST_F(Files, WritingKeepsPermissionsAndFollowsLinks) {
  const fs::path file = put("real.off", "old");
  ASSERT_EQ(::chmod(file.c_str(), 0640), 0);
  fs::create_symlink("real.off", path("link.off"));
  write_file_atomically(path("link.off"), "new");
  EXPECT_TRUE(fs::is_symlink(path("link.off")));
  EXPECT_EQ(bytes_of(file), "new");
  struct stat status {};
  ASSERT_EQ(::stat(file.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 07777, 0640U);
  fs::create_symlink("later.off", path("dangling.off"));
  write_file_atomically(path("dangling.off"), "fresh");
  EXPECT_EQ(bytes_of(path("later.off")), "fresh");
  EXPECT_EQ(file_count(), 4U);
}

TEST_F(Files, WhatCannotBeWrittenIsRefusedWithTheReasonAndLeavesNothing) {
  const auto reason = [](const fs::path& file) -> std::string {
    try {
      write_file_atomically(file, "bytes");
    } catch (const OutputError& error) {
      const std::string text = error.what();
      return text.substr(std::min(text.size(), file.string().size() + 2));
    }
    return "written";
  };
  EXPECT_EQ(reason(path("none/mesh.off")), "cannot be written: No such file or directory");
  EXPECT_EQ(reason(folder_), "cannot be written: Is a directory");
  EXPECT_EQ(reason(""), "cannot be written: No such file or directory");
  EXPECT_EQ(reason("/dev/full"), "cannot be written: No space left on device");
  fs::create_symlink("b.off", path("a.off"));
  fs::create_symlink("a.off", path("b.off"));
  EXPECT_EQ(reason(path("a.off")), "cannot be written: Too many levels of symbolic links");
  EXPECT_EQ(file_count(), 2U);
}

TEST_F(Files, ADeviceIsWrittenToAndStaysADevice) {
  write_file_atomically("/dev/null", "bytes");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

/// Runs `body` in a process that may set aside `megabytes` more than it has; true when it ends well.
template <class Body>
bool fits_in(std::size_t megabytes, Body body) {
  const pid_t child = ::fork();
  if (child == 0) {
    std::size_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    const rlim_t limit = pages * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE)) + (megabytes << 20U);
    const rlimit bound{limit, limit};
    ::setrlimit(RLIMIT_AS, &bound);
    try {
      body();
    } catch (const InputError&) {
      ::_exit(0);
    } catch (...) {
      ::_exit(1);
    }
    ::_exit(0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

TEST_F(Files, TimeFollowsTheSizeOfTheFileHoweverItIsLaidOut) {
  std::string one_line = "OFF 50000 50000 0";
  std::string ply = "ply\nformat ascii 1.0\nelement vertex 3\n";
  std::string carriage_returns = "OFF\r50000 50000 0\r";
  for (int i = 0; i < 50000; ++i) {
    one_line += " 0 0 0";
    carriage_returns += "0 0 0\r";
    ply += "property list uchar int p" + std::to_string(i) + "\n";
  }
  for (int i = 0; i < 50000; ++i) {
    one_line += " 3 0 1 2";
    carriage_returns += "3 0 1 2\r";
  }
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(read_off(one_line, "one_line").mesh.triangles.size(), 50000U);
  EXPECT_EQ(read_off(carriage_returns, "carriage_returns").mesh.triangles.size(), 50000U);
  EXPECT_THROW(static_cast<void>(read_ply(ply, "properties")), InputError);
  EXPECT_EQ(read_obj(std::string(2000000, '\\') + "\n\nv 0 0 0\nv 0 0 0\nv 0 0 0\nf 1 2 3\n", "b")
                .mesh.triangles.size(),
            1U);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(2));
}

TEST_F(Files, MemoryFollowsTheSizeOfTheFileWhateverItsHeaderSays) {
  std::string faces = "OFF\n3 300000 0\n0 0 0\n1 0 0\n0 1 0\n";
  for (int i = 0; i < 300000; ++i) {
    faces += "3 0 1 2\n";
  }
  // 2.4 MB of the shortest faces there are.
  EXPECT_TRUE(fits_in(48, [&] { static_cast<void>(read_off(faces, "faces")); }));
  for (const char* count : {"4000000000", "100000000"}) {
    const std::string n = count;
    const std::string ply = "ply\nformat binary_little_endian 1.0\nelement vertex " + n +
                            "\nproperty float x\nproperty float y\nproperty float z\nelement face " + n +
                            "\nproperty list uchar int vertex_indices\nend_header\n";
    EXPECT_TRUE(fits_in(8, [&] { static_cast<void>(read_ply(ply, "lying")); }));
    EXPECT_TRUE(
        fits_in(8, [&] { static_cast<void>(read_off("OFF\n" + n + " " + n + " 0\n0 0 0\n", "lying")); }));
  }
  const std::string stl = std::string(80, 'x') + "\xff\xff\xff\x7f" + std::string(500, '\0');
  EXPECT_TRUE(fits_in(8, [&] { static_cast<void>(read_stl(stl, "lying")); }));
}

}  // namespace
}  // namespace isorelax
