#version 330 core
// A triangle mesh by vertex pulling: no vertex attributes, vertex number 3 t + k is corner k of triangle t.

uniform samplerBuffer positions;   // per vertex, in the mesh's own frame
uniform usamplerBuffer triangles;  // per triangle: three vertices, marked edges
uniform samplerBuffer normals;     // per vertex, only read for smooth shading
uniform samplerBuffer colors;      // per triangle: sRGB; alpha 0 where highlighted
uniform mat4 view_projection;      // from the mesh's frame to clip space
uniform mat3 view_rotation;        // to the picture's axes
uniform bool smooth_shading;

out float facing;  // how much the surface looks at the light, -1 to 1; mesh.frag
out vec3 barycentric;
flat out vec4 color;
flat out uint marks;

vec3 unit(vec3 v) {
  // Not by the length alone: the square of a tiny length vanishes.
  float largest = max(abs(v.x), max(abs(v.y), abs(v.z)));
  return largest > 0.0 ? normalize(v / largest) : vec3(0.0);
}

void main() {
  int triangle = gl_VertexID / 3;
  int corner = gl_VertexID - 3 * triangle;
  uvec4 t = texelFetch(triangles, triangle);
  vec3 p = texelFetch(positions, int(t[corner])).xyz;
  vec3 normal;
  if (smooth_shading) {
    normal = texelFetch(normals, int(t[corner])).xyz;
  } else {
    vec3 a = texelFetch(positions, int(t.x)).xyz;
    normal = unit(cross(unit(texelFetch(positions, int(t.y)).xyz - a), unit(texelFetch(positions, int(t.z)).xyz - a)));
  }
  // A headlight, a little of it from the upper left: 0.58 for a face that looks straight at the eye.
  facing = dot(view_rotation * normal, vec3(-0.16, 0.26, 0.58));
  barycentric = vec3(corner == 0, corner == 1, corner == 2);
  color = texelFetch(colors, triangle);
  marks = t.w;
  gl_Position = view_projection * vec4(p, 1.0);
}
