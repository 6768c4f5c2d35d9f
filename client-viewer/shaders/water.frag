// The macro WITH_SLICK is defined where there is a film of oil, WITH_WAKE where hulls move or foam lies on the foam map: a
// software renderer computes both sides of a branch.
// Colours the pixels of water that join.frag has found.
in vec2 ndc;
layout(binding = 0) uniform sampler2D opaque_colour;
layout(binding = 1) uniform sampler2D opaque_inverse;
layout(binding = 2) uniform sampler2D water_surface;
layout(binding = 3) uniform sampler2D water_traits;
layout(binding = 4) uniform sampler2D mirrored;
layout(binding = 7) uniform sampler2D foam_pattern;
layout(binding = 8) uniform sampler2D film_map;
layout(binding = 9) uniform sampler2D short_sea[3];
layout(binding = 12) uniform sampler2D shadow_map;
layout(location = 0) out vec4 picture;

#include "air.glsl"

// A place in axes along and across the streaks of foam, and slow changes from place to place, -0.5..0.5.
vec2 in_pattern(vec2 p) { return vec2(dot(p, pattern.xy), dot(p, vec2(-pattern.y, pattern.x))) + pattern.zw; }
vec2 slow_pattern(vec2 q, float footprint) {
  return textureLod(foam_pattern, q / vec2(180.0, 60.0) + 0.2, max(log2(footprint * 256.0 / 60.0), 3.5)).rg - 0.5;
}

struct Detail { vec2 slope; float variance; float foam; };
// Waves that the far sea's grid and the particles do not show: tiles of short waves, anchored in the world. What a pixel
// blurs counts as variance (Olano and Baker 2010). Stand-ins of wave components leave out what the grid shows itself.
Detail short_waves(vec2 p, float footprint, vec2 drift) {
  float cell = grid_cell(length(p));
  // Gusts ruffle some places more than others, which also hides that the tiles repeat.
  float gust = 1.0 + 0.9 * drift.x + 0.5 * drift.y;
  Detail detail = Detail(vec2(0.0), sea_grid.w, 0.0);
  for (int i = 0; i < 3; ++i) {
    vec2 place = p * tile[i].z + tile[i].xy;
    float texels = 128.0 * tile[i].z;  // a metre
    float lod = max(log2(footprint * texels), 0.0);
    float size = i == 0 ? 1.0 : gust;
    vec4 texel = textureLod(short_sea[i], place, lod);
    detail.slope += size * texel.xy;
    if (i < 2) {
      float shown = 0.5 * max(7.4 * cell, tile[i].w);  // half the length of waves that the grid shows
      detail.slope -= size * textureLod(short_sea[i], place, max(log2(shown * texels), lod)).xy;
    }
    detail.variance += size * size * max(texel.z - dot(texel.xy, texel.xy), 0.0);
    detail.foam = max(detail.foam, texel.w * (i == 0 ? smoothstep(1.0, 4.0, cell) : 0.22));
  }
  detail.slope *= weather.z;
  detail.variance *= weather.z * weather.z;
  return detail;
}

#include "shadow.glsl"
#ifdef WITH_WAKE
#include "wake.glsl"
#endif

// Share of a place that foam covers, where `amount` (0..1) of it is there: patches that break up as they fade, and in
// strong wind streaks along it. Blurred patterns count with their mean. The second value is the pattern itself, 0..1.
vec2 foam_cover(vec2 q, vec2 bend, float amount, float footprint, float streaky) {
  float streaking = streaky * 0.42 * smoothstep(11.0, 24.0, wave_axis.w);
  if (amount + streaking < 0.01) return vec2(0.0);
  float lod = max(log2(footprint * 256.0 / 24.0), 0.0);
  // gentle bends, so that neither streaks nor strands run straight and at even distances
  vec2 large = textureLod(foam_pattern, (q + 5.0 * bend) / vec2(36.0, 18.0), lod).rg;
  vec2 small = textureLod(foam_pattern, q.yx / vec2(4.0, 6.0) + 0.3 + 0.1 * bend, lod + 1.8).rg;
  float coarse = large.r, fine = small.r, bubbles = small.g;
  float grain = 0.45 * coarse + 0.37 * fine + 0.18 * bubbles;
  amount = clamp(amount, 0.0, 1.0);
  float blurred = smoothstep(1.5, 5.0, lod);
  // strands that thin out to lace, over a veil of small bubbles
  float lace = smoothstep(0.95 - 1.05 * amount, 1.32 - 1.05 * amount, grain) * min(1.0, 0.30 + 1.0 * amount);
  float veil = amount * amount * (0.25 + 0.45 * fine);
  float cover = mix(1.0 - (1.0 - lace) * (1.0 - veil), amount * (0.25 + 0.6 * amount), blurred);
  if (streaking > 0.0) {
    // they gather in some places and are frayed
    float gathered = smoothstep(-0.25, 0.3, bend.x);
    float shown = 0.62 * large.g + 0.23 * fine + 0.15 * coarse;
    cover += streaking * gathered * mix(smoothstep(0.66, 1.0, shown), 0.10, blurred) * (1.0 - cover);
  }
  return vec2(cover, mix(0.3 * coarse + 0.4 * fine + 0.3 * bubbles, 0.5, blurred));
}

