in float height;
layout(location = 0) out float highest;  // m, along the way to the sun
void main() { highest = height; }
