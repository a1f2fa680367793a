#include <fstream>
#include <iterator>
#include <set>

#include "compare/case.h"
#include "mesh/error.h"
#include "view/view.h"

namespace isorelax::compare {
namespace {

namespace fs = std::filesystem;

std::vector<std::uint8_t> bytes_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

std::string view_in(const fs::path& path) {
  const render::PictureTexts texts = render::read_png_texts(path);
  const auto found = texts.find(view::kViewKeyword);
  return found == texts.end() ? std::string() : found->second;
}

void add_figures(const ImageFigures& figures, Case& result) {
  const auto add = [&](const char* key, const char* label, double value) {
    result.figures.push_back({key, label, value, {}});
  };
  add("pixels", "Pixels", static_cast<double>(figures.pixels));
  add("equal_pixels", "Exactly equal pixels", static_cast<double>(figures.equal_pixels));
  add("largest_difference", "Largest difference of a channel, of 255", figures.largest);
  add("share_beyond_tolerance", "Share of pixels beyond the tolerance", figures.share_beyond);
  add("mean_ssim", "Mean structural similarity", figures.mean_ssim);
  add("worst_tile_ssim", "Structural similarity of the worst tile", figures.worst_tile_ssim);
  add("flip_mean", "Mean perceptual difference (FLIP)", figures.flip_mean);
  add("flip_p99", "99th percentile of the perceptual difference (FLIP)", figures.flip_p99);
  if (figures.is_equal()) {
    result.notes.emplace_back("The pictures are equal, pixel for pixel.");
  } else {
    result.notes.push_back("The worst tile of " + std::to_string(kTileSide) + " x " +
                           std::to_string(kTileSide) + " pixels begins at column " +
                           std::to_string(figures.worst_tile_x) + ", row " +
                           std::to_string(figures.worst_tile_y) + ".");
  }
}

/// Relative names of all pictures below a folder.
std::set<std::string> pictures_below(const fs::path& folder) {
  std::set<std::string> names;
  std::error_code problem;
  for (fs::recursive_directory_iterator at(folder, problem), end; !problem && at != end;
       at.increment(problem))
    if (at->path().extension() == ".png" && at->is_regular_file())
      names.insert(at->path().lexically_relative(folder).generic_string());
  if (problem) throw InputError(folder.string(), "", problem.message());
  return names;
}

Case lone(const std::string& name, const fs::path& a, const fs::path& b, bool in_a, Detail detail) {
  Case result;
  result.name = name;
  result.a = a.string();
  result.b = b.string();
  result.failure = in_a ? "missing: only the first folder has it" : "extra: only the second folder has it";
  const fs::path& there = in_a ? a : b;
  if (detail == Detail::pictures) result.pictures.push_back({in_a ? "A" : "B", bytes_of(there)});
  return result;
}

}  // namespace

Case compare_picture_files(const fs::path& a, const fs::path& b, const ImageLimits& limits, Detail detail) {
  Case result;
  result.name = b.filename().string();
  result.a = a.string();
  result.b = b.string();
  const render::Image image_a = render::read_png(a);
  const render::Image image_b = render::read_png(b);
  const ImageComparison comparison = compare_images(image_a, image_b, limits.tolerance);
  result.verdicts = judge(comparison.figures, limits);
  add_figures(comparison.figures, result);
  if (detail == Detail::figures) return result;
  result.view_a = view_in(a);
  result.view_b = view_in(b);
  result.pictures = {{"A", bytes_of(a)},
                     {"B", bytes_of(b)},
                     {"Perceptual difference (FLIP), black to white",
                      render::encode_png(heat_map(image_a, comparison.flip))}};
  return result;
}

std::vector<Case> compare_folders(const fs::path& a, const fs::path& b, const ImageLimits& limits,
                                  Detail detail) {
  const std::set<std::string> names_a = pictures_below(a);
  std::set<std::string> names = pictures_below(b);
  const std::set<std::string> names_b = names;
  names.insert(names_a.begin(), names_a.end());
  if (names.empty()) throw UsageError(a.string() + " and " + b.string() + " hold no PNG pictures");
  std::vector<Case> cases;
  for (const std::string& name : names) {
    if (!names_a.contains(name) || !names_b.contains(name)) {
      cases.push_back(lone(name, a / name, b / name, names_a.contains(name), detail));
      continue;
    }
    try {
      cases.push_back(compare_picture_files(a / name, b / name, limits, detail));
    } catch (const Error& error) {  // the others are compared all the same
      Case failed;
      failed.a = (a / name).string();
      failed.b = (b / name).string();
      failed.failure = error.what();
      cases.push_back(std::move(failed));
    }
    cases.back().name = name;
  }
  return cases;
}

}  // namespace isorelax::compare
