#pragma once

#include <span>
#include <string_view>

#include "trace/predicate.h"

namespace isorelax {

/// A word of the predicate language that stands alone.
struct PredicateName {
  std::string_view name, meaning;
  double (*value)(const Moment&);
};
/// A word behind vertex(ID). or triangle(ID). : called with an id that exists.
struct PredicateField {
  std::string_view name, meaning;
  double (*value)(const Moment&, Index);
};

[[nodiscard]] std::span<const PredicateName> predicate_names();
[[nodiscard]] std::span<const PredicateField> vertex_fields();
[[nodiscard]] std::span<const PredicateField> triangle_fields();

}  // namespace isorelax
