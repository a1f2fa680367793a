#pragma once

#include <string>

#include "cli/json.h"
#include "cli/paper_table.h"
#include "render/image.h"

namespace isorelax::cli {

/// The table for people, with the paper's figures in brackets, and where the paper is silent.
[[nodiscard]] std::string paper_text(const std::vector<PaperRow>& rows, const PaperTableOptions& options);
/// The same as one JSON object; a dash is null.
[[nodiscard]] Json paper_json(const std::vector<PaperRow>& rows, const PaperTableOptions& options);
/// Like the paper's Fig. 2: U1 and R1, each as made and after the method that the paper calls CNEA.
[[nodiscard]] render::Image paper_picture(const std::vector<PaperRow>& rows);

}  // namespace isorelax::cli
