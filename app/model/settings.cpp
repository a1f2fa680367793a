#include "model/settings.h"

#include <cmath>
#include <string>

namespace isorelax::model {

SmoothingSettings without_unused(SmoothingSettings settings) {
  const SmoothingSettings unused;
  if (settings.reference != ReferenceKind::edge_length) settings.edge_length = unused.edge_length;
  if (settings.reference != ReferenceKind::file) settings.reference_file = unused.reference_file;
  if (settings.features != FeatureRule::angle) settings.feature_deg = unused.feature_deg;
  if (settings.reach != Reach::typed) settings.max_deviation = unused.max_deviation;
  return settings;
}

bool same_energy(const SmoothingSettings& a, const SmoothingSettings& b) {
  return a.mu_a == b.mu_a && a.exponent == b.exponent && a.reference == b.reference &&
         (a.reference != ReferenceKind::edge_length || a.edge_length == b.edge_length) &&
         (a.reference != ReferenceKind::file || a.reference_file == b.reference_file);
}

std::string_view solver_option(Solver solver) {
  switch (solver) {
    case Solver::automatic:
      return "auto";
    case Solver::jacobi:
      return "jacobi";
    case Solver::newton:
      return "newton";
    case Solver::lbfgs:
      return "lbfgs";
  }
  return "";
}

std::string_view method_option(Method method) {
  switch (method) {
    case Method::near_isometry:
      return "near-isometry";
    case Method::laplacian:
      return "laplacian";
    case Method::angle_based:
      return "angle-based";
  }
  return "";
}

std::string_view polish_option(Polish polish) {
  switch (polish) {
    case Polish::none:
      return "none";
    case Polish::worst:
      return "worst";
    case Polish::mean:
      return "mean";
    case Polish::both:
      return "both";
  }
  return "";
}

std::string_view title(Method method) {
  switch (method) {
    case Method::near_isometry:
      return "Near-isometry";
    case Method::laplacian:
      return "Laplacian";
    case Method::angle_based:
      return "Angle-based";
  }
  return "";
}

std::string_view title(Coloring coloring) {
  switch (coloring) {
    case Coloring::none:
      return "None";
    case Coloring::min_angle:
      return "Min angle";
    case Coloring::max_angle:
      return "Max angle";
    case Coloring::relative_area:
      return "Area / mean";
    case Coloring::energy:
      return "Energy";
  }
  return "";
}

std::string_view unit(Coloring coloring) {
  switch (coloring) {
    case Coloring::min_angle:
    case Coloring::max_angle:
      return "deg";
    case Coloring::relative_area:
      return "x mean";
    case Coloring::none:
    case Coloring::energy:
      return "";
  }
  return "";
}

std::string describe_mu(double mu_a) {
  const int area = static_cast<int>(std::lround(100 * mu_a));
  if (area <= 0) return "angles only, areas may differ";
  if (area >= 100) return "areas only, angles do not count";
  return "shape " + std::to_string(100 - area) + " %, area " + std::to_string(area) + " %";
}

}  // namespace isorelax::model
