// The four upright sides of a box, six vertices each.
uniform vec3 low;   // relative to the eye
uniform vec3 high;
out vec3 world;
flat out vec3 normal;
void main() {
  int side = gl_VertexID / 6;
  int corner = int[6](0, 1, 3, 0, 3, 2)[gl_VertexID % 6];
  float along = float(corner & 1), up_share = float(corner >> 1);
  bool first = (side & 1) == 0;
  if (side < 2) {
    world = vec3(mix(low.x, high.x, along), first ? low.y : high.y, mix(low.z, high.z, up_share));
    normal = vec3(0.0, 1.0, 0.0);
  } else {
    world = vec3(first ? low.x : high.x, mix(low.y, high.y, along), mix(low.z, high.z, up_share));
    normal = vec3(1.0, 0.0, 0.0);
  }
  gl_Position = project(world);
}
