// The open sea of the shaders against that of common/waves.

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "graphics_fixture.hpp"
#include "renderer/view_block.hpp"
#include "source/frame_source.hpp"
#include "waves/patch_blend.hpp"
#include "waves/sea_state.hpp"
#include "waves/splitmix.hpp"
#include "waves/wave_field.hpp"

namespace pelagos {
namespace {

constexpr std::size_t kPlaces = 1000;

/// Sums all components at each place, and blends the height with that of a patch whose water stands at 0.7 m.
constexpr const char* kMain = R"(
layout(local_size_x = 1) in;
layout(std430, binding = 4) readonly buffer Places { vec2 place[]; };
layout(std430, binding = 5) writeonly buffer Sums { vec4 sum[]; };
void main() {
  uint n = gl_GlobalInvocationID.x;
  WaveSum waves_here = WaveSum(vec3(0.0), vec2(0.0), vec3(0.0), vec2(0.0));
  for (int i = 0; i < wave_count; ++i) add_wave(i, place[n], 1.0, 1.0, waves_here);
  float share = patch_weight(place[n]);
  sum[3u * n] = vec4(waves_here.shift, share);
  sum[3u * n + 1u] = vec4(waves_here.slope, waves_here.jacobian.xy);
  sum[3u * n + 2u] = vec4(mix(waves_here.shift.z, 0.7, share));
})";

GLuint compute_program() {
  const std::string source =
      "#version 450 core\n" + std::string(shader_text("common.glsl")) + std::string(shader_text("waves.glsl")) + kMain;
  const char* text = source.c_str();
  const GLuint shader = glCreateShader(GL_COMPUTE_SHADER), program = glCreateProgram();
  glShaderSource(shader, 1, &text, nullptr);
  glCompileShader(shader);
  glAttachShader(program, shader);
  glLinkProgram(program);
  char log[2048] = {};
  glGetProgramInfoLog(program, sizeof log, nullptr, log);
  EXPECT_STREQ(log, "");
  return program;
}

/// A sea of some depth; or, in the middle of two blends.
struct DrawnSea {
  double depth = kInfiniteDepth;
  bool blends = false;
};

WaveField sea_of(const DrawnSea& drawn) {
  WaveField sea(make_wave_components({.beaufort = 8, .wave_to_deg = 40, .components = 128, .seed = 4}), 0.0,
                drawn.depth);
  if (!drawn.blends) return sea;
  EXPECT_TRUE(sea.exchange(make_wave_components({.beaufort = 5, .wave_to_deg = 200, .seed = 5}), 3560.0, 60.0));
  EXPECT_TRUE(sea.exchange(make_wave_components({.beaufort = 7, .wave_to_deg = 90, .seed = 6}), 3590.0, 25.0));
  return sea;
}

class SeaDrawn : public Graphics, public testing::WithParamInterface<DrawnSea> {};

TEST_P(SeaDrawn, IsTheWaveFieldAtAThousandPlaces) {
  if (IsSkipped()) return;
  const WaveMoment moment = sea_of(GetParam()).at(3599.0, {12'000.0, -900.0});
  std::vector<float> x, y, places;
  SplitMix64 random(1);
  for (std::size_t i = 0; i < kPlaces; ++i) {
    const double reach = std::pow(10.0, 3.0 * random.next_unit()), way = 6.2831853 * random.next_unit();  // to 1 km
    x.push_back(static_cast<float>(reach * std::cos(way)));
    y.push_back(static_cast<float>(reach * std::sin(way)));
    places.insert(places.end(), {x.back(), y.back()});
  }
  const PatchBlend blend = rim_blend(1.0, 60.0);
  ViewBlock view{};
  view.patch_box = {-50.0F, -20.0F, 30.0F, 40.0F};
  view.patch_blend = {1.0F, static_cast<float>(blend.start), static_cast<float>(blend.full), 1.0F};

  const GLuint program = compute_program();
  Buffer view_buffer, wave_buffer, place_buffer, sum_buffer;
  std::vector<float> sums(12 * kPlaces);
  view_buffer.upload(&view, sizeof view);
  wave_buffer.upload(moment.waves.data(), moment.waves.size() * sizeof(MomentWave));
  place_buffer.upload(places.data(), places.size() * sizeof(float));
  sum_buffer.upload(sums.data(), sums.size() * sizeof(float));
  glUseProgram(program);
  glProgramUniform1i(program, glGetUniformLocation(program, "wave_count"), static_cast<int>(moment.waves.size()));
  glBindBufferBase(GL_UNIFORM_BUFFER, 0, view_buffer.id());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 3, wave_buffer.id());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 4, place_buffer.id());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 5, sum_buffer.id());
  glDispatchCompute(kPlaces, 1, 1);
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  glGetNamedBufferSubData(sum_buffer.id(), 0, static_cast<GLsizeiptr>(sums.size() * sizeof(float)), sums.data());
  check_graphics("the sums");
  glDeleteProgram(program);

