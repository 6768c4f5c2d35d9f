// Foam and oil of the front layer, summed with smooth weights: ((foam - oil) * weight, weight).
in vec3 a;
flat in vec3 b;
flat in vec2 traits;
layout(binding = 0) uniform sampler2D fluid_inverse_depth;
layout(location = 0) out vec2 attributes;
void main() {
  float ab = dot(a, b), aa = dot(a, a);
  float miss = dot(b, b) - ab * ab / aa;  // squared distance of the ray from the centre, in radii
  float front = textureLod(fluid_inverse_depth, gl_FragCoord.xy * 2.0 / fluid_size.xy, 0.0).r;
  float behind = front > 0.0 ? (ab / aa - 1.0 / front) / fluid.y : 9.0;  // in particle spacings
  float weight = max(1.0 - miss, 0.0) * exp(-0.4 * behind * behind) + 1e-4 * max(1.0 - miss, 0.0);
  attributes = vec2(traits.x * weight, weight);
}
