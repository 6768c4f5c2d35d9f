// What moving hulls do to the water: Kelvin waves, and the foam that goes along with them, from their speed through the
// water and turn rate alone; and what they and the particles have left on the water, from the foam map.
layout(binding = 13) uniform sampler2D foam_levels[2];
struct Wake {
  float foam;     // 0..1
  float churned;  // 0..1: water full of bubbles, smoothed by turbulence
  vec2 slope;     // of the Kelvin waves
};

// One family of Kelvin's waves: those whose crests at a place run at `tangent` (of the angle to the hull's way).
// `x` astern, `y` to port (m); `number`: wave number of waves that follow the hull, g / U^2.
vec2 kelvin_family(float x, float y, float tangent, float number, float depth_of_hull, float footprint) {
  float secant2 = 1.0 + tangent * tangent, secant = sqrt(secant2);
  float k = number * secant2;
  float phase = k * (x + y * tangent) / secant;
  float size = 0.55 * inversesqrt(max(number * length(vec2(x, y)), 0.5)) * exp(-0.35 * k * depth_of_hull);
  size *= 1.0 - smoothstep(0.8, 2.5, k * footprint);
  return size * k * sin(phase) / secant * vec2(1.0, tangent);
}

// Waves of a point at the bow by the method of stationary phase (Kelvin 1887): 2 y t^2 + x t + y = 0 for the tangents t.
vec2 kelvin_slope(vec2 astern, float speed, float half_beam, float footprint) {
  float x = astern.x, y = astern.y;
  float inside = x * x - 8.0 * y * y;
  if (x < 1.0 || inside <= 0.0) return vec2(0.0);
  float root = sqrt(inside), number = 9.81 / (speed * speed);
  float edge = smoothstep(0.0, 0.25, root / x);  // at the wedge's edge the method fails
  float far_y = abs(y) < 0.05 ? 0.05 : y;
  vec2 slope = kelvin_family(x, y, -2.0 * y / (x + root), number, half_beam, footprint) +
               kelvin_family(x, y, -(x + root) / (4.0 * far_y), number, half_beam, footprint);
  return half_beam / 4.5 * smoothstep(1.5, 5.0, speed) * mix(0.6, 1.0, edge) * slope;
}

void add_hull(int i, vec2 p, float footprint, inout Wake wake) {
  float half_length = hull_size[i].x, half_beam = hull_size[i].y, speed = hull_size[i].z;
  vec2 r = p - hull[i].xy;
  vec2 q = vec2(dot(r, hull[i].zw), dot(r, vec2(-hull[i].w, hull[i].z)));
  float along = q.x / half_length;
  float go = smoothstep(0.4, 5.0, speed), wash = 1.0 - exp(-speed * speed / 25.0);  // wash_of of foam_map.cpp
  float fore = clamp((along - 0.15) / 0.80, 0.0, 1.0), entry = 1.0 - fore * fore;
  float edge = abs(q.y) - half_beam * entry;
  float beside = smoothstep(1.12, 0.9, abs(along)) * exp(-max(edge, 0.0) / (0.35 + 0.9 * go));
  float foam = beside * (0.25 + 0.55 * go);
  // the bow wave breaks along two arms, from the stem outwards and aft
  float aft_of_bow = half_length * 0.96 - q.x;
  if (aft_of_bow > -2.0) {
    float arm = abs(q.y) - half_beam * entry - 0.3 - 0.22 * max(aft_of_bow, 0.0);
    float width = 0.8 + 0.10 * max(aft_of_bow, 0.0);
    float inner = arm < 0.0 ? 2.2 : 1.0;  // the foam trails off inwards
    foam += go * 1.5 * smoothstep(-2.0, 1.5, aft_of_bow) * exp(-arm * arm / (width * width * inner * inner)) * exp(-max(aft_of_bow, 0.0) / (3.0 + 2.0 * speed));
  }
  // the wash boils for some seconds; what is left of it is on the map
  float astern = -q.x - half_length * 0.94;
  if (astern > -1.5) {
    float age = max(astern, 0.0) / max(speed, 0.3);  // s since the stern was there
    float across = abs(q.y - 0.5 * hull_size[i].w * astern * astern) / (half_beam * (0.72 + 0.03 * age));
    float core = exp(-across * across * across * across) * smoothstep(-1.5, 0.5, astern);
    foam += wash * core * 0.75 * exp(-age / 5.0);
  }
  wake.foam += foam;
  vec2 slope = kelvin_slope(vec2(half_length * 0.9 - q.x, q.y - 0.5 * hull_size[i].w * astern * astern), speed, half_beam, footprint);
  wake.slope += -slope.x * hull[i].zw + slope.y * vec2(-hull[i].w, hull[i].z);
}

// White foam and bubbles on the foam map: the fine level, where it reaches and a pixel is not much larger than its texels.
vec2 foam_left_at(vec2 p, float footprint) {
  vec2 from_fine = abs(p - foam_window[0].xy), from_coarse = abs(p - foam_window[1].xy);
  float fine = smoothstep(foam_window[0].z, 0.85 * foam_window[0].z, max(from_fine.x, from_fine.y)) *
               smoothstep(5.0 * foam_window[0].w, 2.5 * foam_window[0].w, footprint);
  float coarse = smoothstep(foam_window[1].z, 0.9 * foam_window[1].z, max(from_coarse.x, from_coarse.y));
  vec2 here = coarse * textureLod(foam_levels[1], p * foam_map[1].z + foam_map[1].xy, 0.0).rg;
  if (fine > 0.0) here = mix(here, textureLod(foam_levels[0], p * foam_map[0].z + foam_map[0].xy, 0.0).rg, fine);
  return here * foam_left.xy;
}

Wake wake_at(vec2 p, float footprint) {
  Wake wake = Wake(0.0, 0.0, vec2(0.0));
  if (foam_left.z > 0.5) {
    vec2 left = foam_left_at(p, footprint);
    wake.foam = left.x;
    wake.churned = left.y;
  }
  int hulls = int(fluid.z);
  for (int i = 0; i < hulls; ++i) add_hull(i, p, footprint, wake);
  wake.churned = min(wake.churned, 1.0);
  return wake;
}
