// The sky picture: gradient, glow about the sun, fair-weather clouds. Drawn once.
in vec2 ndc;
out vec4 colour;

float hash(vec3 p) {
  p = fract(p * 0.1031);
  p += dot(p, p.zyx + 31.32);
  return fract((p.x + p.y) * p.z);
}
float noise(vec3 p) {
  vec3 i = floor(p), f = fract(p);
  f = f * f * (3.0 - 2.0 * f);
  vec4 a = vec4(hash(i), hash(i + vec3(1, 0, 0)), hash(i + vec3(0, 1, 0)), hash(i + vec3(1, 1, 0)));
  vec4 b = vec4(hash(i + vec3(0, 0, 1)), hash(i + vec3(1, 0, 1)), hash(i + vec3(0, 1, 1)), hash(i + vec3(1, 1, 1)));
  vec4 m = mix(a, b, f.z);
  vec2 n = mix(m.xy, m.zw, f.y);
  return mix(n.x, n.y, f.x);
}
float cloud_noise(vec2 p, int octaves) {
  float sum = 0.0, weight = 0.5;
  for (int i = 0; i < octaves; ++i) {
    sum += weight * noise(vec3(p, 3.7 * float(i)));
    p = mat2(1.6, 1.2, -1.2, 1.6) * p;
    weight *= 0.5;
  }
  return sum;
}

vec3 clear_sky(vec3 direction) {
  float up_part = max(direction.z, 0.0);
  vec3 horizon = vec3(0.62, 0.74, 0.84);
  vec3 middle = vec3(0.27, 0.46, 0.70);
  vec3 zenith = vec3(0.07, 0.18, 0.43);
  vec3 colour = mix(mix(zenith, middle, exp(-2.6 * up_part)), horizon, exp(-9.0 * up_part));
  float towards = max(dot(direction, sun.xyz), 0.0);
  colour += vec3(1.0, 0.86, 0.66) * (0.10 * pow(towards, 6.0) + 0.22 * pow(towards, 48.0));
  return colour;
}

void main() {
  vec2 q = ndc / 0.96;  // sky_place of common.glsl, turned round
  float r2 = dot(q, q);
  vec3 d = vec3(2.0 * q, abs(1.0 - r2)) / (1.0 + r2);
  vec3 sky = clear_sky(d);
  // Two decks on flat layers; the higher one is streaky. They thin out towards the horizon, where haze hides them.
  vec2 low = d.xy / (d.z + 0.10);
  float warp = cloud_noise(low * 0.8 + 11.0, 3);
  float cover = cloud_noise(low * 0.95 + 1.1 * warp + 3.0, 7);
  float cloud = smoothstep(0.47, 0.66, cover) * smoothstep(0.004, 0.05, d.z);
  float streaks = cloud_noise(low * vec2(0.35, 1.4) * 0.7 + 40.0 + 0.6 * warp, 6);
  float thin = 0.55 * smoothstep(0.42, 0.80, streaks) * smoothstep(0.02, 0.14, d.z);
  float towards = max(dot(d, sun.xyz), 0.0);
  vec3 lit = vec3(1.08, 1.06, 1.02) + vec3(0.35, 0.28, 0.2) * pow(towards, 8.0);
  vec3 shade = vec3(0.62, 0.69, 0.77);
  vec3 cloud_colour = mix(lit, shade, smoothstep(0.52, 0.80, cover - 0.08 * towards));
  sky = mix(sky, vec3(0.88, 0.90, 0.92), thin);
  sky = mix(sky, cloud_colour, 0.9 * cloud * mix(0.45, 1.0, smoothstep(0.0, 0.12, d.z)));
  colour = vec4(sky, 1.0);
}
