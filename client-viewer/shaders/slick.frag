// The film is a mean of overlapping elements, not their sum: each tells the thickness of the whole film at its place.
// Weights are the server's bells (Wendland's C2 function), of one volume each, so that small elements tell the detail;
// beyond its bell an element still says of what oil the fringe is.
in vec2 corner;
flat in vec4 traits;  // thickness (um), water, reach, fringe (reaches)
uniform float edge;   // of the disc, in reaches
layout(location = 0) out vec4 film;  // sums of weight * thickness, the same * water, weight; largest closeness
void main() {
  float fringe = traits.w;  // where all ends
  float q = length(corner);
  float near = max(1.0 - q, 0.0), tail = max(1.0 - q / fringe, 0.0);
  float weight = (near * near * near * near * (1.0 + 4.0 * q) + 1e-3 * tail * tail) / (traits.z * traits.z);
  float closeness = q < edge ? 1.0 - 0.5 * q / edge : 0.5 * (1.0 - (q - edge) / (fringe - edge));
  film = vec4(weight * traits.x * vec2(1.0, traits.y), weight, max(closeness, 0.0));
}
