// Exact ray-quadric intersection; blended with MAX, so that the nearest surface stays.
in vec3 a;
flat in vec3 b;
layout(location = 0) out float inverse_depth;
void main() {
  float ab = dot(a, b), aa = dot(a, a);
  float discriminant = ab * ab - aa * (dot(b, b) - 1.0);
  inverse_depth = discriminant > 0.0 ? aa / (ab - sqrt(discriminant)) : 0.0;
}
