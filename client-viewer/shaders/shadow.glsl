// How much of the sun's light comes to a place, past the bodies: four texels of the map of shadow.frag, weighted.
float sun_at(sampler2D shadow_map, vec3 p) {
  vec2 uv = vec2(dot(p, shadow[0].xyz) + shadow[0].w, dot(p, shadow[1].xyz) + shadow[1].w);
  float height = dot(p, sun.xyz);
  if (any(lessThan(uv, vec2(0.01))) || any(greaterThan(uv, vec2(0.99)))) return 1.0;
  vec4 over = step(textureGather(shadow_map, uv, 0), vec4(height + shadow[2].x));
  vec2 f = fract(uv * vec2(textureSize(shadow_map, 0)) - 0.5);
  return mix(mix(over.w, over.z, f.x), mix(over.x, over.y, f.x), f.y);
}
