// Sun, sky from above and light thrown back by the water; wet below and just above the water's level.
#include "shadow.glsl"
layout(binding = 12) uniform sampler2D shadow_map;
in vec3 world;
in vec3 world_normal;
in vec3 albedo;
uniform float mirror;
layout(location = 0) out vec4 colour;
layout(location = 1) out float inverse_depth;
void main() {
  float height = world.z - level.x;
  if (mirror > 0.5 && height < -0.05) discard;
  vec3 n = normalize(world_normal);
  if (dot(n, world) > 0.0 && mirror < 0.5) n = -n;  // thin plates are seen from both sides
  // away from the surface, so that it does not shade itself
  float facing = max(dot(n, sun.xyz), 0.0) * sun_at(shadow_map, world + 0.12 * n);
  vec3 sky_light = mix(vec3(0.10, 0.15, 0.18), vec3(0.36, 0.44, 0.54), 0.5 + 0.5 * n.z);
  // a hint of occlusion low on the sides
  vec3 light = sun.w * vec3(1.0, 0.94, 0.84) * sunlight.rgb * facing + sunlight.w * sky_light;
  float wet = 1.0 - 0.45 * smoothstep(0.9, 0.1, height);
  vec3 v = -normalize(world);
  float shine = step(1e-4, facing) * pow(max(dot(reflect(-sun.xyz, n), v), 0.0), 24.0);
  colour = vec4(albedo * wet * light + vec3(0.05 + 0.25 * (1.0 - wet)) * shine * sun.w, 1.0);
  inverse_depth = gl_FragCoord.w;
}
