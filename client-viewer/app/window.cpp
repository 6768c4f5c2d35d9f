#include <epoxy/gl.h>
// epoxy comes before GLFW, which would bring its own OpenGL header
#include <GLFW/glfw3.h>

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>
#include <algorithm>
#include <chrono>
#include <thread>

#include "app/clock_notes.hpp"
#include "app/presentation.hpp"
#include "app/run.hpp"
#include "renderer/gl_objects.hpp"
#include "source/awaited.hpp"

namespace pelagos {
namespace {

/// GLFW, its window and the overlay, in the order in which they must come and go.
class Window {
 public:
  Window(int width, int height, const std::string& title) {
    if (glfwInit() != GLFW_TRUE)
      throw GraphicsError("no display for a window; use --headless on a machine without one");
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    window_ = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
    if (window_ == nullptr) {
      glfwTerminate();
      throw GraphicsError("no window with OpenGL 4.5 core; the graphics driver may be too old, or use --headless");
    }
    glfwMakeContextCurrent(window_);
    glfwSwapInterval(1);
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;
    ImGui_ImplGlfw_InitForOpenGL(window_, true);
    ImGui_ImplOpenGL3_Init("#version 450 core");
  }
  ~Window() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
    glfwDestroyWindow(window_);
    glfwTerminate();
  }
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  [[nodiscard]] GLFWwindow* get() const { return window_; }

 private:
  GLFWwindow* window_ = nullptr;
};

void show_instant(const Presentation& view, const ClockState& clock) {
  ImGui::Text("%.0f ms behind the schedule   skew %.1f ms, 99 %%: %.1f ms", 1e3 * view.delay(),
              1e3 * view.skew().recent(0.5), 1e3 * view.skew().recent(0.99));
  if (clock.clock == ViewerClock::kMeasured)
    ImGui::Text("clock measured: %.6f s, within %.2f ms", 1e-9 * static_cast<double>(clock.offset_ns),
                1e3 * clock.error);
  if (clock.clock == ViewerClock::kHost) ImGui::Text("clock of the host, trusted");
  if (clock.clock == ViewerClock::kArrival) ImGui::Text("clock: by the arrival of frames");
}

void show_overlay(const Presentation& view, FrameSource& source, std::uint32_t domain, double frames_per_second) {
  ImGui::SetNextWindowPos(ImVec2(10, 10));
  ImGui::SetNextWindowBgAlpha(0.45F);
  ImGui::Begin("state", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoInputs);
  ImGui::Text("%s   %.0f fps", view.channel().name.c_str(), frames_per_second);
  const ImVec4 warning(1.0F, 0.45F, 0.3F, 1.0F);
  if (!source.server_alive())
    ImGui::TextColored(warning, "%s", view.ready() ? "no server: the last frame stays" : "no server");
  if (!view.ready()) ImGui::Text("waiting for %s", awaited(source, domain).c_str());
  if (const OceanFrame* frame = view.frame()) {
    ImGui::Text("%s   t = %.1f s   frame %llu", view.scene().scene.c_str(), view.time(),
                static_cast<unsigned long long>(frame->frame));
    ImGui::Text("%zu of %u particles   %llu frames missed", frame->particles.size(), frame->total_particles,
                static_cast<unsigned long long>(source.counters().missed));
  }
  if (const auto status = source.status()) {
    if (status->paused && source.server_alive()) ImGui::TextColored(warning, "paused");
    ImGui::Text("real-time factor %.2f   step %.1f ms", status->real_time_factor, status->step_ms);
  }
  show_instant(view, source.clock_state());
  if (const auto wind = source.wind())
    ImGui::Text("wind %.1f m/s from %.0f deg", wind->velocity.head<2>().norm(), wind_from_deg(wind->velocity));
  ImGui::End();
}

void draw_overlay(const Presentation& view, FrameSource& source, std::uint32_t domain, double frames_per_second) {
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  ImGui::NewFrame();
  show_overlay(view, source, domain, frames_per_second);
  ImGui::Render();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

void draw_window(Presentation& view, int width, int height, std::int64_t moment_ns) {
  view.resize(width, height);
  view.update();
  if (view.ready()) view.draw(moment_ns);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glViewport(0, 0, width, height);
  glClearColor(0.1F, 0.13F, 0.16F, 1.0F);
  glClear(GL_COLOR_BUFFER_BIT);
  if (view.ready())
    glBlitNamedFramebuffer(view.renderer().picture_framebuffer(), 0, 0, 0, width, height, 0, 0, width, height,
                           GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

}  // namespace

int run_window(const Options& options, const Channel& channel, FrameSource& source, const std::atomic<bool>& stop) {
  const Window window(options.width, options.height, "Pelagos - " + channel.name);
  Presentation view(source, channel,
                    {options.width, options.height, channel.guard_px, options.quality, false, options.weather},
                    options.assets / "meshes", options.delay);
  ClockNotes clock_notes(source);
  SwapForecast forecast;
  bool overlay = true, key_was_down = false;
  double frames_per_second = 0.0;
  auto last = std::chrono::steady_clock::now();
  while (!stop && glfwWindowShouldClose(window.get()) == GLFW_FALSE) {
    glfwPollEvents();
    int width = 0, height = 0;
    glfwGetFramebufferSize(window.get(), &width, &height);
    if (width < 64 || height < 36) {  // minimised
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
      continue;
    }
    const bool key_down = glfwGetKey(window.get(), GLFW_KEY_F1) == GLFW_PRESS;
    if (key_down && !key_was_down) overlay = !overlay;
    key_was_down = key_down;
    const std::int64_t begun = source.now_ns();
    draw_window(view, width, height, begun + static_cast<std::int64_t>(1e9 * forecast.seconds(0.5)));
    if (overlay) draw_overlay(view, source, options.domain, frames_per_second);
    glfwSwapBuffers(window.get());
    glFinish();  // the swap is done
    const std::int64_t shown = source.now_ns();
    forecast.add(1e-9 * static_cast<double>(shown - begun));
    if (view.ready()) view.shown(shown);
    if (view.ready()) clock_notes.look(view);
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - last).count();
    last = now;
    frames_per_second += 0.1 * (1.0 / std::max(seconds, 1e-4) - frames_per_second);
  }
  return 0;
}

}  // namespace pelagos
