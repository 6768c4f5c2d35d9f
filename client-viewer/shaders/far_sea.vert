// The open sea: a polar grid about the eye, displaced by the wave components (first-order Lagrangian theory, as
// wave_displacement in common/waves). A wave fades out where the grid is too coarse for it.
layout(std140, binding = 1) uniform Waves {
  vec4 wave[64];        // amplitude, wave number, direction x, y
  vec4 wave_phase[64];  // phase at the eye and the display time; 1 if the patch carries this wave itself; -, -
  ivec4 wave_count;
};
layout(std430, binding = 2) readonly buffer Rings { float ring_radius[]; };
uniform int rings;
uniform int first_sector;
uniform int sectors_around;
out vec4 surface;  // slope x, y; folding of the crest; height
void main() {
  int ring = gl_VertexID % rings;
  int sector = first_sector + gl_VertexID / rings;
  float angle = 2.0 * kPi * float(sector % sectors_around) / float(sectors_around);
  float radius = ring_radius[ring];
  vec2 p = radius * vec2(cos(angle), sin(angle));
  float next_radius = ring_radius[min(ring + 1, rings - 1)];
  float cell = max(next_radius - radius, radius * 2.0 * kPi / float(sectors_around));
  float open_water = 1.0 - patch_weight(p);
  vec3 shift = vec3(0.0);
  vec2 grad = vec2(0.0);
  vec3 jacobian = vec3(0.0);  // xx, xy, yy of the horizontal displacement's gradient
  for (int i = 0; i < wave_count.x; ++i) {
    float wavelength = 2.0 * kPi / wave[i].y;
    float fade = smoothstep(3.0, 6.5, wavelength / cell) * mix(1.0, open_water, wave_phase[i].y);
    float a = wave[i].x * fade, k = wave[i].y;
    vec2 d = wave[i].zw;
    float theta = k * dot(d, p) + wave_phase[i].x;
    float s = sin(theta), c = cos(theta);
    shift += vec3(-a * s * d, a * c);
    grad -= a * k * s * d;
    jacobian -= a * k * c * vec3(d.x * d.x, d.x * d.y, d.y * d.y);
  }
  mat2 stretch = mat2(1.0 + jacobian.x, jacobian.y, jacobian.y, 1.0 + jacobian.z);
  float fold = determinant(stretch);
  vec2 slope = fold > 0.15 ? inverse(stretch) * grad : grad;
  surface = vec4(clamp(slope, -1.2, 1.2), fold, shift.z);
  gl_Position = project(vec3(p, level.x) + shift);
}
