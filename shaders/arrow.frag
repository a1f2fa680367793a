#version 330 core

uniform vec3 color;

out vec4 fragment;

void main() {
  fragment = vec4(color, 1.0);
}
