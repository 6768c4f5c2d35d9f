// A rigid mesh as the sun sees it.
layout(location = 0) in vec3 position;
uniform mat3 world_from_body;
uniform vec3 body_position;  // relative to the eye
out float height;            // m, along the way to the sun
void main() {
  vec3 p = world_from_body * position + body_position;
  height = dot(p, sun.xyz);
  vec2 uv = vec2(dot(p, shadow[0].xyz) + shadow[0].w, dot(p, shadow[1].xyz) + shadow[1].w);
  // depth is reversed: the greatest is nearest to the sun
  gl_Position = vec4(2.0 * uv - 1.0, clamp(0.5 + (height - shadow[2].y) * shadow[2].z, 0.0, 1.0), 1.0);
}
