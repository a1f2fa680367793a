#pragma once

// Functions whose loops the compiler turns into vector instructions exist twice: for processors with AVX2 and
// for all. Both give the same bits: no operation is reordered or fused. Sanitizers cannot start a program
// that picks functions at load time.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define ISORELAX_VECTOR_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define ISORELAX_VECTOR_CLONES
#endif

namespace isorelax {

/// Elements handled together: the loops over lanes are what gets vectorised.
inline constexpr unsigned kLanes = 8;

/// One number of each lane.
struct alignas(64) Lanes {
  double at[kLanes];
};

}  // namespace isorelax
