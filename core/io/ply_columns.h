#pragma once

#include <string>
#include <vector>

#include "io/ply_header.h"
#include "mesh/attributes.h"

namespace isorelax {

/// Values of one property, one per row of its element.
struct PlyColumn {
  std::string name;
  ScalarType type = ScalarType::float64;
  std::vector<double> values;
};

/// Joins columns that mean one thing (nx ny nz; red green blue and, where there, alpha; s t) and have one
/// type into an attribute with the meaning's name; every other column becomes an attribute of its own name.
[[nodiscard]] std::vector<Attribute> join_columns(std::vector<PlyColumn>&& columns);

/// The property names under which an attribute is written: nx ny nz for a "normal" of three numbers and so
/// on.
[[nodiscard]] std::vector<std::string> ply_names(const Attribute& attribute);

}  // namespace isorelax
