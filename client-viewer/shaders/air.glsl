// The sky, what the air adds to a colour, and the tone curve.
layout(binding = 5) uniform sampler2D sky;

vec3 sky_colour(vec3 d, float blur) {
  vec3 colour = textureLod(sky, sky_place(d), blur).rgb;
  return colour;
}
// What the air adds on a long way: the sky just above the horizon, blurred.
vec3 haze_colour(vec3 d) { return textureLod(sky, 0.5 + 0.47 * normalize(d.xy + 1e-6), 5.0).rgb; }

// How much of the light that comes from `d`, `distance_to` metres away, is the air's. Just below the horizon, within seven
// pixels, it is all of it: else the horizon would be an edge that flickers.
float haze_over(vec3 d, float distance_to) {
  float below = max(-d.z, 0.0) * inversesqrt(dot(d, d)) * forward.w;  // pixels
  float far = clamp(1.0 - below / 7.0, 0.0, 1.0);
  return max(1.0 - exp(-distance_to / level.z), far * smoothstep(60.0, 350.0, distance_to));
}

// Filmic curve with a toe, so that deep water stays deep, and a soft shoulder for sky and foam.
vec3 tone_map(vec3 c) {
  c *= 1.12;
  c = c * (c + 0.26) / (c * (0.80 * c + 0.62) + 0.30);
  // c^(1 / 2.2) within 0.002, by roots, which cost less
  vec3 root = sqrt(clamp(c, 0.0, 1.0)), fourth = sqrt(root), eighth = sqrt(fourth);
  return 0.5851 * root + 0.7831 * fourth - 0.3683 * eighth;
}
