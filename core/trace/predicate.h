#pragma once

#include <functional>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/error.h"
#include "trace/trace.h"

namespace isorelax {

/// A predicate that cannot be read, and where: what() is the text, the column and the reason.
class PredicateError : public UsageError {
 public:
  PredicateError(const std::string& text, std::size_t column, const std::string& reason)
      : UsageError(text + ": column " + std::to_string(column) + ": " + reason),
        column_(column),
        reason_(reason) {}
  [[nodiscard]] std::size_t column() const { return column_; }  ///< from 1
  [[nodiscard]] const std::string& reason() const { return reason_; }

 private:
  std::size_t column_;
  std::string reason_;
};

/// What a predicate can ask about: one iteration of a run.
struct Moment {
  std::size_t iteration = 0;  ///< from 1
  const TraceIteration& numbers;
  const StepRecord& record;
  std::span<const Vec3> positions;  ///< after the step
  std::span<const Triangle> triangles;
  std::size_t inverted_at_start = 0;
  bool stop = false;  ///< the run ends with this iteration
  /// Of a moving surface; not a number otherwise: comparisons with it are false.
  double time = std::numeric_limits<double>::quiet_NaN();
};

/// A condition on the iterations of a run, such as
///   min_angle < 5      energy_rose      folded > 0      class_changed      iteration == 40      stop
///   vertex(812).alpha < 0.1 && !energy_rose      triangle(3).min_angle < 2 * min_angle
/// Numbers, names, vertex(ID).FIELD, triangle(ID).FIELD; in rising order of binding: || ; && ; < <= > >= ==
/// != ;
/// + - ; * / ; - ! ; parentheses. Everything is a number; true is 1, and what is not 0 holds.
class Predicate {
 public:
  /// Throws PredicateError: the text, the column and what was expected there. Ids are looked at by `check`.
  explicit Predicate(std::string text);

  /// Throws PredicateError at the first vertex or triangle that a mesh of so many does not have.
  void check(std::size_t vertices, std::size_t triangles) const;

  /// Whether it holds. A vertex or triangle that does not exist has no value: comparisons with it are false.
  [[nodiscard]] bool holds(const Moment& moment) const;
  /// What its names stand for at a moment: "min_angle = 4.5, vertex(812).alpha = 0"; empty where it has none.
  [[nodiscard]] std::string values(const Moment& moment) const;
  [[nodiscard]] const std::string& text() const { return text_; }

  /// Every name and field with its meaning, one per line: for --help and the editor.
  [[nodiscard]] static std::string reference();

  using Value = std::function<double(const Moment&)>;
  /// A vertex or triangle that the text names.
  struct Element {
    bool is_vertex;
    Index id;
    std::size_t column;  ///< of the id, from 1
  };
  /// A name in the text, with its vertex or triangle.
  struct Named {
    std::string name;
    Value value;
  };

 private:
  std::string text_;
  std::vector<Element> elements_;
  std::vector<Named> named_;  // each once
  Value value_;
};

}  // namespace isorelax
