// Water that has left the water: each particle as a veil of mist and some clusters of drops about it, drawn out along
// their way.
struct Particle { vec4 centre; vec4 velocity; vec4 looks; };  // size (m), 1: also outside of the patch, unused, strength
layout(std430, binding = 0) readonly buffer Particles { Particle particles[]; };
out vec2 corner;
flat out float strength;
flat out float inverse_depth;
flat out vec3 grain;  // where in the pattern, different for each sprite; share of drops, the rest is mist
flat out float lod;   // of the pattern
flat out float softness;  // m

const int kSprites = 8;  // a particle: kSpritesOfADrop of composite.cpp
const float kExposure = 0.03;  // s: drops are seen as streaks of this time

float scattered(int n, float a) { return fract(float(n) * a + 0.5); }  // low-discrepancy

void main() {
  int sprite = gl_VertexID >> 2, k = gl_VertexID & 3;
  Particle particle = particles[sprite / kSprites];
  bool mist = sprite % kSprites == 0;
  corner = vec2((k & 1) == 0 ? -1.0 : 1.0, (k & 2) == 0 ? -1.0 : 1.0);
  vec3 random = vec3(scattered(sprite, 0.8191725), scattered(sprite, 0.6710436), scattered(sprite, 0.5497005));
  vec3 c = particle.centre.xyz + (mist ? vec3(0.0) : 2.2 * (random - 0.5) * particle.looks.x);
  float depth = dot(c, forward.xyz);
  strength = particle.looks.w * smoothstep(0.5, 4.0, depth) * mix(patch_weight(c.xy), 1.0, particle.looks.y);
  inverse_depth = 1.0 / max(depth, 0.3);
  grain = vec3(random.yz, mist ? 0.0 : 1.0);
  float radius = (mist ? 0.8 : 0.16 + 0.22 * random.x) * particle.looks.x;
  softness = particle.looks.x;
  lod = max(log2(42.0 / (radius * forward.w * inverse_depth)), 0.8);
  vec2 way = vec2(dot(particle.velocity.xyz, right.xyz), dot(particle.velocity.xyz, up.xyz));
  float speed = length(way);
  vec2 along = speed > 0.1 ? way / speed : vec2(1.0, 0.0);
  vec2 stretch = corner.x * (radius + 0.5 * kExposure * speed) * along + corner.y * radius * vec2(-along.y, along.x);
  bool hidden = depth < 0.3 || strength <= 0.0;
  gl_Position = hidden ? vec4(0.0, 0.0, -2.0, 1.0) : project(c + stretch.x * right.xyz + stretch.y * up.xyz);
}
