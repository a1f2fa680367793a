#pragma once

#include <string>
#include <vector>

#include "io/mixed_scanner.h"
#include "io/vtk_cells.h"
#include "io/vtk_numbers.h"

namespace isorelax {

/// Reads the parts of a legacy VTK file that stand in it again and again: arrays of numbers, in text or in
/// big-endian binary, and lists of cells.
class VtkScanner {
 public:
  VtkScanner(std::string_view bytes, const std::string& name) : scanner_(bytes, name) {}

  [[nodiscard]] MixedScanner& words() { return scanner_; }
  void set_text(bool text) { text_ = text; }
  [[nodiscard]] bool is_text() const { return text_; }

  /// Next word as a type of numbers.
  VtkType type();
  /// Goes on from the words that announce numbers to the numbers.
  void begin_numbers();
  /// Fills in the numbers of an array whose size and type are known.
  void numbers(VtkArray& array);
  /// The same for coordinates, which have to be finite, three for each point.
  void coordinates(VtkArray& array);
  /// The arrays behind the keyword FIELD; those that are not of numbers are said in `messages`.
  std::vector<VtkArray> field(std::vector<std::string>& messages);

  /// The list of cells behind its keyword, as files have it before version 5 and since.
  VtkCells cells(std::size_t point_count, bool since_version_5);
  /// Next numbers, each from 0 to 255.
  std::vector<std::uint8_t> small_numbers(std::uint64_t count, const char* what);

  /// Passes over what stands behind the keyword METADATA.
  void skip_metadata();

 private:
  std::int64_t integer(VtkType type, const char* what);
  VtkCells counted_cells(std::size_t point_count, std::uint64_t count, std::uint64_t size);
  VtkCells offset_cells(std::size_t point_count, std::uint64_t count, std::uint64_t size);
  VtkType index_type(const char* keyword);
  Index vertex(VtkType type, std::size_t point_count);
  void promise(VtkType type, std::uint64_t count, const char* what) const;
  void check_finite(double value, std::size_t place) const;
  void skip_strings(const VtkArray& array);

  MixedScanner scanner_;
  bool text_ = true;
  /// Numbers per row of the array read last: its METADATA names so many components.
  std::uint64_t last_width_ = 0;
};

}  // namespace isorelax
