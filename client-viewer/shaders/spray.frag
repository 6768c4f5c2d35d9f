in vec2 corner;
flat in float strength;
flat in float inverse_depth;
flat in vec2 grain_at;
layout(binding = 0) uniform sampler2D scene_inverse;
layout(binding = 7) uniform sampler2D foam_pattern;
layout(location = 0) out vec4 picture;
void main() {
  float r = dot(corner, corner);
  if (r > 1.0) discard;
  float behind = texelFetch(scene_inverse, ivec2(gl_FragCoord.xy), 0).r;
  float gap = behind > 0.0 ? 1.0 / behind - 1.0 / inverse_depth : 1e3;
  float soft = clamp(0.5 + gap / fluid.y, 0.0, 1.0);
  float grain = textureLod(foam_pattern, 0.16 * corner + grain_at, 1.5).r;
  float alpha = 0.42 * strength * soft * (1.0 - r) * (1.0 - r) * (0.35 + 0.9 * grain);
  picture = vec4(0.86, 0.89, 0.91, alpha);
}
