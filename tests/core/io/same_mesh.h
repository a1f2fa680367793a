#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include "mesh/triangle_mesh.h"

namespace isorelax {

/// The same bits; any NaN counts as any other.
inline bool same_number(double a, double b) {
  return (std::isnan(a) && std::isnan(b)) ||
         std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

inline bool same_numbers(const std::vector<double>& a, const std::vector<double>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), same_number);
}

inline bool same_position(const Vec3& a, const Vec3& b) {
  return same_number(a.x(), b.x()) && same_number(a.y(), b.y()) && same_number(a.z(), b.z());
}

inline bool same_geometry(const TriangleMesh& a, const TriangleMesh& b) {
  return std::equal(a.positions.begin(), a.positions.end(), b.positions.begin(), b.positions.end(),
                    same_position) &&
         a.triangles == b.triangles;
}

/// Whether each triangle's corners stand in the same places, however vertices are shared; -0 counts as 0.
inline bool same_corners(const TriangleMesh& a, const TriangleMesh& b) {
  const auto same = [&](const Triangle& s, const Triangle& t) {
    return a.positions[s[0]] == b.positions[t[0]] && a.positions[s[1]] == b.positions[t[1]] &&
           a.positions[s[2]] == b.positions[t[2]];
  };
  return std::equal(a.triangles.begin(), a.triangles.end(), b.triangles.begin(), b.triangles.end(), same);
}

/// Names, widths, values and indices; the type of a number in its file may differ.
inline bool same_attributes(const MeshAttributes& a, const MeshAttributes& b) {
  const auto same = [](const Attribute& s, const Attribute& t) {
    return s.name == t.name && s.width == t.width && same_numbers(s.values, t.values);
  };
  const auto same_lower = [&](const LowerElements& s, const LowerElements& t) {
    return s.vertices == t.vertices &&
           std::equal(s.values.begin(), s.values.end(), t.values.begin(), t.values.end(), same);
  };
  const auto same_corner = [](const CornerAttribute& s, const CornerAttribute& t) {
    return s.name == t.name && s.width == t.width && same_numbers(s.values, t.values) &&
           s.indices == t.indices;
  };
  const auto label_of = [](const FaceLabels& labels, std::size_t face) {
    const std::uint32_t label = labels.face_label[face];
    return label == 0xffffffffU ? std::string() : ":" + labels.labels[label];
  };
  const auto same_labels = [&](const FaceLabels& s, const FaceLabels& t) {
    bool same_text = s.keyword == t.keyword && s.face_label.size() == t.face_label.size();
    for (std::size_t face = 0; same_text && face < s.face_label.size(); ++face) {
      same_text = label_of(s, face) == label_of(t, face);
    }
    return same_text;
  };
  return std::equal(a.vertex.begin(), a.vertex.end(), b.vertex.begin(), b.vertex.end(), same) &&
         std::equal(a.face.begin(), a.face.end(), b.face.begin(), b.face.end(), same) &&
         std::equal(a.corner.begin(), a.corner.end(), b.corner.begin(), b.corner.end(), same_corner) &&
         std::equal(a.face_labels.begin(), a.face_labels.end(), b.face_labels.begin(), b.face_labels.end(),
                    same_labels) &&
         same_lower(a.points, b.points) && same_lower(a.lines, b.lines) && a.comments == b.comments &&
         a.header_lines == b.header_lines;
}

}  // namespace isorelax
