in vec2 corner;
flat in float strength;
flat in float inverse_depth;
flat in vec3 grain;
flat in float lod;
flat in float softness;
layout(binding = 0) uniform sampler2D scene_inverse;
layout(binding = 7) uniform sampler2D foam_pattern;
layout(location = 0) out vec4 picture;
void main() {
  float r = dot(corner, corner);
  if (r > 1.0) discard;
  float behind = texelFetch(scene_inverse, ivec2(gl_FragCoord.xy), 0).r;
  float gap = behind > 0.0 ? 1.0 / behind - 1.0 / inverse_depth : 1e3;
  float soft = clamp(0.5 + gap / softness, 0.0, 1.0);
  float pattern = 1.0 - textureLod(foam_pattern, 0.16 * corner + grain.xy, lod).r;  // the holes between strands are round
  float inside = 1.0 - r;
  float mist = 0.13 * inside * inside * (0.4 + 0.8 * pattern);
  // Where the pattern is high there are drops, fewer towards the edge of the cluster.
  float drops = 0.85 * smoothstep(0.0, 0.12, inside) * smoothstep(0.55, 0.80, pattern - 0.45 * r + 0.1);
  drops = mix(drops, 0.31 * inside * inside, smoothstep(0.7, 2.2, lod));  // too far away to tell drops
  float alpha = strength * soft * mix(mist, drops, grain.z);
  // white water: the sky's light, and the sun's through it
  picture = vec4((vec3(0.80, 0.84, 0.87) + 0.06 * sun.w * sunlight.rgb * grain.z) * (0.25 + 0.75 * sunlight.w) * sqrt(sunlight.w), alpha);
}
