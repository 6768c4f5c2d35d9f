#include "waves.glsl"
// The open sea: a polar grid about the eye, displaced by the wave components (first-order Lagrangian theory). A wave
// fades out where the grid is too coarse for it. Inside the patch only waves shorter than `carried_by_patch` (m) are
// drawn: the others are the simulation's own.
layout(std430, binding = 2) readonly buffer Rings { float ring_radius[]; };
uniform int rings;
uniform int first_sector;
uniform int sectors_around;
uniform float carried_by_patch;
out vec4 surface;  // slope x, y; folding by crests: see WaveSum
void main() {
  int ring = gl_VertexID % rings;
  int sector = first_sector + gl_VertexID / rings;
  float angle = 2.0 * kPi * float(sector % sectors_around) / float(sectors_around);
  float radius = ring_radius[ring];
  vec2 p = radius * vec2(cos(angle), sin(angle));
  float cell = grid_cell(radius);
  float open_water = 1.0 - patch_weight(p);
  WaveSum sum = WaveSum(vec3(0.0), vec2(0.0), vec3(0.0), vec2(0.0));
  for (int i = 0; i < wave_count; ++i) {
    float wavelength = 2.0 * kPi / waves[i].turns.w;
    float fade = smoothstep(5.0, 10.0, wavelength / cell);
    if (fade <= 0.0) break;  // so are all that follow: they are shorter
    add_wave(i, p, fade * (wavelength > carried_by_patch ? open_water : 1.0), fade, sum);
  }
  mat2 stretch = mat2(1.0 + sum.jacobian.x, sum.jacobian.y, sum.jacobian.y, 1.0 + sum.jacobian.z);
  float fold = determinant(stretch);
  vec2 slope = fold > 0.15 ? inverse(stretch) * sum.slope : sum.slope;
  surface = vec4(clamp(slope, -1.2, 1.2), sum.fold);
  gl_Position = project(vec3(p, level.x) + sum.shift);
}
