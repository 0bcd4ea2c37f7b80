// Shadows, and light by way of mirrors that cast it. Needs trace.glsl.

layout(constant_id = 3) const bool shadows = false;
layout(constant_id = 4) const bool castsLight = false;
layout(constant_id = 5) const bool perSample = false;  // one invocation for each sample, and rays through it

// A light, or its image in a mirror, as it illuminates a point.
struct Incoming {
  vec3 toLight;  // from the point
  float radius;
  vec3 irradiance;  // at 1 m, with the mirror's reflectance
  bool castsShadow;
  int legs;  // straight lines on the way; 0: no light arrives
  vec3 origin[2];  // trace space
  vec3 direction[2];
  float tMax[2];
  Skip skip[2];
};

vec3 mirrorReflectance(uint mirror, float cosine) {
  return reflectanceAt(traceMirrors[mirror].reflectance, traceMirrors[mirror].schlick, cosine);
}

Incoming directLight(LightData light, vec3 position, vec3 tracePosition, Skip self) {
  Incoming incoming;
  incoming.toLight = light.position - position;
  incoming.radius = light.radius;
  incoming.irradiance = light.irradiance;
  incoming.castsShadow = light.castsShadow != 0;
  incoming.legs = 1;
  incoming.origin[0] = tracePosition;
  incoming.direction[0] = incoming.toLight;
  incoming.tMax[0] = 1.0;
  incoming.skip[0] = self;
  incoming.origin[1] = tracePosition;
  incoming.direction[1] = incoming.toLight;
  incoming.tMax[1] = 1.0;
  incoming.skip[1] = self;
  return incoming;
}

// Returns the light that reaches the point by way of a mirror, if the straight line to the light's image crosses the
// mirror.
Incoming mirroredLight(LightPath path, vec3 tracePosition, Skip self) {
  Incoming incoming;
  uint mirror = path.mirror;
  vec3 normal = traceMirrors[mirror].normal;
  float pointHeight = dot(normal, tracePosition - traceMirrors[mirror].origin);
  float lightHeight = dot(normal, path.light - traceMirrors[mirror].origin);
  bool sameSide = pointHeight > 0.0 ? lightHeight > 0.0
                                    : traceMirrors[mirror].twoSided != 0 && pointHeight < 0.0 && lightHeight < 0.0;
  incoming.toLight = path.image - tracePosition;
  float crossing = meetMirror(mirror, tracePosition, incoming.toLight);
  bool arrives = sameSide && self.mirror != mirror && crossing > 0.0 && crossing < 1.0;
  vec3 bounce = tracePosition + crossing * incoming.toLight;
  incoming.radius = path.radius;
  incoming.irradiance =
      path.irradiance * mirrorReflectance(mirror, abs(dot(normal, safeNormalize(incoming.toLight))));
  incoming.castsShadow = path.castsShadow != 0;
  incoming.legs = arrives ? 2 : 0;
  incoming.origin[0] = tracePosition;
  incoming.direction[0] = incoming.toLight;
  incoming.tMax[0] = crossing;
  incoming.skip[0] = Skip(self.instance, self.triangle, self.mirror, mirror, self.near);
  incoming.origin[1] = bounce;
  incoming.direction[1] = path.light - bounce;
  incoming.tMax[1] = 1.0;
  incoming.skip[1] = Skip(none, none, mirror, none, 0.0);
  return incoming;
}

bool unobstructed(Incoming incoming) {
  for (int leg = 0; leg < incoming.legs; ++leg) {
    Hit hit = traceRay(incoming.origin[leg], incoming.direction[leg], incoming.tMax[leg], incoming.skip[leg], true);
    if (hit.instance != none || hit.mirror != none) {
      return false;
    }
  }
  return true;
}

// Returns surfaceRadiance() with shadows and with the lights' images in mirrors. `self` identifies the surface.
vec3 tracedSurfaceRadiance(Surface surface, vec3 toViewer, Skip self) {
  vec3 tracePosition = surface.position + view.traceOffset.xyz;
  uint paths = view.lightCount + (castsLight ? traceCounts.lightPaths : 0);
  vec3 radiance = surface.emission + view.ambient * surface.diffuse;
  for (uint i = 0; i < paths; ++i) {
    Incoming incoming;
    if (i < view.lightCount) {
      incoming = directLight(lights[view.firstLight + i], surface.position, tracePosition, self);
    } else {
      incoming = mirroredLight(lightPaths[i - view.lightCount], tracePosition, self);
    }
    if (incoming.legs == 0) {
      continue;
    }
    vec3 arriving = lightRadiance(incoming.toLight, incoming.radius, incoming.irradiance, surface, toViewer);
    bool dark = max(arriving.r, max(arriving.g, arriving.b)) <= 0.0;
    if (!dark && (!shadows || !incoming.castsShadow || unobstructed(incoming))) {
      radiance += arriving;
    }
  }
  return bounded(radiance);
}
