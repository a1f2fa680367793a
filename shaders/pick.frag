#version 330 core
// Which triangle of which mesh stands in front.

uniform uint mesh;

out uvec2 id;

void main() {
  id = uvec2(mesh + 1u, uint(gl_PrimitiveID));
}
