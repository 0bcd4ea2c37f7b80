#version 450
// Added to texels outside the mirror. No disparity is larger, so the sum is not above zero: MaskSystem::markOutside().

layout(location = 0) out vec4 color;

void main() { color = vec4(0.0, 0.0, 0.0, -65504.0); }
