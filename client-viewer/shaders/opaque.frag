// Sun, the sky's light from where the surface looks, light thrown back by the water, and a coat of paint that mirrors the
// sky; wet below and just above the water's level.
#include "shadow.glsl"
layout(binding = 5) uniform sampler2D sky;
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
  float facing = max(dot(n, sun.xyz), 0.0) * sun_at(shadow_map, world + 0.22 * n);
  // The sky picture's most blurred levels stand for the light from half of the sky.
  vec3 from_above = textureLod(sky, sky_place(normalize(n + vec3(0.0, 0.0, 0.6))), 7.0).rgb;
  vec3 from_below = sunlight.w * vec3(0.10, 0.15, 0.18);
  vec3 sky_light = mix(from_below, 0.78 * from_above, smoothstep(-0.6, 0.9, n.z));
  // a hint of occlusion low on the sides
  vec3 light = sun.w * vec3(1.0, 0.94, 0.84) * sunlight.rgb * facing + sky_light;
  float wet = 1.0 - 0.45 * smoothstep(0.9, 0.1, height);
  vec3 v = -normalize(world);
  float shine = step(1e-4, facing) * pow(max(dot(reflect(-sun.xyz, n), v), 0.0), 24.0);
  vec3 r = reflect(-v, n);
  float mirrors = (0.012 + 0.16 * pow(1.0 - max(dot(n, v), 0.0), 5.0)) * smoothstep(-0.1, 0.2, r.z);
  vec3 gloss = mirrors * textureLod(sky, sky_place(r), 3.0).rgb;
  colour = vec4(albedo * wet * light + gloss + vec3(0.05 + 0.25 * (1.0 - wet)) * shine * sun.w * sunlight.rgb, 1.0);
  inverse_depth = gl_FragCoord.w;
}
