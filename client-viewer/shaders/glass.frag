// A pane: a little green of its own, and the sky in it, the more the flatter it is seen.
layout(binding = 0) uniform sampler2D scene_inverse;
#include "air.glsl"
in vec3 world;
flat in vec3 normal;
layout(location = 0) out vec4 picture;
void main() {
  if (texelFetch(scene_inverse, ivec2(gl_FragCoord.xy), 0).r > gl_FragCoord.w) discard;
  vec3 v = -normalize(world);
  float facing = abs(dot(v, normal));
  vec3 mirrored = sky_colour(normalize(reflect(-v, normal) + vec3(0.0, 0.0, 0.05)), 3.0);
  float mirrors = 0.04 + 0.6 * pow(1.0 - facing, 5.0);
  vec3 own = vec3(0.30, 0.42, 0.40) * sunlight.w;
  float alpha = mirrors + 0.05;
  picture = vec4(tone_map(mix(own, mirrored, mirrors / alpha)), alpha);
}