struct Film { float thickness; float water; };  // um; volume share of water in the emulsion

#ifdef WITH_SLICK
// Oil on the water at a place. Streaks, wisps and ragged edges, which the elements are too large for, come from the
// foam's pattern. It is fixed to the middle of the oil, so that it drifts along.
Film film_at(vec2 p, float footprint) {
  Film film = Film(0.0, 0.0);
  vec2 uv = (p - slick_map.xy) * slick_map.z;
  if (any(lessThan(uv, vec2(0.0))) || any(greaterThan(uv, vec2(1.0)))) return film;
  float texel = 1.0 / (slick_map.z * float(textureSize(film_map, 0).x));
  vec2 q = p - slick_centre.xy;
  q = vec2(dot(q, wave_axis.xy), dot(q, vec2(-wave_axis.y, wave_axis.x)));
  float fine = log2(footprint * 256.0);
  float coarse = textureLod(foam_pattern, q / vec2(47.0, 31.0), max(fine - 5.0, 3.0)).r - 0.5;
  float middle = textureLod(foam_pattern, q.yx / vec2(11.0, 17.0) + 0.37, max(fine - 3.5, 2.5)).r - 0.5;
  float small = textureLod(foam_pattern, q / vec2(6.1, 4.3) + 0.71, max(fine - 2.2, 1.5)).r - 0.5;
  vec2 warp = min(0.5 * slick_centre.z, 1.2) * (vec2(coarse, middle) + 0.5 * vec2(middle, small));
  vec4 sums = textureLod(film_map, uv + warp * slick_map.z, max(log2(footprint / texel), 0.0));
  if (sums.z <= 0.0) return film;
  float pattern = 0.5 * coarse + 0.32 * middle + 0.18 * small;
  film.water = clamp(sums.y / max(sums.x, 1e-9) * (1.0 + 0.5 * pattern), 0.0, 1.0);
  // Beyond the discs the film falls to a thousandth at once, and from there slowly to nothing: a rim of sheen.
  float beyond = clamp(1.0 - 2.0 * sums.w - 0.25 * pattern, 0.0, 1.0);
  float rim = 1.0 - beyond;
  film.thickness = sums.x / sums.z * exp(-7.0 * smoothstep(0.0, 0.25, beyond) - 4.5 * beyond) * rim;
  film.thickness *= exp2(pattern * mix(5.0, 2.0, smoothstep(1.0, 300.0, film.thickness)));
  return film;
}

// Share of light that a film mirrors at normal incidence, by interference of its two faces (air 1, oil 1.48, water
// 1.33): silvery from 0.04 um on, colours above 0.3 um, the bare oil's where the orders run together. `spread`: how far
// the thickness differs within a pixel, um.
vec3 film_reflectance(float thickness, float spread, float cosine) {
  vec3 wavelength = vec3(0.61, 0.54, 0.465);  // um
  float path = 4.0 * kPi * 1.48 * sqrt(1.0 - (1.0 - cosine * cosine) / (1.48 * 1.48));
  vec3 blurred = exp(-pow(path * spread / wavelength * 0.35, vec3(2.0))) * exp(-thickness * thickness / 6.0);
  float contrast = mix(0.0204, 0.0300, smoothstep(0.02, 0.3, thickness));  // colours a little stronger than they are
  return 0.0404 - contrast * blurred * cos(path * thickness / wavelength);
}
#endif

