#include "support/golden.h"

#include <filesystem>

namespace isorelax::test {
namespace {

namespace fs = std::filesystem;
using render::Image;

fs::path baseline_path(const std::string& name) {
  return fs::path(ISORELAX_SOURCE_DIR) / "tests" / "baselines" / (name + ".png");
}

fs::path failure_path(const std::string& name, const std::string& kind) {
  const fs::path folder = fs::path(ISORELAX_BINARY_DIR) / "image_failures";
  fs::create_directories(folder);
  return folder / (name + "." + kind + ".png");
}

bool same_size(const Image& a, const Image& b) {
  return a.width == b.width && a.height == b.height;
}

}  // namespace

Image read_baseline(const std::string& name) {
  return render::read_png(baseline_path(name));
}

bool passes_for_baseline(const Image& actual, const std::string& name, const compare::ImageLimits& limits) {
  const Image expected = read_baseline(name);
  return same_size(actual, expected) &&
         all_hold(judge(compare::compare_images(expected, actual, limits.tolerance).figures, limits));
}

testing::AssertionResult matches_baseline(const Image& actual, const std::string& name,
                                          const compare::ImageLimits& limits) {
  for (const char* kind : {"actual", "expected", "difference"}) fs::remove(failure_path(name, kind));
  const fs::path actual_path = failure_path(name, "actual");
  if (!fs::exists(baseline_path(name))) {
    render::write_png(actual_path, actual);
    return testing::AssertionFailure()
           << "there is no baseline " << baseline_path(name).string() << "\nactual: " << actual_path.string();
  }
  const Image expected = read_baseline(name);
  auto failure = testing::AssertionFailure() << name << ": ";
  if (same_size(actual, expected)) {
    const auto comparison = compare::compare_images(expected, actual, limits.tolerance);
    const auto verdicts = judge(comparison.figures, limits);
    if (all_hold(verdicts)) return testing::AssertionSuccess();
    render::write_png(failure_path(name, "difference"), compare::heat_map(expected, comparison.flip));
    for (const compare::Verdict& v : verdicts)
      failure << "\n  " << v.meaning << ": " << v.found << (v.at_least ? ", at least " : ", at most ")
              << v.limit << (v.holds ? "" : "  BROKEN");
    failure << "\ndifference: " << failure_path(name, "difference").string();
  } else {
    failure << actual.width << "x" << actual.height << " instead of " << expected.width << "x"
            << expected.height;
  }
  render::write_png(actual_path, actual);
  render::write_png(failure_path(name, "expected"), expected);
  return failure << "\nactual: " << actual_path.string()
                 << "\nexpected: " << failure_path(name, "expected").string();
}

}  // namespace isorelax::test