  const std::vector<float> top(kPlaces, 0.0F);
  std::vector<float> shift[3], surface[4];
  for (auto& values : shift) values.resize(kPlaces);
  for (auto& values : surface) values.resize(kPlaces);
  evaluate_displacement(moment, x, y, top, shift[0], shift[1], shift[2]);
  evaluate_surface(moment, x, y, {surface[0], surface[1], surface[2], surface[3]});
  double worst_way = 0.0, worst_slope = 0.0, worst_share = 0.0, worst_height = 0.0;
  std::size_t mixed = 0;
  for (std::size_t i = 0; i < kPlaces; ++i) {
    const float* drawn = &sums[12 * i];
    for (std::size_t axis = 0; axis < 3; ++axis)
      worst_way = std::max(worst_way, std::abs(static_cast<double>(drawn[axis] - shift[axis][i])));
    worst_slope = std::max({worst_slope, std::abs(static_cast<double>(drawn[4] - surface[1][i])),
                            std::abs(static_cast<double>(drawn[5] - surface[2][i]))});
    const double share = patch_weight(blend, {-50.0, -20.0}, {30.0, 40.0}, {x[i], y[i]});
    worst_share = std::max(worst_share, std::abs(static_cast<double>(drawn[3]) - share));
    mixed += share > 0.0 && share < 1.0;
    const double height = (1.0 - share) * static_cast<double>(shift[2][i]) + share * 0.7;
    worst_height = std::max(worst_height, std::abs(static_cast<double>(drawn[8]) - height));
  }
  RecordProperty("worst_way_mm", std::to_string(1e3 * worst_way));
  RecordProperty("worst_height_mm", std::to_string(1e3 * worst_height));
  EXPECT_LT(worst_way, 1e-3);     // m; single precision of the phase at 1 km
  EXPECT_LT(worst_height, 1e-3);  // m
  EXPECT_LT(worst_slope, 1e-3);
  EXPECT_LT(worst_share, 1e-5);
  EXPECT_GT(mixed, 50U);
}

INSTANTIATE_TEST_SUITE_P(Seas, SeaDrawn,
                         testing::Values(DrawnSea{9.0}, DrawnSea{}, DrawnSea{9.0, true},
                                         DrawnSea{kInfiniteDepth, true}));

/// Depths of a picture of the open sea alone.
std::vector<float> draw_sea(const WaveField& sea) {
  constexpr int kWidth = 160, kHeight = 96;
  Renderer renderer({kWidth, kHeight, 16, Quality::kHigh, true});
  SceneInfo scene = synthetic_scene();
  scene.sea = sea;
  scene.bodies.clear();
  renderer.set_scene(scene);
  Channel channel;
  channel.mount.eye = {300.0, 0.0, 8.0};
  channel.mount.tilt_deg = -8.0;
  SeaMoment moment;
  moment.time = 12.0;
  renderer.draw(camera_for(channel, {}, kWidth, kHeight).value(), moment);
  return renderer.read_depth();
}

TEST_F(Graphics, EveryComponentOfALongListIsDrawn) {
  constexpr std::size_t kMany = 600;
  const WaveComponent whole{.amplitude = 0.6F, .wavenumber = 0.1F, .omega = 0.99F, .direction = 0.5F, .phase = 0.2F};
  WaveComponent part = whole;
  part.amplitude /= static_cast<float>(kMany);
  const std::vector<float> one = draw_sea(WaveField({whole}, 0.0)), flat = draw_sea({});
  const std::vector<float> many = draw_sea(WaveField(std::vector<WaveComponent>(kMany, part), 0.0));
  double differ = 0.0, move = 0.0;
  std::size_t seen = 0;
  for (std::size_t i = 0; i < one.size(); ++i) {
    if (one[i] <= 0.0F || one[i] > 60.0F || many[i] <= 0.0F) continue;
    differ += std::abs(static_cast<double>(many[i] - one[i]));
    move += std::abs(static_cast<double>(flat[i] - one[i]));
    ++seen;
  }
  ASSERT_GT(seen, 1000U);
  // One wave raises the mean level by k a^2 / 2 = 18 mm, its parts by nothing: some decimetres along a flat ray.
  EXPECT_LT(differ, 0.1 * move);
}

/// The scene's layers reach the picture: half of a blend is drawn as both seas with half their heights.
TEST_F(Graphics, ABlendIsDrawnAsTheSumOfItsSeas) {
  WaveComponent old{.amplitude = 0.8F, .wavenumber = 0.1F, .omega = 0.99F, .direction = 0.5F, .phase = 0.2F};
  WaveComponent next{.amplitude = 0.6F, .wavenumber = 0.2F, .omega = 1.4F, .direction = 2.5F, .phase = 1.2F};
  WaveField blending({old}, 0.0);
  ASSERT_TRUE(blending.exchange({next}, 2.0, 20.0));  // half over at 12 s, the time that is drawn
  const std::vector<float> before = draw_sea(WaveField({old}, 0.0)), drawn = draw_sea(blending);
  old.amplitude *= 0.5F;
  next.amplitude *= 0.5F;
  EXPECT_EQ(drawn, draw_sea(WaveField({next, old}, 0.0))) << "newest first, as the field sums them";
  EXPECT_NE(drawn, before);
}

}  // namespace
}  // namespace pelagos
