// Radiance of a surface and of the background, as docs/picture.md defines them.

const float pi = 3.14159265358979;
const float halfMax = 65504.0;
const float shareMax = 65472.0;  // of what is weighted and added to another share: their sum rounds to halfMax at most

struct Surface {
  vec3 position;  // relative
  vec3 normal;    // unit, towards the viewer's side
  vec3 diffuse;
  vec3 specular;
  vec3 emission;
  float shininess;
};

vec3 safeNormalize(vec3 v) { return v * inversesqrt(max(dot(v, v), 1e-30)); }

// Of a light at `toLight` from the surface; `irradiance` is at 1 m, facing it.
vec3 lightRadiance(vec3 toLight, float radius, vec3 irradiance, Surface surface, vec3 toViewer) {
  float distance2 = dot(toLight, toLight);
  vec3 l = safeNormalize(toLight);
  float cosine = clamp(dot(surface.normal, l), 0.0, 1.0);
  if (cosine == 0.0) {
    return vec3(0.0);
  }
  vec3 brdf = surface.diffuse / pi;
  if (max(surface.specular.r, max(surface.specular.g, surface.specular.b)) > 0.0) {
    float lobe = clamp(dot(surface.normal, safeNormalize(l + toViewer)), 0.0, 1.0);
    brdf += surface.specular * ((surface.shininess + 8.0) / (8.0 * pi) * pow(max(lobe, 1e-6), surface.shininess));
  }
  // Neither infinite nor divided by an underflow: a black channel of the surface times infinity is not a number.
  float falloff = cosine / max(max(distance2, radius * radius), 1e-30);
  return min(irradiance * falloff, 1e30) * brdf;
}

vec3 surfaceRadiance(ViewData view, Surface surface) {
  vec3 toViewer = safeNormalize(-surface.position);
  vec3 radiance = surface.emission + view.ambient.rgb * surface.diffuse;
  for (uint i = 0; i < view.lightCount; ++i) {
    LightData light = lights[view.firstLight + i];
    radiance += lightRadiance(light.position - surface.position, light.radius, light.irradiance, surface, toViewer);
  }
  return radiance;
}

// Schlick, "An Inexpensive BRDF Model for Physically-based Rendering" (1994).
vec3 schlick(vec3 reflectance, float cosine) {
  float grazing = 1.0 - clamp(cosine, 0.0, 1.0);
  float grazing2 = grazing * grazing;
  return reflectance + (1.0 - reflectance) * (grazing2 * grazing2 * grazing);
}

// The direction mirrored about m, turned back above the plane if it went below.
vec3 mirrored(vec3 direction, vec3 m, vec3 planeNormal) {
  vec3 d = direction - 2.0 * dot(direction, m) * m;
  float outward = dot(d, planeNormal);
  return safeNormalize(outward < 0.0 ? d - 2.0 * outward * planeNormal : d);
}

// The layer under a mirror's reflection, or its back.
Surface mirrorLayer(vec3 position, vec3 normal, vec3 color) {
  return Surface(position, normal, color, vec3(0.0), vec3(0.0), 1.0);
}

// An object's, with what the scene replaces of its material; its texture is still to be multiplied in.
Surface objectSurface(vec3 position, vec3 normal, MaterialData material, MaterialChange change, float shininess) {
  return Surface(position, normal, change.replacesDiffuse != 0 ? change.diffuse : material.diffuse,
                 change.replacesSpecular != 0 ? change.specular : material.specular, material.emission,
                 shininess > 0.0 ? shininess : material.shininess);
}

vec3 backgroundRadiance(ViewData view, vec3 direction) {
  if (view.hasSky == 0) {
    return view.background;
  }
  float y = safeNormalize(direction).y;
  return y >= 0.0 ? mix(view.horizon.rgb, view.zenith.rgb, sqrt(y))
                  : mix(view.horizon.rgb, view.ground.rgb, min(1.0, -8.0 * y));
}

// The target is half float: past its range some drivers store infinity, and one such sample spoils a resolve.
// `disparity` is 1 / w of clip space in 1/m, 0 at infinity: by it an image is reprojected when it is shown again.
vec4 storable(vec3 radiance, float disparity) { return clamp(vec4(radiance, disparity), 0.0, halfMax); }
