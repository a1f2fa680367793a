#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "trace/trace.h"

namespace isorelax {

/// Trace files. After the eight letters of kTraceMagic and a version stand parts, one after the other:
///   name (4 letters), size of the content (8 bytes), size as stored (8), what is stored, hash (8)
/// HEAD: JSON: program, input, arguments, resources, counts, quality at the start, why the run stopped
/// MESH: positions and triangles; then for each TracePart PART: its numbers, its held vertices, its words as
/// JSON, and BASE: its delta (nothing where there is none); then for each iteration STEP: its numbers, and
/// MOVE: its delta; DONE: nothing. Contents are compressed with zstd; the hash is FNV-1a over all of the
/// part. Numbers are little endian.
///
/// PART begins with done (8 bytes), exponent, distance of the holds (doubles), flags (8: 1 polish, 2
/// from_base, 4 words of its own, 8 on_fits, 16 apart), the count of vertices held still (8) and these
/// vertices (4 each). Version 1 had no TraceParts; version 2 had after that count another one, of vertices
/// about which the distance was kept, and those after the others: their parts are read as keeping it
/// everywhere. Up to version 3 STEP did not tell what made the step; up to version 4 nothing stayed on fits;
/// up to version 5 no part was kept apart.
inline constexpr std::string_view kTraceMagic = "ISOTRACE";
inline constexpr std::uint32_t kTraceVersion = 6;
inline constexpr std::uint32_t kFirstTraceVersion = 1;
inline constexpr std::uint32_t kVersionOfKeptVertices = 2;
inline constexpr std::uint32_t kFirstVersionOfKinds = 4;
enum TracePartFlag : std::uint64_t {
  kTracePartPolish = 1,
  kTracePartFromBase = 2,
  kTracePartWords = 4,
  kTracePartOnFits = 8,
  kTracePartApart = 16
};

/// The bytes of a trace file.
[[nodiscard]] std::string trace_bytes(const Trace& trace);

/// Writes a trace whole or not at all. Throws OutputError.
void write_trace(const std::filesystem::path& path, const Trace& trace);

/// Reads a trace from its bytes; `name` stands in messages. Throws InputError, with the byte where it begins,
/// for anything that is foreign, of another version, damaged or missing.
[[nodiscard]] Trace parse_trace(std::string_view bytes, const std::string& name);

/// Whether a file begins as traces do; one that cannot be read does not.
[[nodiscard]] bool is_trace(const std::filesystem::path& path);

/// Throws InputError.
[[nodiscard]] Trace read_trace(const std::filesystem::path& path);

/// The numbers of one iteration, in the order of the file, and at last what made it: for each a name, and how
/// to read and write it.
template <typename Iteration, typename Visit>
void visit_numbers(Iteration& iteration, const Visit& visit) {
  visit("energy_before", iteration.before.energy);
  visit("shape_before", iteration.before.shape);
  visit("area_before", iteration.before.area);
  visit("worst_energy_before", iteration.before.worst_energy);
  visit("gradient_norm", iteration.before.gradient_norm);
  visit("energy", iteration.after.energy);
  visit("shape", iteration.after.shape);
  visit("area", iteration.after.area);
  visit("worst_energy", iteration.after.worst_energy);
  visit("largest_move", iteration.largest_move);
  visit("fold_passes", iteration.fold_passes);
  visit("energy_passes", iteration.energy_passes);
  visit("moved", iteration.moved);
  for (std::size_t bit = 0; bit < iteration.limits.size(); ++bit)
    visit("limited_" + std::string(limit_name(limit_of_bit(bit))), iteration.limits[bit]);
  visit("class_changes", iteration.class_changes);
  visit("min_angle_deg", iteration.quality.min_angle_deg);
  visit("max_angle_deg", iteration.quality.max_angle_deg);
  visit("mean_min_angle_deg", iteration.quality.mean_min_angle_deg);
  visit("inverted", iteration.quality.inverted);
  visit("kind", iteration.kind);
}

}  // namespace isorelax
