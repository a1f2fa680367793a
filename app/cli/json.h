#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

#include "mesh/validation.h"
#include "quality/report.h"

namespace isorelax::cli {

using Json = nlohmann::ordered_json;

/// The object of `quality --json` and of a smoothing report. A number that is infinite becomes null.
[[nodiscard]] Json to_json(const QualityReport& report);
/// The object of `info --json`: counts and every flaw with all its ids.
[[nodiscard]] Json to_json(const ValidationReport& report);
/// One triangle of a worst-first list.
[[nodiscard]] Json triangle_to_json(const TriangleMesh& mesh, Index triangle);

/// Text of a document: indented, numbers with all their digits, a line break at the end. Bytes that are not
/// UTF-8 (in file names) become replacement characters.
[[nodiscard]] std::string json_text(const Json& document);

}  // namespace isorelax::cli