// `churned` 0..1: how full of bubbles and how smooth a wake has left the water. `oil` 0..1: how much of the water is covered by thick oil. `film`: of the slick, `spread` as in film_reflectance().
vec3 shade_water(vec3 d, float inverse, vec2 slope, float foam, float churned, float oil, Film film, float spread, float height,
                 vec2 uv, vec4 behind, float behind_inverse) {
  vec3 p = d / inverse;
  float distance_to = length(p);
  float footprint_across = 1.0 / (inverse * forward.w);
  vec3 v = -p / distance_to;
  // How large a pixel is on the water, which may lean towards the eye or away from it.
  float grazing = clamp(dot(normalize(vec3(-slope, 1.0)), v), 0.004, 1.0);
  float footprint = footprint_across / grazing;
  // Patterns are anchored in the world, and sheared by the height: else a steep face would show them as stripes.
  vec2 anchored = p.xy + 0.8 * (p.z - level.x) * wave_axis.xy;
  vec2 place = in_pattern(anchored), drift = slow_pattern(place, footprint);
  churned *= clamp(0.85 + 0.9 * drift.x + 0.6 * drift.y, 0.3, 1.0);  // bubbles are not spread evenly
  Detail detail = short_waves(anchored, footprint, drift);
  float opaque = 1.0 - exp(-film.thickness / 70.0);  // the oil's own colour, by Beer's law
  float calm = max(max(oil, smoothstep(0.01, 0.6, film.thickness)), 0.7 * churned);
  // on steep water the ripples' map is stretched; oil damps them
  slope += (1.0 - 0.8 * calm) * detail.slope / (1.0 + 2.5 * dot(slope, slope));
  float variance = (1.0 - 0.8 * calm) * detail.variance + 0.0004;
  vec3 n = normalize(vec3(-slope, 1.0));
  float facing = dot(n, v);
  // facets seen from behind are hidden by others: tilt them to the rim
  if (facing < 0.03) { n = normalize(n + v * (0.03 - facing)); facing = 0.03; }
  float sigma = sqrt(variance);
  // Fresnel of a rough sea (Bruneton, Neyret & Holzschuch 2010)
  vec3 normal_incidence = vec3(mix(0.02, 0.037, oil));  // ((n - 1) / (n + 1))^2, n = 1.33 and 1.48
#ifdef WITH_SLICK
  if (film.thickness > 0.0) normal_incidence = mix(film_reflectance(film.thickness, spread, facing), normal_incidence, oil);
#endif
  vec3 fresnel = normal_incidence + (1.0 - normal_incidence) * pow(1.0 - facing, 5.0 * exp(-2.69 * sigma)) / (1.0 + 22.7 * sigma * sqrt(sigma));
  vec3 r = reflect(-v, n);
  r.z = abs(r.z) + 0.05 + 0.9 * sigma;  // rough water mirrors the sky higher up
  r = normalize(r);
  vec3 reflection = sky_colour(r, 4.4 + 1.6 * smoothstep(0.0, 0.2, sigma)) * vec3(0.86, 0.95, 1.05);
  // the ship's mirror image in the mean level, disturbed by the slopes
  vec2 bend = vec2(dot(slope, right.xy), 0.7 * dot(slope, normalize(forward.xy + 1e-4))) * min(9.0 * inverse, 0.5);
  vec4 image = textureLod(mirrored, uv + bend * vec2(0.30, 0.42), 1.0 + 5.0 * smoothstep(0.0, 0.25, sigma));
  reflection = mix(reflection, image.rgb / max(image.a, 1e-3), 0.7 * image.a);

  // Light that comes back out of the water, more through thin crests and where the sun stands behind them.
  vec3 deep = vec3(0.0045, 0.030, 0.062);
  vec3 shallow = vec3(0.018, 0.150, 0.170);
  float crest = clamp(0.25 + 0.30 * height, 0.0, 0.75);
  float through = crest * (0.35 + 0.65 * pow(max(dot(sun.xyz, -v) * 0.5 + 0.5, 0.0), 2.0)) *
                  clamp(0.6 + 1.4 * dot(slope, v.xy), 0.15, 1.0);
  float sun_here = sun_at(shadow_map, p);
  vec3 lit = 0.55 * sunlight.w + 0.75 * sun_here * sun.w * sunlight.rgb * max(dot(n, sun.xyz), 0.0);
  vec3 body = mix(deep, shallow, 0.40 * through) * lit;
  body = mix(body, vec3(0.040, 0.118, 0.140) * lit, 0.62 * churned);  // bubbles throw light back
  // Hull or other bodies below the surface (Beer's law)
  if (behind_inverse > 0.0 && behind_inverse < inverse) {
    vec2 refracted = uv + bend * 0.04;
    vec4 seen = textureLod(opaque_colour, refracted, 0.0);
    if (seen.a < 0.5 || textureLod(opaque_inverse, refracted, 0.0).r > inverse * seen.a) seen = behind;
    float path = (1.0 / behind_inverse - 1.0 / inverse) * length(d);
    vec3 kept = exp(-path * vec3(0.75, 0.30, 0.24));
    vec3 below = seen.rgb / max(seen.a, 1e-3);
    // the light comes down through the water as well
    body = mix(body, below * exp(-max(height - (d.z / behind_inverse - level.x), 0.0) * vec3(0.75, 0.30, 0.24)), kept);
  }
  vec3 brown = vec3(0.013, 0.0065, 0.003);
  vec3 mousse = mix(brown, vec3(0.095, 0.036, 0.012), smoothstep(0.15, 0.65, film.water));
  body = mix(body, mousse * lit, opaque);
  body = mix(body, brown * lit, oil);
  vec3 colour = mix(body, reflection, fresnel);
  // Sun glint: slopes that mirror the sun, Gaussian with the unresolved variance
  vec3 halfway = normalize(sun.xyz + v);
  vec2 wanted = -halfway.xy / max(halfway.z, 0.05);
  vec2 miss = wanted + n.xy / n.z;
  float glint_variance = variance + 0.0025;
  float glint = exp(-0.5 * dot(miss, miss) / glint_variance) / (glint_variance * 4.0 * pow(max(halfway.z, 0.3), 4.0));
  colour += sun_here * sun.w * vec3(1.0, 0.9, 0.72) * sunlight.rgb * min(glint * 0.05 * fresnel / max(facing, 0.12), 6.0) * (1.0 - image.a);
  vec2 white = foam_cover(place, drift, foam + (1.0 - calm) * detail.foam, footprint, 1.0 - churned);
  // bubbles lie thick where the pattern is high, thin over dark water where it is low
  vec3 foam_colour = mix(vec3(0.56, 0.65, 0.69), vec3(0.84, 0.87, 0.88), smoothstep(0.15, 0.75, white.y)) * (0.42 * sunlight.w + 0.50 * sun_here * sun.w * sunlight.rgb * clamp(dot(n, sun.xyz), 0.0, 1.0));
  colour = mix(colour, foam_colour, 0.93 * white.x);
  return mix(colour, haze_colour(d), haze_over(d, distance_to));
}

