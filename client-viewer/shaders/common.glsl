// What every shader of the viewer knows. Positions are metres relative to the eye, axes east, north, up.
// Surfaces are kept as inverse linear depth (1/m, 0: nothing there): linear on planes, and the nearest is the largest.
layout(std140, binding = 0) uniform View {
  vec4 right;          // world axes of the camera; w: tangent of half the horizontal field of view
  vec4 up;             //                           w: tangent of half the vertical field of view
  vec4 forward;        //                           w: focal length, pixels
  vec4 size;           // picture: width, height, 1/width, 1/height
  vec4 fluid_size;     // fluid buffers: width, height (guard band included), tangents of their half fields of view
  vec4 fluid;          // focal length of the fluid buffers in pixels, particle spacing, how many hulls, -
  vec4 level;          // z of the mean water level relative to the eye, display time modulo an hour, way (m) on which the
                       // air takes all but 1 / e of the contrast, envelope
                       // of the crests' folding above which they break, in standard deviations
  vec4 patch_box;      // simulated patch: min x, min y, max x, max y relative to the eye
  vec4 patch_blend;    // present (0 or 1), distance from the edge where the patch starts to show, where it is all;
                       // standard deviation of the folding
  vec4 sun;            // direction to the sun; w: strength of its direct light
  vec4 sunlight;       // colour of that light; w: daylight, 1 by day, 0.05 at night
  vec4 weather;        // clouds 0..1; visibility (m); size of short waves, 1 on open water
  vec4 wave_axis;      // main direction of the waves x, y; slope variance of all short waves; wind speed (m/s)
  vec4 pattern;        // axis of foam streaks x, y; the eye in axes along and across it, modulo the patterns' period
  vec4 sea_grid;       // of the far sea: coarseness, height of the eye that it is for, 2 pi / sectors; slope variance of
                       // waves shorter than those of the tiles
  vec4 tile[3];        // of short waves: the eye's place x, y in parts of a side, 1 / side (1/m), length (m) above
                       // which its waves stand in for wave components
  vec4 hull[4];        // bodies that leave a wake: x, y relative to the eye, cos and sin of the way that they go
  vec4 hull_size[4];   // half length, half beam (0: none), speed through the water (m/s), path curvature (1/m, positive to
                       // port)
  vec4 shadow[3];      // map of shadows: a place to its u and to its v; bias (m), middle and scale of its depths
  vec4 slick_map;      // map of the oil film: corner x, y relative to the eye, 1 / length of a side, present (0 or 1)
  vec4 slick_centre;   // middle of the oil: x, y relative to the eye; reach of its elements (m); unused
  vec4 foam_map[2];    // a level of the foam map: the eye's place x, y in parts of a side, 1 / side (1/m), unused
  vec4 foam_window[2]; // its middle x, y relative to the eye, from there to its edges (m), length of a texel (m)
  vec4 foam_left;      // shares of white foam and of bubbles that are left of what it holds; present (0 or 1)
};

const float kPi = 3.14159265;

vec3 ray_through(vec2 ndc) { return forward.xyz + right.xyz * (ndc.x * right.w) + up.xyz * (ndc.y * up.w); }
vec3 fluid_ray(vec2 ndc) { return forward.xyz + right.xyz * (ndc.x * fluid_size.z) + up.xyz * (ndc.y * fluid_size.w); }

vec4 project(vec3 p) {  // reversed depth without a far plane, near plane at 0.2 m
  float depth = dot(p, forward.xyz);
  return vec4(dot(p, right.xyz) / right.w, dot(p, up.xyz) / up.w, 0.2, depth);
}

// Size of a cell of the far sea's grid at a distance, m.
float grid_cell(float radius) {
  float radial = max(0.026 * length(vec2(radius, sea_grid.y)), radius * radius / (sea_grid.y * 900.0));
  return max(sea_grid.x * radial, radius * sea_grid.z);
}

// How much of the simulated patch shows at a place: 0 outside and at its rim, 1 inside.
float patch_weight(vec2 p) {
  vec2 inside = min(p - patch_box.xy, patch_box.zw - p);
  return patch_blend.x * smoothstep(patch_blend.y, patch_blend.z, min(inside.x, inside.y));
}

// The sky is kept as a picture, a stereographic map: the zenith in the middle, the horizon a circle. Beyond the circle it
// is mirrored, so that blurred levels hold at the horizon.
vec2 sky_place(vec3 direction) { return 0.5 + 0.48 * direction.xy / (1.0 + max(direction.z, 0.0)); }
