// Drops that have left the water, as soft round sprites.
struct Particle { vec4 centre; vec4 orientation; vec4 semi_axes; };
layout(std430, binding = 0) readonly buffer Particles { Particle particles[]; };
out vec2 corner;
flat out float strength;
flat out float inverse_depth;
flat out vec2 grain_at;  // where in the pattern, different for each drop
void main() {
  Particle particle = particles[gl_VertexID >> 2];
  int k = gl_VertexID & 3;
  corner = vec2((k & 1) == 0 ? -1.0 : 1.0, (k & 2) == 0 ? -1.0 : 1.0);
  vec3 c = particle.centre.xyz;
  float depth = dot(c, forward.xyz);
  strength = particle.semi_axes.w * smoothstep(0.5, 4.0, depth);
  inverse_depth = 1.0 / max(depth, 0.3);
  int drop = gl_VertexID >> 2;
  grain_at = fract(vec2(drop * 0.754877, drop * 0.569840));  // low-discrepancy
  float radius = (0.45 + 0.5 * grain_at.x) * fluid.y;
  gl_Position = depth < 0.3 ? vec4(0.0, 0.0, -2.0, 1.0) : project(c + radius * (corner.x * right.xyz + corner.y * up.xyz));
}
