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

void main() {
  vec2 uv = 0.5 * ndc + 0.5;
  float elevation = uv.y * uv.y * 0.5 * kPi;
  float azimuth = (uv.x - 0.5) * 2.0 * kPi;
  vec3 d = vec3(cos(elevation) * vec2(cos(azimuth), sin(azimuth)), sin(elevation));
  vec3 sky = clear_sky(d);
  // Two decks on flat layers; the higher one is streaky. They thin out towards the horizon, where haze hides them.
  vec2 low = d.xy / (d.z + 0.06);
  float warp = cloud_noise(low * 0.9 + 11.0, 3);
  float cover = cloud_noise(low * vec2(0.75, 1.1) + 1.3 * warp, 6);
  float cloud = smoothstep(0.50, 0.78, cover) * smoothstep(0.01, 0.14, d.z);
  float streaks = cloud_noise(low * vec2(0.35, 1.6) * 0.6 + 40.0 + 0.5 * warp, 5);
  float thin = 0.45 * smoothstep(0.45, 0.85, streaks) * smoothstep(0.03, 0.25, d.z);
  float towards = max(dot(d, sun.xyz), 0.0);
  vec3 lit = vec3(0.93, 0.92, 0.90) + vec3(0.35, 0.28, 0.2) * pow(towards, 8.0);
  vec3 shade = vec3(0.60, 0.66, 0.73);
  vec3 cloud_colour = mix(shade, lit, smoothstep(0.85, 0.45, cover - 0.12 * towards));
  sky = mix(sky, vec3(0.88, 0.90, 0.92), thin);
  sky = mix(sky, cloud_colour, 0.85 * cloud);
  colour = vec4(sky, 1.0);
}
