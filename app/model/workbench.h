#pragma once

#include <memory>

#include "model/document.h"
#include "model/settings.h"
#include "smoothing/run.h"

namespace isorelax::model {

/// The frozen problem of the open document, kept between runs while settings stay the same. Belongs to the
/// worker.
///
/// The problem is always made from the mesh as it was opened, so that a run that was paused and continued
/// goes where one long run goes.
class Workbench {
 public:
  /// The problem for these settings; made anew only when they ask for another one. Throws Error.
  const SmoothingProblem& problem(const DocumentPtr& document, const SmoothingSettings& settings);
  /// A smoother on the last problem. Precondition: problem() was called and did not throw.
  [[nodiscard]] Smoother& smoother() { return *smoother_; }

 private:
  DocumentPtr document_;
  SmoothingSettings settings_;
  std::unique_ptr<SmoothingProblem> problem_;
  std::unique_ptr<Smoother> smoother_;
};

/// The library's options for these settings. Reads the reference file; throws Error.
[[nodiscard]] ProblemOptions problem_options(const SmoothingSettings& settings);

}  // namespace isorelax::model
