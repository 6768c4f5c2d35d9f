// A particle's ellipsoid as the rectangle that just holds it on the screen, four vertices each.
// T = R diag(semi axes); in camera axes (right, up, depth) the tangent planes through the eye bound it:
//   p^2 (A_dd - c_d^2) + 2 p (c_x c_d - A_xd) + (A_xx - c_x^2) = 0,  A = T T^t, c the centre.
struct Particle {
  vec4 centre;       // relative to the eye; w: foam 0..1, or -1 for oil
  vec4 orientation;  // quaternion x, y, z, w
  vec4 semi_axes;    // w: spray 0..1
};
layout(std430, binding = 0) readonly buffer Particles { Particle particles[]; };
uniform float inflate;
out vec3 a;            // ellipsoid-space direction of this pixel's ray, affine in pixels
flat out vec3 b;       // ellipsoid-space centre
flat out vec2 traits;  // foam or oil, spray

vec3 turn(vec4 q, vec3 v) { return v + 2.0 * cross(q.xyz, cross(q.xyz, v) + q.w * v); }
vec3 to_camera(vec3 v) { return vec3(dot(v, right.xyz), dot(v, up.xyz), dot(v, forward.xyz)); }

vec2 bounds(vec3 c, float axx, float axd, float add, float cx) {
  float m = c.z * c.z - add;
  float h = cx * c.z - axd;
  float root = sqrt(max(h * h - m * (cx * cx - axx), 0.0));
  return vec2(h - root, h + root) / m;
}

void main() {
  Particle particle = particles[gl_VertexID >> 2];
  vec4 q = particle.orientation;
  vec3 axes = particle.semi_axes.xyz * inflate;
  vec3 c = to_camera(particle.centre.xyz);
  vec3 t0 = to_camera(turn(q, vec3(axes.x, 0, 0)));
  vec3 t1 = to_camera(turn(q, vec3(0, axes.y, 0)));
  vec3 t2 = to_camera(turn(q, vec3(0, 0, axes.z)));
  float add = t0.z * t0.z + t1.z * t1.z + t2.z * t2.z;
  traits = vec2(particle.centre.w, particle.semi_axes.w);
  if (c.z - sqrt(add) < 0.3) {  // at or behind the eye
    gl_Position = vec4(0.0, 0.0, -2.0, 1.0);
    a = vec3(0.0);
    b = vec3(0.0);
    return;
  }
  vec2 x = bounds(c, t0.x * t0.x + t1.x * t1.x + t2.x * t2.x, t0.x * t0.z + t1.x * t1.z + t2.x * t2.z, add, c.x);
  vec2 y = bounds(c, t0.y * t0.y + t1.y * t1.y + t2.y * t2.y, t0.y * t0.z + t1.y * t1.z + t2.y * t2.z, add, c.y);
  int corner = gl_VertexID & 3;
  vec3 d = vec3((corner & 1) == 0 ? x.x : x.y, (corner & 2) == 0 ? y.x : y.y, 1.0);
  // T^-1 v = (t_i . v / |t_i|^2)
  vec3 scale = vec3(1.0 / dot(t0, t0), 1.0 / dot(t1, t1), 1.0 / dot(t2, t2));
  a = scale * vec3(dot(t0, d), dot(t1, d), dot(t2, d));
  b = scale * vec3(dot(t0, c), dot(t1, c), dot(t2, c));
  gl_Position = vec4(d.xy / fluid_size.zw, 0.5, 1.0);
}
