// Joins ship, sea, patch and sky: which of them a pixel shows. Ship and sky get their colours here; where water is, its
// surface is kept for water.frag, and the depth lets only those pixels through. The patch joins the open sea by blending
// inverse depth and slopes over its rim.
in vec2 ndc;
layout(binding = 0) uniform sampler2D opaque_colour;
layout(binding = 1) uniform sampler2D opaque_inverse;
layout(binding = 2) uniform sampler2D far_sea;
layout(binding = 3) uniform sampler2D fluid_surface;
layout(location = 0) out vec4 picture;
layout(location = 1) out float scene_inverse;
layout(location = 2) out vec4 water_surface;  // inverse depth, slope x, slope y, foam without that of hulls
layout(location = 3) out vec4 water_traits;   // share of the patch, cover by oil particles, foam of particles

#include "air.glsl"

// The fluid at full resolution: bilinear where its four texels lie on one surface. At a silhouette the nearer or the
// farther part alone, whichever weighs more, so that edges do not show the texels.
vec4 fluid_at(vec2 uv) {
  vec4 four = textureGather(fluid_surface, uv, 0);  // lower left is w, lower right z, upper right y, upper left x
  float low = min(min(four.x, four.y), min(four.z, four.w)), high = max(max(four.x, four.y), max(four.z, four.w));
  if (high <= 0.0) return vec4(0.0);
  if (low > 0.75 * high) return textureLod(fluid_surface, uv, 0.0);
  vec2 f = fract(uv * fluid_size.xy - 0.5);
  vec4 weights = vec4((1.0 - f.x) * f.y, f.x * f.y, f.x * (1.0 - f.y), (1.0 - f.x) * (1.0 - f.y));
  vec4 near = step(vec4(0.75 * high), four);
  vec4 chosen = weights * (dot(weights, near) > 0.5 ? near : 1.0 - near);
  chosen /= dot(chosen, vec4(1.0));
  return vec4(dot(chosen, four), dot(chosen, textureGather(fluid_surface, uv, 1)),
              dot(chosen, textureGather(fluid_surface, uv, 2)), dot(chosen, textureGather(fluid_surface, uv, 3)));
}

void main() {
  vec2 uv = 0.5 * ndc + 0.5;
  vec3 d = ray_through(ndc);
  vec4 body = textureLod(opaque_colour, uv, 0.0);
  float cover = body.a;
  float solid = cover > 0.0 ? textureLod(opaque_inverse, uv, 0.0).r / cover : 0.0;
  vec4 open_sea = textureLod(far_sea, uv, 0.0);
  vec4 fluid_here = fluid_at(0.5 * ndc * vec2(right.w, up.w) / fluid_size.zw + 0.5);
  float weight = fluid_here.x > 0.0 ? patch_weight(d.xy / fluid_here.x) : 0.0;
  // Where one of the two surfaces lies much higher where the ray meets it, it is a crest that hides the other. A mean of
  // both would stand there as a wall.
  float apart = abs(d.z) * abs(1.0 / max(open_sea.x, 1e-6) - 1.0 / max(fluid_here.x, 1e-6));  // m, in height
  weight = mix(weight, step(0.5, weight), smoothstep(0.5, 1.2, apart));
  float water = mix(open_sea.x, fluid_here.x, weight);
  if (open_sea.x <= 0.0) water = weight > 0.5 ? fluid_here.x : 0.0;
  // A particle is about a spacing wide: water that seems to lie that thin on the dry parts of a hull is only its width.
  if (solid > 0.0 && water > solid && d.z / solid - level.x > 1.1 &&
      (1.0 / solid - 1.0 / water) * length(d) < 1.6 * fluid.y) water = 0.0;
  vec2 own = fluid_here.yz / (1.0 + 0.6 * length(fluid_here.yz));
  water_surface = vec4(water, open_sea.yz + weight * own, open_sea.w);
  water_traits = vec4(weight, weight * smoothstep(0.15, 0.55, -fluid_here.w), 0.75 * weight * max(fluid_here.w, 0.0), 0.0);
  scene_inverse = cover > 0.5 ? max(solid, water) : water;
  // Where a body covers but a part of the pixel, the water behind it is needed as well.
  gl_FragDepth = water > solid || (water > 0.0 && cover < 0.99) ? 0.0 : 1.0;
  vec3 colour = sky_colour(normalize(d), 0.0);
  colour = tone_map(mix(colour, haze_colour(d), exp(-abs(d.z) / length(d) * 30.0)));
  if (cover > 0.0) {
    float haze = 1.0 - exp(-length(d) / (solid * level.z));
    colour = mix(colour, tone_map(mix(body.rgb / cover, haze_colour(d), haze)), cover);
  }
  picture = vec4(colour, dot(colour, vec3(0.299, 0.587, 0.114)));
}
