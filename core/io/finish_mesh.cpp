#include <algorithm>
#include <cmath>

#include "io/polygon_soup.h"
#include "io/text_scanner.h"
#include "mesh/error.h"

namespace isorelax {
namespace {

void carry_over(const Triangulation& cut, MeshAttributes& attributes) {
  for (Attribute& attribute : attributes.face) {
    std::vector<double> values;
    values.reserve(cut.face.size() * attribute.width);
    for (const std::uint32_t face : cut.face) {
      const auto begin = attribute.values.begin() + static_cast<std::ptrdiff_t>(face) * attribute.width;
      values.insert(values.end(), begin, begin + attribute.width);
    }
    attribute.values = std::move(values);
  }
  for (FaceLabels& labels : attributes.face_labels) {
    std::vector<std::uint32_t> of_triangles;
    of_triangles.reserve(cut.face.size());
    for (const std::uint32_t face : cut.face) {
      of_triangles.push_back(labels.face_label[face]);
    }
    labels.face_label = std::move(of_triangles);
  }
  // Labels of left-out faces only label nothing.
  std::erase_if(attributes.face_labels, [](const FaceLabels& labels) {
    return std::all_of(labels.face_label.begin(), labels.face_label.end(),
                       [](std::uint32_t label) { return label == kNone; });
  });
  for (CornerAttribute& attribute : attributes.corner) {
    std::vector<std::uint32_t> indices;
    indices.reserve(cut.corner.size());
    for (const std::uint32_t corner : cut.corner) {
      indices.push_back(attribute.indices[corner]);
    }
    attribute.indices = std::move(indices);
  }
}

void report_cuts(const Triangulation& cut, std::vector<std::string>& messages) {
  if (cut.polygons > 0) {
    messages.push_back(counted(cut.polygons, "polygon", "polygons") +
                       " with more than three corners cut into " + std::to_string(cut.polygon_triangles) +
                       " triangles");
  }
  if (cut.self_crossing > 0) {
    messages.push_back(counted(cut.self_crossing, "polygon is", "polygons are") +
                       " degenerate or self-crossing: the triangles cut from it may overlap");
  }
  if (cut.skipped_faces > 0) {
    messages.push_back(counted(cut.skipped_faces, "face", "faces") +
                       " with fewer than three corners left out");
  }
}

void report_not_finite(const MeshAttributes& attributes, std::vector<std::string>& messages) {
  const auto report = [&](const std::string& what, const std::vector<double>& values) {
    const auto count =
        std::count_if(values.begin(), values.end(), [](double v) { return !std::isfinite(v); });
    if (count > 0) {
      messages.push_back(counted(static_cast<std::size_t>(count), "value", "values") + " of " + what +
                         " not finite, kept as found");
    }
  };
  for (const Attribute& attribute : attributes.vertex) {
    report("the vertex attribute " + in_quotes(attribute.name), attribute.values);
  }
  for (const Attribute& attribute : attributes.face) {
    report("the face attribute " + in_quotes(attribute.name), attribute.values);
  }
  for (const CornerAttribute& attribute : attributes.corner) {
    report("the corner attribute " + in_quotes(attribute.name), attribute.values);
  }
}

}  // namespace

Triangulation triangulate(std::span<const Vec3> positions, const PolygonSoup& faces) {
  Triangulation result;
  result.triangles.reserve(faces.face_count());
  result.face.reserve(faces.face_count());
  result.corner.reserve(faces.vertices.size());
  std::vector<Vec3> corners;
  std::vector<std::array<std::uint32_t, 3>> cuts;
  for (std::uint32_t face = 0; face < faces.face_count(); ++face) {
    const std::uint32_t first = faces.first_corner[face];
    const std::uint32_t size = faces.first_corner[face + 1] - first;
    if (size < 3) {
      ++result.skipped_faces;
      continue;
    }
    cuts.assign(1, {0, 1, 2});
    if (size > 3) {
      corners.clear();
      cuts.clear();
      for (std::uint32_t k = 0; k < size; ++k) {
        corners.push_back(positions[faces.vertices[first + k]]);
      }
      result.self_crossing += triangulate_polygon(corners, cuts) ? 0 : 1;
      ++result.polygons;
      result.polygon_triangles += cuts.size();
    }
    for (const auto& cut : cuts) {
      result.triangles.push_back(
          {faces.vertices[first + cut[0]], faces.vertices[first + cut[1]], faces.vertices[first + cut[2]]});
      result.face.push_back(face);
      result.corner.insert(result.corner.end(), {first + cut[0], first + cut[1], first + cut[2]});
    }
  }
  return result;
}

MeshFile finish_mesh(RawMesh&& raw, FileFormat format, FileEncoding encoding, const std::string& name) {
  if (raw.positions.empty()) {
    throw InputError(one_line(name), "", "holds no vertices");
  }
  Triangulation cut = triangulate(raw.positions, raw.faces);
  if (cut.triangles.empty()) {
    throw InputError(one_line(name), "", "holds no triangles");
  }
  if (cut.polygons > 0 || cut.skipped_faces > 0) {
    carry_over(cut, raw.attributes);
  }
  MeshFile file;
  file.format = format;
  file.encoding = encoding;
  file.messages = std::move(raw.messages);
  report_cuts(cut, file.messages);
  report_not_finite(raw.attributes, file.messages);
  file.mesh = {std::move(raw.positions), std::move(cut.triangles), std::move(raw.attributes)};
  return file;
}

std::string counted(std::size_t count, const char* singular, const char* plural) {
  return std::to_string(count) + " " + (count == 1 ? singular : plural);
}

}  // namespace isorelax
