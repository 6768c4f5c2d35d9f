// Edge smoothing by the contrast of luma (kept in alpha): blends along the edge where the contrast is high.
in vec2 ndc;
layout(binding = 0) uniform sampler2D picture;
layout(location = 0) out vec4 smoothed;
void main() {
  vec2 uv = 0.5 * ndc + 0.5, px = size.zw;
  vec4 m = textureLod(picture, uv, 0.0);
  float nw = textureLod(picture, uv + px * vec2(-0.5, 0.5), 0.0).a, ne = textureLod(picture, uv + px * vec2(0.5, 0.5), 0.0).a;
  float sw = textureLod(picture, uv + px * vec2(-0.5, -0.5), 0.0).a, se = textureLod(picture, uv + px * vec2(0.5, -0.5), 0.0).a;
  float low = min(m.a, min(min(nw, ne), min(sw, se))), high = max(m.a, max(max(nw, ne), max(sw, se)));
  smoothed = vec4(m.rgb, 1.0);
  if (high - low < max(0.05, 0.125 * high)) return;
  vec2 along = vec2(-((nw + ne) - (sw + se)), (nw + sw) - (ne + se));
  float small = max((nw + ne + sw + se) * 0.03125, 0.0078);
  along = clamp(along / (min(abs(along.x), abs(along.y)) + small), -6.0, 6.0) * px;
  vec3 inner = 0.5 * (textureLod(picture, uv - along / 6.0, 0.0).rgb + textureLod(picture, uv + along / 6.0, 0.0).rgb);
  vec4 outer_a = textureLod(picture, uv - 0.5 * along, 0.0), outer_b = textureLod(picture, uv + 0.5 * along, 0.0);
  vec3 wide = 0.5 * inner + 0.25 * (outer_a.rgb + outer_b.rgb);
  float luma = dot(wide, vec3(0.299, 0.587, 0.114));
  smoothed.rgb = luma < low || luma > high ? inner : wide;
}
