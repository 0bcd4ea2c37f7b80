// Shadows by rays, and light that mirrors cast onto surfaces. Needs trace.glsl.

layout(constant_id = constantShadows) const bool shadows = false;
layout(constant_id = constantCastsLight) const bool castsLight = false;
layout(constant_id = constantLightGroups) const bool asksGroups = false;  // there are more than fixedLights lights

// Returns the reflectance of a mirror at a point in trace space, with its map.
vec3 tracedMirrorReflectance(uint mirror, vec3 tracePosition, float cosine) {
  vec3 reflectance = reflectanceAt(traceMirrors[mirror].reflectance, traceMirrors[mirror].schlick, cosine);
  uint map = traceMirrors[mirror].map;
  if (map != noMap) {
    TraceTexture source = traceTextures[map];
    vec3 local = tracePosition - traceMirrors[mirror].origin;
    vec2 along = vec2(dot(local, traceMirrors[mirror].axisX), dot(local, traceMirrors[mirror].axisY));
    vec2 uv = along * traceMirrors[mirror].mapBox.xy + traceMirrors[mirror].mapBox.zw;
    reflectance *= bilinearTraced(source, withinBorder(uv, vec2(source.width, source.height)), false).rgb;
  }
  return reflectance;
}

// A light, or its image in a mirror, as it illuminates a point.
struct Incoming {
  bool arrives;
  vec3 toLight;    // from the point
  vec3 clearance;  // as LightData::clearance
  float height;    // as LightData::height
  float radius;
  vec3 irradiance;  // at 1 m, with the mirror's reflectance
  uint mirror;     // `none`: the light itself
  float crossing;  // part of the way to the light's image that leads to the mirror; 1 without a mirror
};

Incoming directLight(LightData light, vec3 position) {
  return Incoming(true, light.position - position, light.clearance, light.height, light.radius, light.irradiance, none,
                  1.0);
}

// Returns the light that a mirror casts onto a point. It arrives if the straight line to the light's image crosses the
// mirror.
Incoming bouncedLight(LightPath path, vec3 tracePosition, Skip self) {
  uint mirror = path.mirror;
  vec3 normal = mirrorTexel(mirror, 1).xyz;
  bool sameSide = path.side * dot(normal, tracePosition - mirrorTexel(mirror, 0).xyz) > 0.0;
  vec3 toLight = path.image - tracePosition;
  float crossing = meetMirror(mirror, tracePosition, toLight);
  bool arrives = sameSide && self.plane != planeOf(mirror) && crossing > 0.0 && crossing < 1.0;
  vec3 reflectance = tracedMirrorReflectance(mirror, tracePosition + crossing * toLight,
                                             abs(dot(normal, safeNormalize(toLight))));
  return Incoming(arrives, toLight, vec3(0.0), path.height, path.radius, path.irradiance * reflectance, mirror,
                  crossing);
}

Incoming incomingLight(uint i, Surface surface, vec3 tracePosition, Skip self) {
  Incoming incoming;
  if (i < view.lightCount) {
    incoming = directLight(lights[view.firstLight + i], surface.position);
  } else {
    incoming = bouncedLight(lightPaths[i - view.lightCount], tracePosition, self);
  }
  return incoming;
}

// Returns the end of a ray to a light, as a share of its length. At 1, rounding would decide whether the ray meets a
// surface on which the light lies. What a mirror near the light hides must stay hidden: `height` is the light's from
// the nearest plane of a mirror.
float lightEnd(vec3 toLight, float height) {
  return 1.0 - min(1.0 / 1048576.0, 0.25 * height / max(length(toLight), 1e-30));
}

