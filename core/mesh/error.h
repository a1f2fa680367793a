#pragma once

#include <stdexcept>
#include <string>

namespace isorelax {

/// Root of every exception that leaves the core. `what()` is one line of text for the user.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A file that cannot be read: names the file, the place in it and the reason. Exit status 3.
class InputError : public Error {
 public:
  /// `place` is "line 12" or "byte 340"; empty when the whole file is meant.
  InputError(const std::string& file, const std::string& place, const std::string& reason)
      : Error(file + (place.empty() ? "" : ": " + place) + ": " + reason) {}
};

/// A mesh that was read but cannot be used for what was asked. Exit status 3.
class MeshError : public Error {
 public:
  using Error::Error;
};

/// A file that cannot be written. Exit status 4.
class OutputError : public Error {
 public:
  OutputError(const std::string& file, const std::string& reason) : Error(file + ": " + reason) {}
};

/// Options that make no sense alone or together. Exit status 2.
class UsageError : public Error {
 public:
  using Error::Error;
};

}  // namespace isorelax
