#pragma once

#include <cstdint>
#include <random>

namespace isorelax {

/// Random numbers that are the same on every platform: the generator is fixed by the C++ standard, the
/// distributions (which the standard leaves open) are made here from its raw bits.
class Random {
 public:
  explicit Random(std::uint64_t seed) : bits_(seed) {}

  /// Uniform in [0, 1), a multiple of 2^-53.
  double uniform() { return static_cast<double>(bits_() >> 11) * 0x1p-53; }
  /// Uniform in [low, high).
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// Uniform in 0 .. bound - 1 (to within bound / 2^64). Precondition: bound > 0.
  std::uint64_t below(std::uint64_t bound) { return bits_() % bound; }

 private:
  std::mt19937_64 bits_;
};

}  // namespace isorelax