// Says whether nothing blocks the light on its way to the point. The light of an image comes by way of the image's
// mirror.
bool unobstructed(uint i, Incoming incoming, vec3 tracePosition, Skip self, uint seed) {
  Skip skip = self;
  skip.secondPlane = incoming.mirror == none ? none : planeOf(incoming.mirror);
  vec3 origin = tracePosition;
  vec3 direction = incoming.toLight + incoming.clearance;
  bool last = incoming.mirror == none;
  float tMax = last ? lightEnd(direction, incoming.height) : incoming.crossing;
  bool hidden = false;
  for (;;) {
    Hit hit = traceRay(origin, direction, tMax, skip, true, mixedBits(seed + 2 * i + uint(last)));
    // What holds the light does not hide it. What lies nearer to the point may. Behind such a hit nothing is looked for,
    // because it lies that near to the light unless the ray runs along the surface.
    bool holdsLight = last && hit.instance != none && endsInPlane(hit, origin, direction);
    if ((hit.instance != none || hit.mirror != none) && !holdsLight) {
      hidden = true;
    }
    if (hidden || (last && !holdsLight)) {
      break;
    }
    if (holdsLight) {
      tMax = 0.99999 * hit.t;
    } else {
      origin += incoming.crossing * direction;
      LightPath path = lightPaths[i - view.lightCount];
      direction = path.light - origin;
      tMax = lightEnd(direction, path.height);
      skip = Skip(none, none, skip.secondPlane, none, 0.0);
      last = true;
    }
  }
  return !hidden;
}

// Returns the share of the light that reaches the surface: 1, 0 or, if it takes rays, below 0. Only surfaces that are
// drawn have a receiver().
float shareOf(uint i, bool isDrawn) {
#ifdef ASKS
  LightData light = lights[view.firstLight + i];
  return isDrawn && light.shadowMap != noShadowMap ? shareAt(light, receiver - light.position) : undecided;
#else
  return -1.0;
#endif
}

// The sum over the lights and light paths up to `next`.
struct LightSum {
  vec3 radiance;
  uint next;
  uint waiting;   // light or path that needs rays, not in the sum; `none`
  vec3 arriving;  // its radiance
};

void addNext(inout LightSum sum, Surface surface, vec3 toViewer, vec3 tracePosition, Skip self, bool isDrawn) {
  Incoming incoming = incomingLight(sum.next, surface, tracePosition, self);
  vec3 lit = lightRadiance(incoming.toLight, incoming.radius, incoming.irradiance, surface, toViewer);
  if (incoming.arrives && max(lit.r, max(lit.g, lit.b)) > 0.0) {
    float share = shadows && incoming.height >= 0.0 ? shareOf(sum.next, isDrawn) : 1.0;
    if (share < 0.0) {
      sum.waiting = sum.next;
      sum.arriving = lit;
    } else {
      sum.radiance += share * lit;
    }
  }
  ++sum.next;
}

// Returns surfaceRadiance() with shadows and with the lights' images in mirrors. `self` identifies the surface, and
// `seed` gives its rays their random numbers. `isDrawn`: it is the receiver of shadow_map.glsl.
// The inner loop passes over lights until one needs rays, which are followed after it: a driver that runs both sides of
// every branch, such as lavapipe, then follows no rays for the other lights.
vec3 tracedSurfaceRadiance(Surface surface, vec3 toViewer, Skip self, uint seed, bool isDrawn) {
  vec3 tracePosition = surface.position + view.traceOffset.xyz;
  uint paths = view.lightCount + (castsLight ? traceCounts.lightPaths : 0);
  LightSum sum = LightSum(surface.emission + view.ambient * surface.diffuse, 0, none, vec3(0.0));
  uint group = 0;
  uint end = asksGroups ? 0 : paths;  // of the group of lights, or of the light paths, that `next` is in
  for (;;) {
    sum.waiting = none;
    while (sum.next < paths && sum.waiting == none) {
      if (asksGroups && sum.next == end) {
        bool direct = sum.next < view.lightCount;
        end = direct ? min(sum.next + view.lightsPerGroup, view.lightCount) : paths;
        sum.next = direct && liesBelow(lightGroups[group++], surface) ? end : sum.next;
      }
      while (sum.next < end && sum.waiting == none) {
        addNext(sum, surface, toViewer, tracePosition, self, isDrawn);
      }
    }
    if (shadows && sum.waiting != none) {
      Incoming incoming = incomingLight(sum.waiting, surface, tracePosition, self);
      if (unobstructed(sum.waiting, incoming, tracePosition, self, seed)) {
        sum.radiance += sum.arriving;
      }
    }
    if (sum.next >= paths) {
      break;
    }
  }
  return bounded(sum.radiance);
}