void main() {
  vec2 uv = 0.5 * ndc + 0.5;
  vec3 d = ray_through(ndc);
  vec4 body = textureLod(opaque_colour, uv, 0.0);
  float solid = body.a > 0.0 ? textureLod(opaque_inverse, uv, 0.0).r / body.a : 0.0;
  vec4 surface = textureLod(water_surface, uv, 0.0), traits = textureLod(water_traits, uv, 0.0);
  float water = max(surface.x, 1e-5);
  vec2 place = d.xy / water;
  // How far the place on level water recedes from one line to the next.
  float level_step = length(d) / (water * forward.w * clamp(-d.z / length(d), 0.01, 1.0));
  Film film = Film(0.0, 0.0);
  float spread = 0.0;
#ifdef WITH_SLICK
  if (slick_map.w > 0.0) film = film_at(place, level_step);
  spread = min(fwidth(film.thickness), 1e3);
#endif
  float oil = traits.y, clean = (1.0 - oil) * exp(-film.thickness / 70.0);
  vec2 slope = surface.yz;
  float white = traits.z, churned = 0.0;
#ifdef WITH_WAKE
  Wake wake = wake_at(place, level_step);
  slope += (1.0 - traits.x) * wake.slope;  // in the patch the particles make the ship's waves
  white = max(white, wake.foam);
  churned = clean * wake.churned;
#endif
  float foam = clean * (surface.w + white);
  vec3 colour = shade_water(d, water, slope, foam, churned, oil, film, spread, d.z / water - level.x, uv, body, solid);
  colour = tone_map(colour);
  if (solid > surface.x) {  // the edge of a body in front of the water
    float haze = 1.0 - exp(-length(d) / (solid * level.z));
    colour = mix(colour, tone_map(mix(body.rgb / body.a, haze_colour(d), haze)), body.a);
  }
  picture = vec4(colour, dot(colour, vec3(0.299, 0.587, 0.114)));
}
