#include "motion/sampled_field.h"

#include <fast_float/fast_float.h>

#include <algorithm>
#include <cmath>

#include "io/mesh_file.h"

namespace isorelax {
namespace {

struct Grid {
  std::array<std::size_t, 3> count{};
  Vec3 origin = Vec3::Zero();
  Vec3 spacing = Vec3::Ones();
  std::vector<Vec3> values;  ///< x runs fastest

  [[nodiscard]] double points() const {
    return static_cast<double>(count[0]) * static_cast<double>(count[1]) * static_cast<double>(count[2]);
  }
};

class SampledField final : public VelocityField {
 public:
  explicit SampledField(Grid grid) : grid_(std::move(grid)) {}

  [[nodiscard]] Vec3 at(const Vec3& x, double) const override {
    std::array<std::size_t, 3> cell{};
    Vec3 share;
    for (int i = 0; i < 3; ++i) {
      const double along = (x[i] - grid_.origin[i]) / grid_.spacing[i];
      const auto last = static_cast<double>(grid_.count[i] - 1);
      if (!(along >= 0 && along <= last)) throw Error("the point lies outside of the sampled grid");
      const double low = std::clamp(std::floor(along), 0.0, std::max(0.0, last - 1));
      cell[i] = static_cast<std::size_t>(low);
      share[i] = along - low;
    }
    Vec3 sum = Vec3::Zero();
    for (unsigned corner = 0; corner < 8; ++corner) {
      double weight = 1;
      std::array<std::size_t, 3> at{};
      for (unsigned i = 0; i < 3; ++i) {
        const unsigned upper = corner >> i & 1U;
        weight *= upper == 1 ? share[i] : 1 - share[i];
        at[i] = std::min(cell[i] + upper, grid_.count[i] - 1);
      }
      sum += weight * grid_.values[at[0] + grid_.count[0] * (at[1] + grid_.count[1] * at[2])];
    }
    return sum;
  }

 private:
  Grid grid_;
};

/// Words of a text with the line they stand on.
class Words {
 public:
  Words(std::string_view text, std::string name) : text_(text), name_(std::move(name)) {}

  [[noreturn]] void fail(const std::string& reason) const {
    throw InputError(name_, "line " + std::to_string(line_), reason);
  }
  std::string_view rest_of_line() {
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    const std::string_view line = text_.substr(at_, end - at_);
    at_ = std::min(end + 1, text_.size());
    ++line_;
    return line;
  }
  std::string_view word() {
    while (at_ < text_.size() && is_space(text_[at_])) line_ += text_[at_++] == '\n' ? 1 : 0;
    const std::size_t begin = at_;
    while (at_ < text_.size() && !is_space(text_[at_])) ++at_;
    return text_.substr(begin, at_ - begin);
  }
  void expect(std::string_view wanted) {
    if (word() != wanted) fail("expected " + std::string(wanted));
  }
  template <typename Number>
  Number number() {
    const std::string_view digits = word();
    double value = 0;
    const auto [end, error] = fast_float::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc() || end != digits.data() + digits.size() || !std::isfinite(value))
      fail("expected a number, not \"" + std::string(digits.substr(0, 40)) + "\"");
    if constexpr (std::is_integral_v<Number>)
      if (!(value >= 1 && value <= 1e9) || value != std::floor(value)) fail("expected a count of 1 or more");
    return static_cast<Number>(value);
  }

 private:
  static bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }
  std::string_view text_;
  std::string name_;
  std::size_t at_ = 0;
  std::size_t line_ = 1;
};

/// A value takes six bytes at least: what a header claims beyond that is not there.
void check_size(const Grid& grid, std::size_t bytes, const Words& words) {
  if (grid.points() > static_cast<double>(bytes) / 6)
    words.fail("DIMENSIONS ask for more points than the file holds");
}

Grid read_grid(std::string_view bytes, const std::string& name) {
  Words words(bytes, name);
  if (!words.rest_of_line().starts_with("# vtk DataFile")) {
    throw InputError(name, "line 1", "not a legacy VTK file: expected \"# vtk DataFile Version ...\"");
  }
  static_cast<void>(words.rest_of_line());  // the title
  words.expect("ASCII");
  words.expect("DATASET");
  words.expect("STRUCTURED_POINTS");
  Grid grid;
  for (int i = 0; i < 3; ++i) {
    const std::string_view key = words.word();
    if (key == "DIMENSIONS") {
      for (std::size_t& count : grid.count) count = words.number<std::size_t>();
      check_size(grid, bytes.size(), words);
    } else if (key == "ORIGIN") {
      for (int k = 0; k < 3; ++k) grid.origin[k] = words.number<double>();
    } else if (key == "SPACING" || key == "ASPECT_RATIO") {
      for (int k = 0; k < 3; ++k) grid.spacing[k] = words.number<double>();
      if (!(grid.spacing.minCoeff() > 0)) words.fail("the spacing is not positive");
    } else {
      words.fail("expected DIMENSIONS, ORIGIN or SPACING");
    }
  }
  if (grid.count[0] == 0) words.fail("DIMENSIONS are missing");
  const double points = grid.points();
  words.expect("POINT_DATA");
  if (static_cast<double>(words.number<std::size_t>()) != points)
    words.fail("POINT_DATA does not count as many points as DIMENSIONS");
  words.expect("VECTORS");
  static_cast<void>(words.word());  // the name
  static_cast<void>(words.word());  // the type
  grid.values.resize(static_cast<std::size_t>(points));
  for (Vec3& value : grid.values)
    for (int k = 0; k < 3; ++k) value[k] = words.number<double>();
  return grid;
}

}  // namespace

std::unique_ptr<VelocityField> read_sampled_field(const std::filesystem::path& path) {
  return std::make_unique<SampledField>(read_grid(read_bytes(path), path.string()));
}

}  // namespace isorelax
