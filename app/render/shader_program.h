#pragma once

#include <glad/gl.h>

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <string>
#include <string_view>

#include "render/color.h"

namespace isorelax::render {

/// Text of a shader and the name it has in messages.
struct ShaderSource {
  std::string name;
  std::string text;
};

/// A vertex and a fragment shader, linked. Uniforms that the program does not use are passed over.
class ShaderProgram {
 public:
  /// Throws Error with the shader's name and the compiler's first line.
  ShaderProgram(const ShaderSource& vertex, const ShaderSource& fragment);
  ShaderProgram(ShaderProgram&& other) noexcept;
  ShaderProgram& operator=(ShaderProgram&& other) noexcept;
  ShaderProgram(const ShaderProgram&) = delete;
  ShaderProgram& operator=(const ShaderProgram&) = delete;
  ~ShaderProgram();

  void use() const;
  /// All of these need the program in use.
  void set(const char* uniform, int value) const;
  void set(const char* uniform, unsigned value) const;
  void set(const char* uniform, float value) const;
  void set(const char* uniform, Color value) const;
  void set(const char* uniform, const glm::vec2& value) const;
  void set(const char* uniform, const glm::vec4& value) const;
  void set(const char* uniform, const glm::ivec2& value) const;
  void set(const char* uniform, const glm::mat3& value) const;
  void set(const char* uniform, const glm::mat4& value) const;

 private:
  [[nodiscard]] GLint location(const char* uniform) const;

  GLuint name_ = 0;
};

}  // namespace isorelax::render
