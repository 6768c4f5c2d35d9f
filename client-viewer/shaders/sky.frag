// The sky picture: clear sky by Preetham, Shirley and Smits (1999), clouds, stars, haze. Drawn when the light changes.
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

const float kTurbidity = 3.0;  // clear maritime air

// Perez et al. (1993): by the angle to the zenith and to the sun.
float perez(vec4 abcd, float e, float zenith_cosine, float to_sun, float sun_cosine) {
  return (1.0 + abcd.x * exp(abcd.y / zenith_cosine)) * (1.0 + abcd.z * exp(abcd.w * to_sun) + e * sun_cosine * sun_cosine);
}

float part(vec4 abcd, float e, float zenith_value, float d_z, float to_sun, float sun_zenith) {
  float here = perez(abcd, e, d_z, to_sun, cos(to_sun));
  return zenith_value * here / perez(abcd, e, 1.0, sun_zenith, cos(sun_zenith));
}

vec3 clear_sky(vec3 d) {
  float t = kTurbidity;
  // The model ends where the sun is at the horizon. Below, daylight dims what it has there.
  vec3 s = normalize(vec3(sun.xy, max(sun.z, 0.03)));
  float sun_zenith = acos(s.z), z2 = sun_zenith * sun_zenith, z3 = z2 * sun_zenith;
  float chi = (4.0 / 9.0 - t / 120.0) * (kPi - 2.0 * sun_zenith);
  float zenith_y = (4.0453 * t - 4.9710) * tan(chi) - 0.2155 * t + 2.4192;  // kcd/m^2
  vec4 powers = vec4(z3, z2, sun_zenith, 1.0);
  float zenith_cx = dot(vec3(t * t, t, 1.0), vec3(dot(powers, vec4(0.00166, -0.00375, 0.00209, 0.0)),
      dot(powers, vec4(-0.02903, 0.06377, -0.03202, 0.00394)), dot(powers, vec4(0.11693, -0.21196, 0.06052, 0.25886))));
  float zenith_cy = dot(vec3(t * t, t, 1.0), vec3(dot(powers, vec4(0.00275, -0.00610, 0.00317, 0.0)),
      dot(powers, vec4(-0.04214, 0.08970, -0.04153, 0.00516)), dot(powers, vec4(0.15346, -0.26756, 0.06670, 0.26688))));
  float d_z = max(d.z, 0.015), to_sun = acos(clamp(dot(d, s), -1.0, 1.0));
  float y = part(vec4(0.1787 * t - 1.4630, -0.3554 * t + 0.4275, -0.0227 * t + 5.3251, 0.1206 * t - 2.5771),
                 -0.0670 * t + 0.3703, zenith_y, d_z, to_sun, sun_zenith);
  float cx = part(vec4(-0.0193 * t - 0.2592, -0.0665 * t + 0.0008, -0.0004 * t + 0.2125, -0.0641 * t - 0.8989),
                  -0.0033 * t + 0.0452, zenith_cx, d_z, to_sun, sun_zenith);
  float cy = part(vec4(-0.0167 * t - 0.2608, -0.0950 * t + 0.0092, -0.0079 * t + 0.2102, -0.0441 * t - 1.6537),
                  -0.0109 * t + 0.0529, zenith_cy, d_z, to_sun, sun_zenith);
  // An eye that adapts: a low sun's sky is shown brighter than it is.
  y *= sunlight.w * pow(6.2 / zenith_y, 0.8) / 30.0;
  vec3 xyz = y / cy * vec3(cx, cy, 1.0 - cx - cy);
  vec3 rgb = mat3(3.2406, -0.9689, 0.0557, -1.5372, 1.8758, -0.2040, -0.4986, 0.0415, 1.0570) * xyz;
  // The model's white is the sun's, warmer than the screen's, and its low sun turns green.
  float low_sun = 1.0 - smoothstep(0.03, 0.35, s.z);
  rgb = max(rgb, vec3(0.0)) * mix(vec3(0.70, 0.96, 1.14), vec3(1.02, 0.86, 1.02), low_sun);
  rgb = mix(rgb, vec3(dot(rgb, vec3(0.3, 0.5, 0.2))), 0.12 * low_sun);
  // After sunset: blue, with a glow over the place where the sun has gone down.
  vec3 after = sunlight.w * mix(vec3(0.16, 0.27, 0.52), vec3(0.42, 0.55, 0.78), exp(-4.0 * d.z));
  float glow = exp(-5.0 * d.z) * pow(max(0.5 + 0.5 * dot(normalize(d.xy + 1e-5), normalize(sun.xy + 1e-5)), 0.0), 3.0);
  after += sunlight.w * vec3(1.9, 0.72, 0.20) * glow * smoothstep(-0.22, -0.02, sun.z);
  return mix(rgb, after, smoothstep(0.03, -0.09, sun.z));
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
  float rim = weather.x < 0.375 ? 0.75 - 0.747 * weather.x : 0.47 - 0.48 * (weather.x - 0.375);  // 3 oktas: 0.47
  float cloud = smoothstep(rim, rim + 0.19, cover) * smoothstep(0.004, 0.05, d.z);
  cloud = max(cloud, smoothstep(0.8, 1.0, weather.x) * smoothstep(0.004, 0.05, d.z));
  float streaks = cloud_noise(low * vec2(0.35, 1.4) * 0.7 + 40.0 + 0.6 * warp, 6);
  float thin = 0.40 * smoothstep(0.0, 0.2, weather.x) * smoothstep(0.42, 0.80, streaks) * smoothstep(0.02, 0.14, d.z);
  float towards = max(dot(d, sun.xyz), 0.0), day = sunlight.w;
  float overcast = smoothstep(0.6, 1.0, weather.x);
  vec3 lit = day * mix(vec3(1.08, 1.06, 1.02), vec3(0.62, 0.65, 0.69), overcast) +
             sun.w * sunlight.rgb * (vec3(0.10, 0.09, 0.08) + vec3(0.35, 0.28, 0.2) * pow(towards, 8.0));
  lit *= mix(vec3(1.0), sunlight.rgb, 0.6 * min(sun.w, 1.0) * (1.0 - overcast));
  vec3 shade = day * mix(vec3(0.62, 0.69, 0.77), vec3(0.40, 0.43, 0.47), overcast);
  vec3 cloud_colour = mix(lit, shade, smoothstep(0.52, 0.80, cover + 0.12 * overcast - 0.08 * towards));
  float night = smoothstep(-0.08, -0.2, sun.z);
  vec3 cell = floor(d * 260.0);
  sky += night * step(0.9988, hash(cell)) * (0.15 + 0.6 * hash(cell + 7.0)) * smoothstep(0.02, 0.2, d.z);
  sky = mix(sky, day * vec3(0.88, 0.90, 0.92), thin);
  sky = mix(sky, cloud_colour, mix(0.9, 1.0, overcast) * cloud * mix(0.45, 1.0, smoothstep(0.0, 0.12, d.z)));
  // Haze or fog lies on the water, some 120 m thick.
  float veil = 1.0 - exp(-360.0 / (weather.y * max(d.z, 0.01)));
  vec3 fog = day * mix(vec3(0.52, 0.67, 0.82), vec3(0.70, 0.73, 0.76), smoothstep(12000.0, 3000.0, weather.y)) + 0.08 * sun.w * sunlight.rgb;
  sky = mix(sky, fog, mix(0.6, 1.0, smoothstep(8000.0, 2000.0, weather.y)) * veil);
  colour = vec4(sky, 1.0);
}
