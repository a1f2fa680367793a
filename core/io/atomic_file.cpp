#include "io/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <optional>
#include <string>
#include <system_error>

#include "io/text_scanner.h"
#include "mesh/error.h"

namespace isorelax {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, int error) {
  throw OutputError(one_line(path.string()), "cannot be written: " + std::generic_category().message(error));
}

/// A file descriptor that is closed, and a file that is removed, unless told otherwise.
class OutputFile {
 public:
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  OutputFile(const fs::path& shown, int descriptor) : shown_(shown), descriptor_(descriptor) {
    if (descriptor_ < 0) {
      fail(shown_, errno);
    }
  }
  ~OutputFile() {
    if (descriptor_ >= 0) {
      ::close(descriptor_);
    }
    if (!remove_.empty()) {
      ::unlink(remove_.c_str());
    }
  }

  void remove_unless_renamed(const fs::path& temporary) { remove_ = temporary; }

  void write(std::string_view bytes) const {
    while (!bytes.empty()) {
      const ssize_t done = ::write(descriptor_, bytes.data(), bytes.size());
      if (done < 0 && errno != EINTR) {
        fail(shown_, errno);
      }
      bytes.remove_prefix(done > 0 ? static_cast<std::size_t>(done) : 0);
    }
  }

  /// Owner first: changing it clears some permission bits.
  void take_over(const struct stat& old) const {
    static_cast<void>(::fchown(descriptor_, old.st_uid, old.st_gid) == 0);
    if (::fchmod(descriptor_, old.st_mode & 07777) != 0) {
      fail(shown_, errno);
    }
  }

  void flush() const {
    // Some file systems have no way to flush and say so with EINVAL.
    if (::fsync(descriptor_) != 0 && errno != EINVAL) {
      fail(shown_, errno);
    }
  }

  void close() {
    const int descriptor = descriptor_;
    descriptor_ = -1;
    if (::close(descriptor) != 0) {
      fail(shown_, errno);
    }
  }

  void rename_to(const fs::path& target) {
    if (::rename(remove_.c_str(), target.c_str()) != 0) {
      fail(shown_, errno);
    }
    remove_.clear();
  }

 private:
  const fs::path& shown_;
  int descriptor_;
  fs::path remove_;
};

bool stands_under(const fs::path& path, const char* folder) {
  const std::string text = path.string();
  return text.starts_with(folder);
}

void write_straight(const fs::path& path, std::string_view bytes) {
  OutputFile file(path, ::open(path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC));
  file.write(bytes);
  file.close();
}

/// Where the symbolic links at the end of `path` lead, there or not.
fs::path follow_links(const fs::path& path) {
  static constexpr int kMostLinks = 40;
  fs::path target = path;
  std::error_code ignored;
  for (int links = 0; fs::is_symlink(fs::symlink_status(target, ignored)); ++links) {
    if (links == kMostLinks) {
      fail(path, ELOOP);
    }
    const fs::path next = fs::read_symlink(target, ignored);
    target = next.is_absolute() ? next : target.parent_path() / next;
  }
  return target;
}

/// Creates a file of a new name beside `target`, with the permissions that any new file gets.
int create_beside(const fs::path& target, fs::path& temporary) {
  static constexpr int kMostTries = 1000;
  for (int attempt = 0; attempt < kMostTries; ++attempt) {
    temporary = target.parent_path() /
                (".isorelax-" + std::to_string(::getpid()) + "-" + std::to_string(attempt) + ".tmp");
    const int descriptor = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor >= 0 || errno != EEXIST) {
      return descriptor;
    }
  }
  errno = EEXIST;
  return -1;
}

/// Makes the new name itself survive a power cut, where the system can.
void flush_folder(const fs::path& file) {
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor >= 0) {
    static_cast<void>(::fsync(descriptor));
    ::close(descriptor);
  }
}

/// Whether `path` is written in its place instead of by a new file: devices and pipes are. Throws OutputError
/// where nothing can be written.
bool is_written_straight(const fs::path& path, const struct stat& old, bool exists) {
  if (exists && S_ISDIR(old.st_mode)) {
    fail(path, EISDIR);
  }
  if (exists && (!S_ISREG(old.st_mode) || stands_under(path, "/dev/") || stands_under(path, "/proc/"))) {
    return true;
  }
  if (path.empty() || path.filename().empty()) {
    fail(path, ENOENT);
  }
  // A rename would replace a write-protected file; its owner did not mean that.
  if (exists && ::access(path.c_str(), W_OK) != 0) {
    fail(path, errno);
  }
  return false;
}

}  // namespace

void check_writable(const fs::path& path) {
  struct stat old {};
  const bool exists = ::stat(path.c_str(), &old) == 0;
  if (is_written_straight(path, old, exists)) {
    return;
  }
  const fs::path target = follow_links(path);
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  if (::access(folder.c_str(), W_OK | X_OK) != 0) {
    fail(path, errno);
  }
}

void write_file_atomically(const fs::path& path, std::string_view bytes) {
  struct stat old {};
  const bool exists = ::stat(path.c_str(), &old) == 0;
  if (is_written_straight(path, old, exists)) {
    write_straight(path, bytes);
    return;
  }
  const fs::path target = follow_links(path);
  fs::path temporary;
  OutputFile file(path, create_beside(target, temporary));
  file.remove_unless_renamed(temporary);
  if (exists) {
    file.take_over(old);
  }
  file.write(bytes);
  file.flush();
  file.close();
  file.rename_to(target);
  flush_folder(target);
}

}  // namespace isorelax
