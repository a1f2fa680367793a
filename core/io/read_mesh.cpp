#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "io/mesh_file.h"
#include "io/text_scanner.h"
#include "mesh/error.h"

namespace isorelax {
namespace {

/// Closes a file descriptor.
struct Descriptor {
  int number;
  explicit Descriptor(int descriptor) : number(descriptor) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() { ::close(number); }
};

[[noreturn]] void fail(const std::string& name, int error) {
  throw InputError(name, "", "cannot be read: " + std::generic_category().message(error));
}

/// Opens for reading without waiting, so that a pipe without a writer cannot hold it up.
int open_or_fail(const std::filesystem::path& path, const std::string& name) {
  const int opened = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (opened < 0) {
    fail(name, errno);
  }
  return opened;
}

/// The size of an open regular file.
std::size_t regular_size(const Descriptor& file, const std::string& name) {
  struct stat status {};
  if (::fstat(file.number, &status) != 0) {
    fail(name, errno);
  }
  if (S_ISDIR(status.st_mode)) {
    fail(name, EISDIR);
  }
  if (!S_ISREG(status.st_mode)) {
    throw InputError(name, "", "is not a regular file");
  }
  return static_cast<std::size_t>(status.st_size);
}

std::string read_regular_file(const std::filesystem::path& path, const std::string& name) {
  const Descriptor file(open_or_fail(path, name));
  std::string bytes(regular_size(file, name), '\0');
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t got = ::read(file.number, bytes.data() + done, bytes.size() - done);
    if (got < 0 && errno == EINTR) {
      continue;
    }
    if (got < 0) {
      fail(name, errno);
    }
    if (got == 0) {
      break;
    }
    done += static_cast<std::size_t>(got);
  }
  bytes.resize(done);
  return bytes;
}

MeshFile read_format(FileFormat format, std::string_view bytes, const std::string& name) {
  switch (format) {
    case FileFormat::off:
      return read_off(bytes, name);
    case FileFormat::obj:
      return read_obj(bytes, name);
    case FileFormat::ply:
      return read_ply(bytes, name);
    case FileFormat::stl:
      return read_stl(bytes, name);
    case FileFormat::msh:
      return read_msh(bytes, name);
    case FileFormat::vtk:
      return read_vtk(bytes, name);
    case FileFormat::vtp:
    case FileFormat::vtu:
      return read_vtk_xml(bytes, name);
  }
  throw InputError(name, "", "unknown format");
}

}  // namespace

std::string read_bytes(const std::filesystem::path& path) {
  return read_regular_file(path, one_line(path.string()));
}

void check_readable(const std::filesystem::path& path) {
  const std::string name = one_line(path.string());
  regular_size(Descriptor(open_or_fail(path, name)), name);
}

MeshFile read_mesh(const std::filesystem::path& path) {
  const std::string name = one_line(path.string());
  const std::string bytes = read_regular_file(path, name);
  if (bytes.empty()) {
    throw InputError(name, "", "the file is empty");
  }
  const std::optional<FileFormat> by_extension = format_of_extension(path);
  std::optional<FileFormat> format = format_of_content(bytes);
  const bool differs = format && by_extension && *format != *by_extension;
  format = format ? format : by_extension;
  if (!format) {
    throw InputError(name, "", "unknown format: none of " + format_names());
  }
  MeshFile file = read_format(*format, bytes, name);
  if (differs) {
    file.messages.insert(file.messages.begin(), std::string("read as ") + format_name(*format) +
                                                    ", which it is, though its name says " +
                                                    format_name(*by_extension));
  }
  return file;
}

}  // namespace isorelax
