// An element of the slick as a square on the map of the film, four vertices an instance.
struct Disc {
  vec2 centre;      // in parts of the map
  float reach;      // of its bell, in parts of the map
  float thickness;  // um
  float water;      // volume share of water in the emulsion
  float fringe;     // to where it is drawn, in reaches
  float unused[2];
};
layout(std430, binding = 0) readonly buffer Discs { Disc discs[]; };
out vec2 corner;       // in reaches
flat out vec4 traits;  // thickness, water, reach, fringe

void main() {
  Disc disc = discs[gl_InstanceID];
  corner = disc.fringe * vec2((gl_VertexID & 1) == 0 ? -1.0 : 1.0, (gl_VertexID & 2) == 0 ? -1.0 : 1.0);
  traits = vec4(disc.thickness, disc.water, disc.reach, disc.fringe);
  gl_Position = vec4(2.0 * (disc.centre + disc.reach * corner) - 1.0, 0.5, 1.0);
}
