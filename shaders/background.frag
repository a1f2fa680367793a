#version 330 core

in float height;

uniform vec3 top;
uniform vec3 bottom;

out vec4 fragment;

void main() {
  fragment = vec4(mix(bottom, top, height), 1.0);
}
