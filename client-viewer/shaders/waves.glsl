// The sum of the wave field's components: evaluate_surface and evaluate_displacement of common/waves, for the mean
// level. The buffer holds WaveMoment::waves; places are metres from its anchor.
struct MomentWave {
  vec4 size;    // amplitude (m), its rate (m/s), unit vector along which the crests run
  vec4 turns;   // wave number over 2 pi times that vector (1/m), phase at the anchor (turns), wave number (rad/m)
  vec4 number;  // omega (rad/s), e^(-2kh), 1 / (1 - e^(-2kh)), unused
};
layout(std430, binding = 3) readonly buffer Waves { MomentWave waves[]; };
uniform int wave_count;

struct WaveSum {
  vec3 shift;     // m, of the surface particle whose place at rest is asked for
  vec2 slope;     // d elevation / dx, / dy there
  vec3 jacobian;  // xx, xy, yy of the horizontal shift's gradient
  vec2 fold;      // sum of a k cos(theta), sin(theta): how much crests fold the surface, and how far behind them a place is
};

/// Adds component i with its amplitude times `part`, to `fold` times `fold_part`.
void add_wave(int i, vec2 p, float part, float fold_part, inout WaveSum sum) {
  MomentWave wave = waves[i];
  float turns = wave.turns.z + dot(wave.turns.xy, p);
  float theta = 6.28318531 * (turns - round(turns));
  float s = sin(theta), c = cos(theta), a = part * wave.size.x, k = wave.turns.w;
  vec2 d = wave.size.zw;
  float even = (1.0 + wave.number.y) * wave.number.z;  // cosh kh / sinh kh
  sum.shift += vec3(-a * even * s * d, a * c + 0.5 * k * a * a * even);
  sum.slope -= a * k * s * d;
  sum.jacobian -= a * even * k * c * vec3(d.x * d.x, d.x * d.y, d.y * d.y);
  sum.fold += fold_part * wave.size.x * even * k * vec2(c, s);
}
