#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "trace/trace.h"

namespace isorelax {

/// One line per iteration under a line of names: iteration, then the numbers of visit_numbers(). Line 0 has
/// the quality and the energies at the start, and nothing where a step would be told of. Numbers are the
/// shortest that give the same bits.
[[nodiscard]] std::string trace_csv(const Trace& trace);

/// The whole record but positions, as JSON: head, and a list of iterations with the numbers of
/// visit_numbers().
[[nodiscard]] std::string trace_json(const Trace& trace);

/// Writes the meshes after the given iterations into a folder, which is made if missing: iteration_00007.off
/// and so on. Returns the files. Throws Error for an iteration that is not there, OutputError.
std::vector<std::filesystem::path> export_meshes(const Trace& trace,
                                                 const std::vector<std::size_t>& iterations,
                                                 const std::filesystem::path& folder,
                                                 const std::string& extension);

/// Writes the given iterations as VTK PolyData (.vtp) with smallest and largest angle and area of each
/// triangle and the displacement from the start of each vertex, and trace.pvd, which ParaView opens as a
/// series. Returns the files, the index last. Throws as export_meshes.
std::vector<std::filesystem::path> export_vtk_series(const Trace& trace,
                                                     const std::vector<std::size_t>& iterations,
                                                     const std::filesystem::path& folder);

}  // namespace isorelax
