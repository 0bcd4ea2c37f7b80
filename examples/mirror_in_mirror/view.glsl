// Where a pass looks from, and what lights the scene. View in main.cpp has the same members.
layout(set = 0, binding = 0) uniform View {
  mat4 clipFromWorld;
  vec4 eye;         // world
  vec4 clipPlane;   // world: cuts away each point p with dot(clipPlane, p) < 0
  vec4 light;       // position and radius of the lamp
  vec4 lightColor;  // color times intensity, and the glow of the lamp itself
  vec4 ambient;
} view;
