#include "trace/trace_parts.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "io/mesh_file.h"
#include "io/text_out.h"
#include "mesh/error.h"
#include "trace/position_delta.h"

namespace isorelax {

const TracePart* part_of(const Trace& trace, std::size_t iteration) {
  const TracePart* found = nullptr;
  for (const TracePart& part : trace.parts) {
    if (part.done < iteration) found = &part;
  }
  return found;
}

const RunWords& words_of(const Trace& trace, const TracePart& part) {
  return part.words ? *part.words : trace;
}

std::vector<Vec3> base_of(const Trace& trace, const TracePart& part) {
  std::vector<Vec3> base = trace.positions;
  if (!part.base.empty() && !apply_delta(part.base, base))
    throw Error("the part of the trace from iteration " + std::to_string(part.done + 1) + " on is damaged");
  return base;
}

std::string part_text(const TracePart& part) {
  const auto vertices = [](std::size_t count) {
    return std::to_string(count) + (count == 1 ? " vertex" : " vertices");
  };
  std::string text = "from iteration " + std::to_string(part.done + 1) + ": ";
  if (part.from_base) text += "untangled first, ";
  text += part.kind == PartKind::polish ? "polish, exponent " : "exponent ";
  append_number(text, part.exponent);
  if (!part.holds.still.empty()) text += ", " + vertices(part.holds.still.size()) + " held";
  if (std::isfinite(part.holds.distance)) {
    text += ", kept within ";
    append_number(text, part.holds.distance);
    if (part.holds.on_fits) text += " on the fits";
  }
  if (part.holds.apart) text += ", kept from crossing itself";
  if (part.words) {
    text += ", arguments";
    for (const std::string& word : part.words->arguments) text += " " + word;
  }
  return text;
}

bool says_more_than_words(const Trace& trace, const TracePart& part) {
  const auto& words = words_of(trace, part).arguments;
  const bool chosen =
      part.exponent != kDefaultExponent && std::find(words.begin(), words.end(), "--exponent") == words.end();
  return chosen || part.from_base || !part.holds.still.empty() || part.holds.apart ||
         std::isfinite(part.holds.distance);
}

bool same_bits(std::span<const Vec3> first, std::span<const Vec3> second) {
  return first.size() == second.size() && std::memcmp(first.data(), second.data(), first.size_bytes()) == 0;
}

void check_resources(const RunWords& words) {
  for (const TraceResource& file : words.resources) {
    if (hash_of(read_bytes(file.path)) != file.hash)
      throw InputError(file.path, "", "is not what the recorded run read: its hash differs");
  }
}

}  // namespace isorelax
