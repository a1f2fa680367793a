#include "smoothing/slide_first.h"

#include <algorithm>

#include "smoothing/trial.h"

namespace isorelax {
namespace {

/// So many sliding steps in a row that lower the energy by less than this share are the last: a single one
/// may have been cut back.
constexpr double kLeastSlidingGain = 1e-4;
constexpr unsigned kIdleSlides = 5;
/// Edge lengths that a vertex may be from its outline and still counts as on it: rounding.
constexpr double kOnOutline = 1e-9;

class SlideFirst : public Smoother {
 public:
  SlideFirst(const SmoothingProblem& problem, SmootherFactory make)
      : make_(std::move(make)), free_(problem), sliding_(*problem.sliding) {
    sliding_.exponent = problem.exponent;
  }

  [[nodiscard]] bool leads_on() const override { return slider_ || (freed_ && freed_->leads_on()); }

  void step(std::span<const Vec3> positions, StepRecord& record) override {
    if (!std::ranges::equal(positions, led_to_)) {
      slider_ = is_on_outline(positions) ? make_(sliding_) : nullptr;
      idle_ = 0;
    }
    if (slider_) {
      slider_->step(positions, record);
      const double gain = record.before.movable_energy - record.after.movable_energy;
      idle_ = gain < kLeastSlidingGain * record.before.movable_energy ? idle_ + 1 : 0;
      if (record.moved == 0 || idle_ > kIdleSlides) slider_.reset();
    }
    if (!slider_) {
      if (!freed_) freed_ = make_(free_);
      freed_->step(positions, record);
    }
    led_to_.assign(positions.begin(), positions.end());
    apply_step(record, led_to_);
  }

 private:
  [[nodiscard]] bool is_on_outline(std::span<const Vec3> positions) const {
    const double far = kOnOutline * sliding_.mean_edge_length;
    return std::ranges::all_of(sliding_.border, [&](const auto& one) {
      const Vec3& x = positions[one.first];
      return (bring_back(sliding_, one.first, x) - x).norm() <= far;
    });
  }

  SmootherFactory make_;
  const SmoothingProblem& free_;
  SmoothingProblem sliding_;
  std::unique_ptr<Smoother> slider_, freed_;
  std::vector<Vec3> led_to_;
  unsigned idle_ = 0;  // sliding steps in a row that gained next to nothing
};

}  // namespace

std::unique_ptr<Smoother> make_slide_first(const SmoothingProblem& problem, const SmootherFactory& make) {
  if (!problem.sliding) return make(problem);
  return std::make_unique<SlideFirst>(problem, make);
}

}  // namespace isorelax
