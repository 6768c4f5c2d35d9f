// What every shader of the viewer knows. Positions are metres relative to the eye, axes east, north, up.
// Surfaces are kept as inverse linear depth (1/m, 0: nothing there): linear on planes, and the nearest is the largest.
layout(std140, binding = 0) uniform View {
  vec4 right;          // world axes of the camera; w: tangent of half the horizontal field of view
  vec4 up;             //                           w: tangent of half the vertical field of view
  vec4 forward;        //                           w: focal length, pixels
  vec4 size;           // picture: width, height, 1/width, 1/height
  vec4 fluid_size;     // fluid buffers: width, height (guard band included), tangents of their half fields of view
  vec4 fluid;          // focal length of the fluid buffers in pixels, particle spacing, -, -
  vec4 level;          // z of the mean water level relative to the eye, display time modulo an hour, visibility (m), folding
                       // of the open sea below which crests break
  vec4 patch_box;      // simulated patch: min x, min y, max x, max y relative to the eye
  vec4 patch_blend;    // present (0 or 1), distance from the edge where the patch starts to show, where it is all;
                       // standard deviation of the folding
  vec4 sun;            // direction to the sun; w: strength
  vec4 wave_axis;      // main direction of the waves x, y; ripple slope scale; wind speed (m/s)
  vec4 ripple_eye;     // the eye modulo the detail's period: in wave axes, and in world axes (x, y)
  vec4 ripple_shift;   // drift of the two ripple layers, wave axes, m
  vec4 ship;           // own ship: x, y relative to the eye, cos and sin of its heading
  vec4 ship_size;      // half length, half beam (0: no ship), speed ahead (m/s), path curvature (1/m, positive to port)
  vec4 slick_map;      // map of the oil film: corner x, y relative to the eye, 1 / length of a side, present (0 or 1)
  vec4 slick_centre;   // middle of the oil: x, y relative to the eye; reach of its elements (m); unused
};

const float kPi = 3.14159265;

vec3 ray_through(vec2 ndc) { return forward.xyz + right.xyz * (ndc.x * right.w) + up.xyz * (ndc.y * up.w); }
vec3 fluid_ray(vec2 ndc) { return forward.xyz + right.xyz * (ndc.x * fluid_size.z) + up.xyz * (ndc.y * fluid_size.w); }

vec4 project(vec3 p) {  // reversed depth without a far plane, near plane at 0.2 m
  float depth = dot(p, forward.xyz);
  return vec4(dot(p, right.xyz) / right.w, dot(p, up.xyz) / up.w, 0.2, depth);
}

// How much of the simulated patch shows at a place: 0 outside and at its rim, 1 inside.
float patch_weight(vec2 p) {
  vec2 inside = min(p - patch_box.xy, patch_box.zw - p);
  return patch_blend.x * smoothstep(patch_blend.y, patch_blend.z, min(inside.x, inside.y));
}

// The sky is kept as a picture: azimuth across, square root of the elevation upwards.
vec2 sky_place(vec3 direction) {
  float elevation = asin(clamp(direction.z, 0.0, 1.0));
  return vec2(atan(direction.y, direction.x) / (2.0 * kPi) + 0.5, sqrt(elevation / (0.5 * kPi)));
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
