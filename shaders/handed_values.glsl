// Values that are the same in a whole draw, handed on by the vertex shader: HANDED is `out` there and `in` in the
// fragment shader. lavapipe of Mesa 22.3 reads each component of a uniform buffer once for each pixel, which takes half
// of the time of a usual fragment shader. Needs interface.glsl.
const uint handedLights = 3;
layout(location = 7) flat HANDED vec4 handedAmbient;                  // w: exposure
layout(location = 8) flat HANDED vec4 handedPosition[handedLights];   // of lights; w: radius
layout(location = 11) flat HANDED vec3 handedIrradiance[handedLights];

#ifdef VERTEX
void handOnPass() {
  handedAmbient = vec4(view.ambient, view.horizon.w);
  for (uint i = 0; i < handedLights; ++i) {
    handedPosition[i] = vec4(passLights[i].position, passLights[i].radius);
    handedIrradiance[i] = passLights[i].irradiance;
  }
}
#endif
