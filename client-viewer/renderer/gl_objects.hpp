#pragma once

#include <epoxy/gl.h>

#include <array>
#include <initializer_list>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace pelagos {

/// Anything that goes wrong between the viewer and OpenGL; the text says what and, where known, what to do.
class GraphicsError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Text of an embedded shader file, empty if there is none of that name.
[[nodiscard]] std::string_view shader_text(std::string_view name);

/// What is compiled for a shader file: the version line, the macros of `defined`, common.glsl, and the file
/// with those that it includes.
/// @throws GraphicsError if there is no such file
[[nodiscard]] std::string shader_source(std::string_view file, std::string_view defined = {});

/// A linked program from files of `shaders/`; see shader_source.
class Program {
 public:
  /// @param defined  macros that both stages see, with blanks between them, for a variant of the program
  /// @throws GraphicsError with the compiler's log
  Program(std::string_view vertex_file, std::string_view fragment_file, std::string_view defined = {});
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  void use() const { glUseProgram(id_); }
  void set(const char* name, int value) const;
  void set(const char* name, float value) const;
  void set(const char* name, float x, float y) const;
  void set_matrix3(const char* name, const float* columns) const;
  void set_vector3(const char* name, const float* values) const;
  void set_vector4(const char* name, const float* values) const;

 private:
  GLuint id_ = 0;
};

/// A 2D texture. Immutable storage; `levels` 0 means the whole mip chain, which is also the most.
class Texture {
 public:
  Texture(int width, int height, GLenum format, GLenum filter, GLenum wrap, int levels = 1);
  ~Texture();
  Texture(const Texture&) = delete;
  Texture& operator=(const Texture&) = delete;

  [[nodiscard]] GLuint id() const { return id_; }
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  void bind(GLuint unit) const { glBindTextureUnit(unit, id_); }

 private:
  GLuint id_ = 0;
  int width_, height_;
};

/// Colour attachments (borrowed) and, if asked for, an own depth buffer.
class Framebuffer {
 public:
  explicit Framebuffer(std::initializer_list<const Texture*> colour, bool depth = false);
  /// With the depth buffer of another one of the same size, which must outlive it.
  Framebuffer(std::initializer_list<const Texture*> colour, const Framebuffer& depth_of);
  ~Framebuffer();
  Framebuffer(const Framebuffer&) = delete;
  Framebuffer& operator=(const Framebuffer&) = delete;

  /// Bind for drawing and set the viewport to the whole of it.
  void bind() const;
  /// The same for solids: all colours are `background`, depth (reversed) hides what lies behind, nothing is blended.
  void begin_solids(const std::array<float, 4>& background = {}) const;
  [[nodiscard]] GLuint id() const { return id_; }

 private:
  void check() const;

  GLuint id_ = 0, depth_ = 0;  // depth_: its own, else 0
  GLint colours_;
  int width_, height_;
};

/// Colours and depth with several samples a pixel, to be resolved into a framebuffer's textures.
class MultisampleTarget {
 public:
  /// @param samples  1 or more; drivers may take more
  MultisampleTarget(int width, int height, std::initializer_list<GLenum> formats, int samples);
  ~MultisampleTarget();
  MultisampleTarget(const MultisampleTarget&) = delete;
  MultisampleTarget& operator=(const MultisampleTarget&) = delete;

  /// As Framebuffer::begin_solids(), over nothing.
  void begin_solids() const;
  /// The mean of each pixel's samples, colour by colour. `target` draws into its last colour alone afterwards.
  void resolve_into(const Framebuffer& target) const;

 private:
  GLuint id_ = 0, depth_ = 0;
  std::vector<GLuint> colours_;
  int width_, height_;
};

/// A buffer that grows with what is put into it.
class Buffer {
 public:
  Buffer();
  ~Buffer();
  Buffer(const Buffer&) = delete;
  Buffer& operator=(const Buffer&) = delete;

  void upload(const void* data, std::size_t bytes, GLenum usage = GL_DYNAMIC_DRAW);
  [[nodiscard]] GLuint id() const { return id_; }

 private:
  GLuint id_ = 0;
  std::size_t capacity_ = 0;
};

/// A vertex array without attributes, for shaders that read buffers by gl_VertexID.
class VertexArray {
 public:
  VertexArray() { glCreateVertexArrays(1, &id_); }
  ~VertexArray() { glDeleteVertexArrays(1, &id_); }
  VertexArray(const VertexArray&) = delete;
  VertexArray& operator=(const VertexArray&) = delete;
  void bind() const { glBindVertexArray(id_); }
  [[nodiscard]] GLuint id() const { return id_; }

 private:
  GLuint id_ = 0;
};

/// Values of a texture as floats, row by row from the bottom; `channels` per texel.
[[nodiscard]] std::vector<float> read_texture(const Texture& texture, int channels);

/// Throws if OpenGL has recorded an error since the last call; `where` names the work done since.
void check_graphics(const char* where);

}  // namespace pelagos
