// What moving hulls do to the water around and behind them: foam, churned water and Kelvin waves. It follows from the
// hulls' speed through the water and turn rate alone, so that all channels draw the same.
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
  float go = smoothstep(0.4, 5.0, speed);
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
  float astern = -q.x - half_length * 0.94;
  if (astern > -1.5) {
    float age = max(astern, 0.0) / max(speed, 0.3);  // s since the stern was there
    float off = q.y - 0.5 * hull_size[i].w * astern * astern;
    float width = half_beam * (0.7 + 0.5 * log2(1.0 + max(astern, 0.0) / half_length)) ;
    float across = abs(off) / width;
    float core = exp(-across * across * across * across), start = smoothstep(-1.5, 0.5, astern);
    float rims = exp(-16.0 * (across - 0.95) * (across - 0.95));
    float fades = exp(-age / 40.0), fast = fades * fades * fades, faster = fast * fast * fades;
    foam += go * start * (core * (0.75 * faster + 0.34 * fades) + 0.38 * rims * fast);
    wake.churned += go * start * core * (0.8 * fades * fades + 0.45 * sqrt(fades));
  }
  wake.foam += foam;
  vec2 slope = kelvin_slope(vec2(half_length * 0.9 - q.x, q.y - 0.5 * hull_size[i].w * astern * astern), speed, half_beam, footprint);
  wake.slope += -slope.x * hull[i].zw + slope.y * vec2(-hull[i].w, hull[i].z);
}

Wake wake_at(vec2 p, float footprint) {
  Wake wake = Wake(0.0, 0.0, vec2(0.0));
  int hulls = int(fluid.z);
  for (int i = 0; i < hulls; ++i) add_hull(i, p, footprint, wake);
  wake.churned = min(wake.churned, 1.0);
  return wake;
}
