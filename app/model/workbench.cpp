#include "model/workbench.h"

#include "io/mesh_file.h"
#include "mesh/error.h"

namespace isorelax::model {
namespace {

// Settings that take no part in the problem do not make a new one.
SmoothingSettings problem_part(SmoothingSettings settings) {
  settings.iterations = 0;
  settings.tolerance = 0;
  return settings;
}

ReferenceChoice reference_choice(const SmoothingSettings& settings) {
  switch (settings.reference) {
    case ReferenceKind::mean_area:
      return MeanAreaReference{};
    case ReferenceKind::edge_length:
      return EdgeLengthReference{settings.edge_length};
    case ReferenceKind::initial:
      return InitialReference{};
    case ReferenceKind::file:
      break;
  }
  if (settings.reference_file.empty()) throw UsageError("reference: no file was chosen");
  return MeshReference{read_mesh(settings.reference_file).mesh.positions};
}

}  // namespace

ProblemOptions problem_options(const SmoothingSettings& settings) {
  ProblemOptions options;
  options.weights = EnergyWeights::from_mu(settings.mu_a);
  options.exponent = settings.exponent;
  options.reference = reference_choice(settings);
  options.boundary = settings.boundary;
  switch (settings.features) {
    case FeatureRule::automatic:
      break;
    case FeatureRule::none:
      options.features = FeatureOptions::none();
      break;
    case FeatureRule::angle:
      options.features.ridge_angle_deg = settings.feature_deg;
      break;
  }
  return options;
}

const SmoothingProblem& Workbench::problem(const DocumentPtr& document, const SmoothingSettings& settings) {
  if (problem_ && document_ == document && settings_ == problem_part(settings)) return *problem_;
  smoother_.reset();
  problem_.reset();
  const TriangleMesh& mesh = document->mesh();
  problem_ = std::make_unique<SmoothingProblem>(
      make_problem(mesh.positions, mesh.triangles, problem_options(settings)));
  smoother_ = make_smoother(*problem_, settings.solver);
  document_ = document;
  settings_ = problem_part(settings);
  return *problem_;
}

}  // namespace isorelax::model
