#pragma once

#include "smoothing/coarse_correction.h"

namespace isorelax {

/// One vector per vertex, zero where nothing may move.
using Field = std::vector<Vec3>;

/// The last moves and changes of the gradient along them, and the direction that follows from them.
///
/// Nocedal's two loops in terms of inner products: those between what is remembered are kept, so that one
/// step reads every remembered vector twice, and no vector is written but the result. All sums have one
/// order, for any number of threads.
class LbfgsMemory {
 public:
  /// Remembers up to `pairs` pairs; with none, directions are those of the blocks.
  LbfgsMemory(std::size_t vertices, unsigned pairs, unsigned threads);

  [[nodiscard]] bool empty() const { return used_.empty(); }
  void clear() { used_.clear(); }
  /// Forgets also where the run was: the next call of `arrive` is the first.
  void start_anew() {
    clear();
    last_positions_.clear();
  }

  /// Tells where the run has come to, the tangent gradient there, and its part that a direction is asked for
  /// (zero at other vertices). The pair of changes since the last call is remembered if the energy curves
  /// upward along it; a move shorter than `useless` clears the memory: what is remembered does not fit here.
  void arrive(std::span<const Vec3> positions, const Field& gradient, const Field& wanted, double useless);

  /// Fills `direction` with minus the inverse Hessian that is remembered times the wanted part of the
  /// gradient of `arrive`, started from the inverses of `blocks` plus, if there is one, of `coarse`, and
  /// brought back to their tangent spaces. Returns its product with that part: not negative if it does not
  /// lead downhill.
  double direction(const Field& wanted, std::span<const NewtonBlock> blocks, CoarseCorrection* coarse,
                   Field& direction);

 private:
  struct Pair {
    Field move, change;
    double along_gradient = 0;         // move . gradient
    std::vector<double> with_changes;  // move . change of every slot
  };

  /// Calls body(begin, end, sums) for every block and adds up the sums, `count` of them, into totals_.
  template <typename Body>
  void reduce(std::size_t count, const Body& body);
  [[nodiscard]] Pair& pair(std::size_t k) { return slots_[used_[k]]; }

  std::size_t vertices_;
  unsigned pairs_, threads_;
  std::vector<Pair> slots_;          // one more than pairs: the newest is made in a free one
  std::vector<std::uint32_t> used_;  // slots, oldest first
  Field last_positions_, last_gradient_;
  std::vector<double> partials_, totals_;
};

}  // namespace isorelax
