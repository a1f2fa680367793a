#include "trace/trace.h"

#include "mesh/error.h"
#include "trace/position_delta.h"

namespace isorelax {

std::string Trace::arguments_text() const {
  std::string text;
  for (const std::string& word : arguments) text += (text.empty() ? "" : " ") + word;
  return text;
}

const std::vector<Vec3>& TraceCursor::go_to(std::size_t iteration) {
  if (iteration > trace_.iterations.size()) {
    throw Error("iteration " + std::to_string(iteration) + " is not in the trace, which holds " +
                std::to_string(trace_.iterations.size()));
  }
  while (iteration_ != iteration) {
    // The delta of an iteration leads both to it and back from it.
    const bool forward = iteration_ < iteration;
    const std::size_t crossed = forward ? iteration_ : iteration_ - 1;
    if (!apply_delta(trace_.iterations[crossed].delta, positions_))
      throw Error("iteration " + std::to_string(crossed + 1) + " of the trace is damaged");
    iteration_ = forward ? iteration_ + 1 : iteration_ - 1;
  }
  return positions_;
}

std::uint64_t fnv1a(std::string_view bytes) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char byte : bytes) {
    hash ^= static_cast<unsigned char>(byte);
    hash *= 0x100000001b3U;
  }
  return hash;
}

std::string hash_of(std::string_view bytes) {
  std::uint64_t hash = fnv1a(bytes);
  std::string text(16, '0');
  for (std::size_t digit = 16; digit-- > 0; hash >>= 4) text[digit] = "0123456789abcdef"[hash & 15];
  return text;
}

}  // namespace isorelax
