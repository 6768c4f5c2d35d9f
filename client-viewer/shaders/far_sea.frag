in vec4 surface;
layout(location = 0) out vec4 sea;  // inverse depth, slope x, slope y, folding
void main() { sea = vec4(gl_FragCoord.w, surface.xyz); }
