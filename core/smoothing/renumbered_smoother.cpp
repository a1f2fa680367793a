#include "smoothing/renumbered_smoother.h"

#include <algorithm>

#include "mesh/parallel.h"
#include "smoothing/renumbered_problem.h"

namespace isorelax {
namespace {

class RenumberedSmoother : public Smoother {
 public:
  RenumberedSmoother(const SmoothingProblem& problem, const SmootherFactory& make)
      : numbering_(problem.numbering),
        vertex_(inverse(numbering_.vertices)),
        triangle_(inverse(numbering_.triangles)),
        copy_(renumbered(problem)),
        smoother_(make(copy_)),
        positions_(problem.vertex_count()) {}

  [[nodiscard]] bool descends() const override { return smoother_->descends(); }
  [[nodiscard]] bool leads_on() const override { return smoother_->leads_on(); }

  void step(std::span<const Vec3> positions, StepRecord& record) override {
    parallel_for_blocks(positions.size(), copy_.threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) positions_[i] = positions[numbering_.vertices[i]];
    });
    smoother_->step(positions_, own_);
    restore(own_.gradient, vertex_, record.gradient);
    restore(own_.displacement, vertex_, record.displacement);
    restore(own_.alpha, vertex_, record.alpha);
    restore(own_.limits, vertex_, record.limits);
    restore(own_.tangent_class, vertex_, record.tangent_class);
    restore(own_.shape, triangle_, record.shape);
    restore(own_.area, triangle_, record.area);
    restore(own_.energy, triangle_, record.energy);
    record.detail.reset();
    if (own_.detail) restore_detail(*own_.detail, record.detail.emplace());
    record.kind = own_.kind;
    record.before = own_.before;
    record.after = own_.after;
    record.largest_move = own_.largest_move;
    record.fold_passes = own_.fold_passes;
    record.energy_passes = own_.energy_passes;
    record.moved = own_.moved;
  }

 private:
  /// From new numbers to old ones.
  template <typename T>
  void restore(const std::vector<T>& from, std::span<const Index> places, std::vector<T>& to) const {
    to.resize(from.size());
    parallel_for_blocks(from.size(), copy_.threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t old = begin; old < end; ++old) to[old] = from[places[old]];
    });
  }

  void restore_detail(StepDetail& from, StepDetail& to) const {
    restore(from.dimensions, vertex_, to.dimensions);
    restore(from.axis, vertex_, to.axis);
    restore(from.tangent, vertex_, to.tangent);
    restore(from.proposed, vertex_, to.proposed);
    to.passes = std::move(from.passes);
    for (ControlPass& pass : to.passes) {
      for (ControlCut& cut : pass.cuts) {
        cut.vertex = numbering_.vertices[cut.vertex];
        if (cut.triangle != kNone) cut.triangle = numbering_.triangles[cut.triangle];
      }
      std::ranges::stable_sort(pass.cuts, {}, &ControlCut::vertex);
    }
  }

  Renumbering numbering_;
  std::vector<Index> vertex_, triangle_;  // new numbers
  SmoothingProblem copy_;
  std::unique_ptr<Smoother> smoother_;
  std::vector<Vec3> positions_;
  StepRecord own_;
};

}  // namespace

std::unique_ptr<Smoother> make_near_in_memory(const SmoothingProblem& problem, const SmootherFactory& make) {
  if (problem.numbering.empty()) return make(problem);
  return std::make_unique<RenumberedSmoother>(problem, make);
}

}  // namespace isorelax
