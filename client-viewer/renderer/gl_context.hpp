#pragma once

#include <memory>
#include <string>

namespace pelagos {

/// An OpenGL 4.5 core context without a window, current on the thread that made it.
/// EGL devices are tried first, hardware before software, then Mesa's surfaceless platform; so a machine with a
/// graphics card uses it and one without draws with Mesa's software renderer.
class HeadlessContext {
 public:
  /// @throws GraphicsError that says what is missing
  HeadlessContext();
  ~HeadlessContext();
  HeadlessContext(const HeadlessContext&) = delete;
  HeadlessContext& operator=(const HeadlessContext&) = delete;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// GL_RENDERER of the current context.
[[nodiscard]] std::string renderer_name();

}  // namespace pelagos
