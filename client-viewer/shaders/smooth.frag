// One direction of the narrow-range filter (Truong & Yuksel 2018) on inverse depth. Differences from the paper:
// it filters 1/z, which is linear on planes; depths are compared with the horizontal plane through the pixel, so that
// water seen at a grazing angle is not torn by its own slope; and the vertical kernel shrinks with the foreshortening.
// A nearer sample out of range drops the pair, a farther one is clamped.
in vec2 ndc;
layout(binding = 0) uniform sampler2D fluid_inverse_depth;
uniform vec2 axis;  // one pixel along the filter's direction
uniform float widest;
layout(location = 0) out float smoothed;
void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  float centre = texelFetch(fluid_inverse_depth, pixel, 0).r;
  smoothed = centre;
  if (centre <= 0.0) return;
  vec3 d = fluid_ray(ndc);
  bool vertical = axis.y > 0.5;
  float sigma = 1.6 * fluid.y * fluid.x * centre;
  if (vertical) sigma *= clamp(1.3 * abs(d.z) * inversesqrt(dot(d, d)), 0.2, 1.0);
  float radius = min(2.5 * sigma, widest);
  if (radius < 1.0) return;
  float samples = min(ceil(radius), 12.0);
  float stride = max(radius / samples, 1.0);
  // the ray's world z changes linearly along the axis
  float dz = vertical ? up.z * fluid_size.w * 2.0 / fluid_size.y : right.z * fluid_size.z * 2.0 / fluid_size.x;
  float range = 5.0 * fluid.y * centre, limit = 0.5 * fluid.y * centre;
  float sum = centre, weights = 1.0;
  for (float i = 1.0; i <= samples; i += 1.0) {
    float offset = floor(i * stride + 0.5);
    vec2 step_to = offset * axis;
    vec2 uv = gl_FragCoord.xy / fluid_size.xy;
    float plus = textureLod(fluid_inverse_depth, uv + step_to / fluid_size.xy, 0.0).r;
    float minus = textureLod(fluid_inverse_depth, uv - step_to / fluid_size.xy, 0.0).r;
    if (plus <= 0.0 || minus <= 0.0) continue;
    float tilt = d.z < -1e-3 ? clamp(dz * offset / d.z, -0.9, 0.9) : 0.0;
    float plane_plus = centre * (1.0 + tilt), plane_minus = centre * (1.0 - tilt);
    float off_plus = plus / plane_plus - 1.0, off_minus = minus / plane_minus - 1.0;  // > 0: nearer
    if (off_plus > range || off_minus > range) continue;
    plus = plane_plus * (1.0 + max(off_plus, off_plus < -range ? -limit : off_plus));
    minus = plane_minus * (1.0 + max(off_minus, off_minus < -range ? -limit : off_minus));
    float weight = exp(-0.5 * offset * offset / (sigma * sigma));
    sum += weight * (plus + minus);
    weights += 2.0 * weight;
  }
  smoothed = sum / weights;
}
