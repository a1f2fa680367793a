#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "compare/image_metrics.h"

namespace isorelax::compare {

/// A number that was found, for people (label) and programs (key).
struct Figure {
  std::string key;
  std::string label;
  double value = 0;             ///< of A, where there are two
  std::optional<double> other;  ///< of B
};

/// A picture of a comparison, as the bytes of a PNG file.
struct CasePicture {
  std::string title;
  std::vector<std::uint8_t> png;
};

/// One comparison with all that reports show of it.
struct Case {
  std::string name;
  std::string a, b;     ///< files
  std::string failure;  ///< why nothing could be compared: a file is missing, sizes differ; empty: it could
  std::vector<Verdict> verdicts;
  std::vector<Figure> figures;
  std::vector<std::string> notes;     ///< sentences: where, how many
  std::vector<CasePicture> pictures;  ///< A, B and what is between them; empty where no page is wanted
  std::string view_a, view_b;         ///< as JSON; empty: unknown

  [[nodiscard]] bool passes() const { return failure.empty() && all_hold(verdicts); }
};

enum class Detail : std::uint8_t { figures, pictures };

/// Compares two PNG files. Throws InputError (cannot be read), UsageError (different sizes).
[[nodiscard]] Case compare_picture_files(const std::filesystem::path& a, const std::filesystem::path& b,
                                         const ImageLimits& limits, Detail detail);

/// Compares all PNG files of two folders and those below them by name. One that is missing, is extra, cannot
/// be read or has another size fails. Sorted by name. Throws InputError (a folder cannot be read), UsageError
/// (no pictures).
[[nodiscard]] std::vector<Case> compare_folders(const std::filesystem::path& a,
                                                const std::filesystem::path& b, const ImageLimits& limits,
                                                Detail detail);

/// A self-contained HTML page: nothing is loaded from anywhere, and all but slider and blink works without
/// scripts.
[[nodiscard]] std::string html_page(const std::string& title, const std::vector<Case>& cases);

/// Test results in JUnit's XML.
[[nodiscard]] std::string junit_xml(const std::vector<Case>& cases);

/// Six significant digits, no trailing zeros.
[[nodiscard]] std::string number_text(double value);

}  // namespace isorelax::compare
