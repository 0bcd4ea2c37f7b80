// The curve of sRGB, IEC 61966-2-1, which takes linear values of 0 .. 1. Above its straight part the power 5/12 is a
// polynomial of the fourth root, wrong by less than 1/4000 of a step of 8 bits: on CPUs, powers took most of the display
// pass. Among the polynomials that come as close, this one keeps farthest from ties of rounding: where roots are
// exact, every half float gets the code of the exact curve.
vec3 srgbEncode(vec3 x) {
  vec3 t = sqrt(sqrt(x));
  vec3 high = -0.0698053017 * t + 0.367823631;
  high = high * t - 0.851712286;
  high = high * t + 1.16581047;
  high = high * t - 1.13276541;
  high = high * t + 1.45444703;
  high = high * t + 0.124724247;
  high = high * t - 0.0585227907;
  return mix(12.92 * x, high, greaterThan(x, vec3(0.0031308)));
}
