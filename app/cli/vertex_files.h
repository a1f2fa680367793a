#pragma once

#include <optional>
#include <string>
#include <vector>

#include "smoothing/problem.h"

namespace isorelax::cli {

class Console;

/// A number that is the whole of the text; none otherwise.
[[nodiscard]] std::optional<double> parse_number(std::string_view text);

/// The vertices that every `--pin` names: boundary | feature | box:X0,Y0,Z0:X1,Y1,Z1 | vertices:ID,ID,... |
/// FILE of vertex numbers from 0, separated by white space or commas, # starting a comment. Says how many
/// each predicate holds. Throws UsageError for a box that is none, InputError for what is no number of a
/// vertex.
[[nodiscard]] std::vector<Index> parse_pins(Console& console, const std::vector<std::string>& pins,
                                            const TriangleMesh& mesh, const ProblemOptions& options);

/// Target edge lengths from a text file: one positive number for each vertex, in order, separated by white
/// space or commas, # starting a comment. Throws InputError with the line.
[[nodiscard]] std::vector<double> read_size_field(const std::string& path, std::size_t vertex_count);

}  // namespace isorelax::cli
