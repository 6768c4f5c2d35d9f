// A rigid mesh. `mirror` = 1 draws its reflection in the mean water level.
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 tint;
uniform mat3 world_from_body;
uniform vec3 body_position;  // relative to the eye
uniform float mirror;
out vec3 world;
out vec3 world_normal;
out vec3 albedo;
void main() {
  world = world_from_body * position + body_position;
  world_normal = world_from_body * normal;
  albedo = tint;
  vec3 drawn = world;
  if (mirror > 0.5) drawn.z = 2.0 * level.x - drawn.z;
  gl_Position = project(drawn);
}
