#version 330 core
// A triangle mesh by vertex pulling: no vertex attributes, vertex number 3 t + k is corner k of triangle t.

uniform samplerBuffer positions;   // per vertex, in the mesh's own frame
uniform usamplerBuffer triangles;  // per triangle: three vertices, marked edges
uniform samplerBuffer normals;     // per vertex, only read for smooth shading
uniform samplerBuffer colors;      // per triangle: sRGB; alpha 0 where highlighted
uniform mat4 view_projection;      // from the mesh's frame to clip space
uniform mat3 view_rotation;        // to the picture's axes
uniform bool smooth_shading;

out vec3 normal;
out vec3 barycentric;
flat out vec4 color;
flat out uint marks;

void main() {
  int triangle = gl_VertexID / 3;
  int corner = gl_VertexID - 3 * triangle;
  uvec4 t = texelFetch(triangles, triangle);
  int vertex = int(t[corner]);
  vec3 p = texelFetch(positions, vertex).xyz;
  if (smooth_shading) {
    normal = view_rotation * texelFetch(normals, vertex).xyz;
  } else {
    vec3 a = texelFetch(positions, int(t.x)).xyz;
    vec3 b = texelFetch(positions, int(t.y)).xyz;
    vec3 c = texelFetch(positions, int(t.z)).xyz;
    vec3 u = b - a;
    vec3 v = c - a;
    // Unit lengths first: the product of two tiny edges must not vanish.
    u /= max(max(abs(u.x), max(abs(u.y), abs(u.z))), 1e-30);
    v /= max(max(abs(v.x), max(abs(v.y), abs(v.z))), 1e-30);
    normal = view_rotation * cross(u, v);
  }
  barycentric = vec3(corner == 0, corner == 1, corner == 2);
  color = texelFetch(colors, triangle);
  marks = t.w;
  gl_Position = view_projection * vec4(p, 1.0);
}
