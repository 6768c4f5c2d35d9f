// Clean-up and slopes of the smoothed surface: (inverse depth, dz/dx, dz/dy, foam less oil).
in vec2 ndc;
layout(binding = 0) uniform sampler2D fluid_inverse_depth;
layout(binding = 1) uniform sampler2D attributes;
layout(location = 0) out vec4 surface;

vec3 place(ivec2 pixel, float inverse) {
  vec2 n = (vec2(pixel) + 0.5) / fluid_size.xy * 2.0 - 1.0;
  return fluid_ray(n) / inverse;
}

// Mean of the pixel and its neighbours on the same surface: takes out the steps that the sparse filter leaves.
float cleaned(ivec2 pixel, ivec2 last) {
  float centre = texelFetch(fluid_inverse_depth, pixel, 0).r;
  if (centre <= 0.0) return 0.0;
  float sum = centre, count = 1.0;
  const ivec2 cross_of_four[4] = ivec2[4](ivec2(1, 0), ivec2(-1, 0), ivec2(0, 1), ivec2(0, -1));
  for (int k = 0; k < 4; k += 2) {  // in pairs, so that a tilted plane stays where it is
    float one = texelFetch(fluid_inverse_depth, clamp(pixel + 2 * cross_of_four[k], ivec2(0), last), 0).r;
    float other = texelFetch(fluid_inverse_depth, clamp(pixel + 2 * cross_of_four[k + 1], ivec2(0), last), 0).r;
    if (abs(one + other - 2.0 * centre) > 0.1 * centre) continue;
    sum += one + other;
    count += 2.0;
  }
  return sum / count;
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  ivec2 last = ivec2(fluid_size.xy) - 1;
  float centre = cleaned(pixel, last);
  surface = vec4(0.0);
  if (centre <= 0.0) return;
  // Steps as wide as a quarter of a particle, so that far water is not differenced below its resolution.
  int wide = clamp(int(0.35 * fluid.y * fluid.x * centre), 1, 8);
  vec3 here = place(pixel, centre);
  vec3 tangent[2];
  for (int k = 0; k < 2; ++k) {
    ivec2 go = k == 0 ? ivec2(wide, 0) : ivec2(0, k == 1 ? max(wide / 2, 1) : wide);
    ivec2 ahead = min(pixel + go, last), back = max(pixel - go, ivec2(0));
    float inverse_ahead = cleaned(ahead, last);
    float inverse_back = cleaned(back, last);
    vec3 to = inverse_ahead > 0.0 ? place(ahead, inverse_ahead) - here : vec3(1e9);
    vec3 from = inverse_back > 0.0 ? here - place(back, inverse_back) : vec3(1e9);
    float length_to = dot(to, to), length_from = dot(from, from);
    // central where both sides are alike, else the smaller side
    bool alike = length_to < 9.0 * length_from && length_from < 9.0 * length_to;
    tangent[k] = alike ? to + from : length_to < length_from ? to : from;
  }
  vec3 normal = cross(tangent[0], tangent[1]);
  if (dot(normal, here) > 0.0) normal = -normal;
  vec2 slope = normal.z > 0.05 * length(normal) ? -normal.xy / normal.z : vec2(0.0);
  vec2 foam = textureLod(attributes, gl_FragCoord.xy / fluid_size.xy, 0.0).rg;
  surface = vec4(centre, clamp(slope, -1.0, 1.0), foam.x / max(foam.y, 1e-5));
}
