in vec4 surface;
layout(location = 0) out vec4 sea;  // inverse depth, slope x, slope y, foam of crests that break or broke

// A crest breaks where the envelope of the folding is high. Its foam stays behind it and fades: the phase of the folding
// tells how long ago the crest passed (foam_of of short_waves.cpp).
float crest_foam(vec2 fold) {
  float size = length(fold);
  float breaking = clamp((size / patch_blend.w - level.w) / 0.6, 0.0, 1.0) * smoothstep(0.08, 0.16, size);
  if (breaking <= 0.0) return 0.0;
  fold = vec2(0.825 * fold.x + 0.565 * fold.y, 0.825 * fold.y - 0.565 * fold.x);  // 0.6 rad ahead: there a breaker has its front
  // 0 to 4 over a turn, nearly the angle times 2 / pi, without its cost
  float quarter = 1.0 - fold.x / (abs(fold.x) + abs(fold.y));
  float behind = fold.y < 0.0 ? quarter : 4.0 - quarter;
  float left = 1.0 - clamp((behind - 0.4) / 2.6, 0.0, 1.0);
  return breaking * smoothstep(0.0, 0.35, behind) * left * left;
}

void main() { sea = vec4(gl_FragCoord.w, surface.xy, crest_foam(surface.zw)); }
