// The light that a surface of the example sends to the eye: Phong and Blinn, as docs/picture.md defines them. Needs
// view.glsl. `n` has length 1; `specular` holds Ks, and the shininess Ns.
vec3 litSurface(vec3 position, vec3 n, vec3 diffuse, vec4 specular) {
  const float pi = 3.14159265;
  vec3 v = normalize(view.eye.xyz - position);
  vec3 toLight = view.light.xyz - position;
  vec3 l = normalize(toLight);
  float highlight = (specular.w + 8.0) / (8.0 * pi) * pow(max(dot(n, normalize(l + v)), 1e-6), specular.w);
  vec3 irradiance = view.lightColor.rgb * max(dot(n, l), 0.0) / dot(toLight, toLight);
  return view.ambient.rgb * diffuse + irradiance * (diffuse / pi + specular.rgb * highlight);
}
