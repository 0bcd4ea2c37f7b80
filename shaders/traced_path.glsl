// Computes the radiance that a surface reflects by following rays from mirror to mirror, as docs/picture.md defines it:
// for curved mirrors, and for planar ones that rays show. Needs trace.glsl, traced_light.glsl and microfacet.glsl.

layout(constant_id = constantTextureFilter) const uint textureFilter = textureBilinear;
layout(constant_id = constantRough) const bool rough = false;  // some mirror of the scene is rough
layout(constant_id = constantVertexColors) const bool vertexColors = false;  // some mesh has colors of its vertices

struct Bounce {
  Surface surface;  // relative; of a mirror, the base under the reflection
  Skip self;
  bool reflects;
  vec3 planeNormal;  // unit, towards the viewer: what is reflected stays on this side
  vec3 reflectance;
  float alpha;  // of GGX; 0: smooth
};

vec3 rippled(uint mirror, vec3 tracePosition) {
  vec3 normal = traceMirrors[mirror].normal;
  if (traceMirrors[mirror].hasRipple == 0) {
    return normal;
  }
  return rippledNormal(normal, traceMirrors[mirror].axisX, traceMirrors[mirror].axisY,
                       tracePosition - traceMirrors[mirror].origin, traceMirrors[mirror].waveNumber,
                       traceMirrors[mirror].rippleSlope,
                       vec2(traceMirrors[mirror].firstPhase, traceMirrors[mirror].secondPhase));
}

// Returns a planar mirror as it is seen along `direction`, from its front or its back, with its ripples or without.
Bounce mirrorBounce(uint mirror, vec3 tracePosition, vec3 direction, bool front, bool ripples) {
  float side = front ? 1.0 : -1.0;
  vec3 position = tracePosition - view.traceOffset.xyz;
  Bounce bounce;
  bounce.self = Skip(none, none, planeOf(mirror), none, 0.0);
  bounce.planeNormal = side * traceMirrors[mirror].normal;
  bounce.reflects = front || traceMirrors[mirror].twoSided != 0;
  bounce.alpha = traceMirrors[mirror].alpha;
  if (!bounce.reflects) {
    bounce.surface = mirrorBase(position, bounce.planeNormal, traceMirrors[mirror].backColor, length(position));
    bounce.reflectance = vec3(0.0);
    return bounce;
  }
  vec3 normal = side * (ripples ? rippled(mirror, tracePosition) : traceMirrors[mirror].normal);
  bounce.surface = mirrorBase(position, normal, traceMirrors[mirror].baseColor, length(position));
  bounce.reflectance = tracedMirrorReflectance(mirror, tracePosition, -dot(normal, direction));
  return bounce;
}

// Turns an object's surface into that of a curved mirror, if the object is one.
void applyCurvedMirror(uint instance, vec3 direction, inout Bounce bounce) {
  uint curved = traceInstances[instance].curved;
  bounce.reflects = curved != curvedNone;
  if (bounce.reflects) {
    bounce.surface = mirrorBase(bounce.surface.position, bounce.surface.normal, traceInstances[instance].baseColor,
                                bounce.surface.reach);
    float cosine = -dot(bounce.surface.normal, direction);
    bounce.reflectance = reflectanceAt(traceInstances[instance].reflectance, uint(curved == curvedSchlick), cosine);
  }
}

vec3 nearestTraced(TraceTexture source, vec2 uv, bool clamped) {
  ivec2 texel = nearestTexel(uv, ivec2(source.width, source.height), clamped);
  uvec2 halfs = traceTexels[source.firstTexel + uint(texel.y * int(source.width) + texel.x)];
  return vec3(unpackHalf2x16(halfs.x), unpackHalf2x16(halfs.y).x);
}

// Returns the color of a texture between its levels; `across` and `down` are the steps of uv from pixel to pixel.
vec3 trilinearColor(TraceTexture source, vec2 uv, bool clamped, vec2 across, vec2 down) {
  vec2 size = vec2(source.width, source.height);
  float texels = max(length(across * size), length(down * size));
  float level = clamp(log2(max(texels, 1.0)), 0.0, log2(max(size.x, size.y)));
  for (float i = 1.0; i <= level; i += 1.0) {
    source.firstTexel += source.width * source.height;
    source.width = max(source.width / 2, 1);
    source.height = max(source.height / 2, 1);
  }
  vec3 fine = bilinearTraced(source, uv, clamped).rgb;
  TraceTexture next = TraceTexture(source.firstTexel + source.width * source.height, max(source.width / 2, 1),
                                   max(source.height / 2, 1));
  return source.width * source.height > 1 ? mix(fine, bilinearTraced(next, uv, clamped).rgb, fract(level)) : fine;
}

vec3 anisotropicColor(TraceTexture source, vec2 uv, bool clamped, vec2 across, vec2 down) {
  Footprint footprint = footprintOf(across, down, vec2(source.width, source.height));
  vec3 sum = vec3(0.0);
  for (float i = 1.0; i <= footprint.count; i += 1.0) {
    sum += trilinearColor(source, uv + partOf(footprint, i), clamped, footprint.major / footprint.count, vec2(0.0));
  }
  return sum / footprint.count;
}

vec3 normalFromMesh(uint instance, vec3 n) {
  return timesDirection(traceInstances[instance].normalFromMesh, n);
}

// Returns the unit normal of a triangle of the mesh, by the winding in the model file.
vec3 facetNormal(uint instance, uint triangle) {
  vec3 a = vertexOf(instance, triangle, 0).position;
  vec3 b = vertexOf(instance, triangle, 1).position;
  vec3 c = vertexOf(instance, triangle, 2).position;
  return safeNormalize(normalFromMesh(instance, cross(b - a, c - a)));
}

// Weights of a triangle's corners at a point, and their steps to the next pixels across and down. Along rays, which
// read the first level of textures, there are no steps.
struct Weights {
  vec3 here;
  vec3 across;
  vec3 down;
};

// Returns a triangle as it is seen along `direction`, at the relative position to which the weights belong. `origin` is
// a point on the line of sight, in trace space, `sight` its direction.
Bounce objectBounce(uint instance, uint triangle, Weights weights, vec3 position, vec3 direction, vec3 origin,
                    vec3 sight) {
  TraceVertex a = vertexOf(instance, triangle, 0);
  TraceVertex b = vertexOf(instance, triangle, 1);
  TraceVertex c = vertexOf(instance, triangle, 2);
  vec3 w = weights.here;
  vec3 geometric = facetNormal(instance, triangle);
  vec3 normal = safeNormalize(normalFromMesh(instance, w.x * a.normal + w.y * b.normal + w.z * c.normal));
  bool away = dot(geometric, direction) > 0.0;
  MaterialData material = materials[traceFaces[traceInstances[instance].firstTriangle + triangle].material];
  Surface surface = objectSurface(position, away ? -normal : normal, material, traceInstances[instance].change,
                                  traceInstances[instance].shininess,
                                  traceInstances[instance].normalFromMesh[0].w + length(position));
  if (material.texture != noTexture) {
    mat3x2 corners = mat3x2(a.u, a.v, b.u, b.v, c.u, c.v);
    TraceTexture source = traceTextures[material.texture];
    vec2 uv = uvOf(instance, triangle, w, origin, sight);
    bool clamped = material.clamps != 0;
    if (textureFilter == textureTrilinear) {
      surface.diffuse *= trilinearColor(source, uv, clamped, corners * weights.across, corners * weights.down);
    } else if (textureFilter == textureAnisotropic) {
      surface.diffuse *= anisotropicColor(source, uv, clamped, corners * weights.across, corners * weights.down);
    } else {
      surface.diffuse *= textureFilter == textureNearest ? nearestTraced(source, uv, clamped)
                                                         : bilinearTraced(source, uv, clamped).rgb;
    }
  }
  if (vertexColors && material.firstColor != noColors) {
    uint corners[3] = traceFaces[traceInstances[instance].firstTriangle + triangle].vertices;
    surface.diffuse *= w.x * colorOf(material.firstColor + corners[0]).rgb +
                       w.y * colorOf(material.firstColor + corners[1]).rgb +
                       w.z * colorOf(material.firstColor + corners[2]).rgb;
  }
  Skip self = Skip(instance, triangle, none, none, nearOf(position));
  Bounce bounce = Bounce(surface, self, false, away ? -geometric : geometric, vec3(0.0), 0.0);
  applyCurvedMirror(instance, direction, bounce);
  return bounce;
}

// Returns the glow of the first glyph that the ray meets before `t`, and sets `t` to its parameter.
vec3 glyphRadiance(vec3 origin, vec3 direction, inout float t) {
  vec3 glow = vec3(0.0);
  uint end = view.firstLight + countHere(view.lightCount);
  for (uint i = view.firstLight; i < end; ++i) {
    vec3 center = lights[i].position - origin;
    float radius = lights[i].radius;
    float middle = dot(direction, center);
    vec3 offset = center - middle * direction;
    float halfChord2 = radius * radius - dot(offset, offset);
    if (lights[i].hasGlyph == 0 || halfChord2 < 0.0) {
      continue;
    }
    float halfChord = sqrt(halfChord2);
    float met = middle > halfChord ? middle - halfChord : middle + halfChord;
    if (met > 0.0 && met < t) {
      t = met;
      glow = lights[i].glow;
    }
  }
  return glow;
}

// Which random points a surface takes for its microfacets. Samples of a pixel share a lattice.
struct Draws {
  uint picture;  // pictures of a mean have other lattices
  int wanted;    // microfacets of this sample
  int share;     // number of the share of the lattice that the sample takes
  int shares;    // number of shares of the lattice
};

struct RandomPoints {
  Lattice lattice;
  uint seed;  // of the points that replace rejected ones
};

RandomPoints randomPoints(uint seed, Draws draws) {
  return RandomPoints(latticeOf(fract(recurrenceShift(seed, draws.picture)), draws.wanted * draws.shares),
                      mixedBits(seed + draws.picture * uint(draws.shares) + uint(draws.share)));
}

// Returns the points of the sample's share in several rounds, so that the first ones are evenly spread too: lavapipe
// ends loops after 65 535 iterations. Further points are independent of each other, so that rejecting some biases
// nothing.
vec2 randomPoint(RandomPoints points, Draws draws, int drawn) {
  int rounds = min(draws.wanted & -draws.wanted, 32);  // a power of two
  int perRound = draws.wanted / rounds;
  int own = drawn % perRound * rounds + drawn / perRound;
  return drawn < draws.wanted ? latticePoint(points.lattice, draws.share + own * draws.shares)
                              : randomPair(mixedBits(points.seed + uint(drawn)));
}

// Returns how many microfacets are drawn at most to find so many that stay above.
int mostMicrofacets(int wanted) { return 4 * wanted + 16; }

// Draws microfacets of `bounce`, seen along `direction`, until one faces the viewer and mirrors the ray above the
// plane. Returns false if `most` draws are used up without such a microfacet. A pixel that has not `taken` any by then
// gets the surface's own normal.
bool nextMicrofacet(Bounce bounce, vec3 direction, RandomPoints points, Draws draws, bool taken, int most,
                    inout int drawn, inout vec3 m) {
  bool found = false;
  while (!found && drawn < most) {
    bool isNormal = !rough || bounce.alpha == 0.0 || (drawn + 1 == most && !taken);
    m = isNormal ? bounce.surface.normal
                 : microfacet(bounce.surface.normal, bounce.alpha, randomPoint(points, draws, drawn));
    ++drawn;
    found = isNormal || staysAbove(direction, m, bounce.planeNormal);
  }
  return found;
}

// Returns the radiance of a surface, seen along `direction`: its base and what it reflects. A rough surface reflects
// the mean over the microfacets that `draws` describes.
//
// One loop follows all paths of a pixel, so that a pixel begins its next path while its neighbours still follow theirs.
// An iteration follows one ray and shades what it meets; the first follows none and shades the surface itself. The loop
// ends at its head: lavapipe of Mesa 22.3 goes on computing for pixels that have left a loop, and variables keep their
// values only from one iteration to the next.
vec3 tracedRadiance(Bounce surface, vec3 direction, uint seed, Draws draws) {
  int most = mostMicrofacets(draws.wanted);
  RandomPoints points = randomPoints(seed, draws);
  int drawn = 0;
  int taken = 0;
  vec3 base = vec3(0.0);
  vec3 sum = vec3(0.0);
  Bounce bounce = surface;  // where the path is, seen along `towards`
  vec3 towards = direction;
  vec3 m = vec3(0.0);  // normal about which the path is mirrored
  vec3 weight = vec3(1.0);
  uint depth = view.depth;
  uint pathSeed = seed;
  bool starts = false;  // this iteration begins the next path
  bool first = true;
  bool ends = false;
  while (!ends) {
    bool follows = !first;
    if (starts) {
      follows = nextMicrofacet(surface, direction, points, draws, taken > 0, most, drawn, m);
      taken += follows ? 1 : 0;
    }
    if (rough && starts) {
      // Without rough mirrors there is one path, and it begins with these values.
      bounce = surface;
      towards = direction;
      weight = vec3(1.0);
      depth = view.depth;
      pathSeed = points.seed + uint(drawn);
    }
    bool meets = first;
    if (follows) {
      weight *= bounce.reflectance;
      bool last = isLastBounce(depth, view.throughput * weight);
      towards = mirrored(towards, last ? bounce.surface.normal : m, bounce.planeNormal);
      ++depth;
      vec3 origin = bounce.surface.position + view.traceOffset.xyz;
      Hit hit = Hit(0.0, none, 0, vec3(0.0), none);
      vec3 glow = vec3(0.0);
      bool glows = false;
      if (!last) {
        hit = traceRay(origin, towards, infinity, bounce.self, false, mixedBits(pathSeed + depth));
        float t = hit.t;
        glow = glyphRadiance(bounce.surface.position, towards, t);
        glows = t < hit.t;
      }
      meets = !glows && (hit.instance != none || hit.mirror != none);
      if (!meets) {
        sum += weight * (glows ? glow : backgroundRadiance(towards));
      } else if (hit.mirror != none) {
        bool front = dot(traceMirrors[hit.mirror].normal, towards) < 0.0;
        bounce = mirrorBounce(hit.mirror, origin + hit.t * towards, towards, front, true);
      } else {
        bounce = objectBounce(hit.instance, triangleTexel(hit.slot, 0).w, Weights(hit.weights, vec3(0.0), vec3(0.0)),
                              bounce.surface.position + hit.t * towards, towards, origin, towards);
      }
      m = bounce.surface.normal;
      if (rough && meets && bounce.alpha > 0.0 && bounce.reflects) {
        // Each further bounce follows one microfacet that stays above, or else the mirror's own normal.
        bool found = false;
        for (int i = 0; i < mostMicrofacets(1) && !found; ++i) {
          pathSeed = mixedBits(pathSeed + 0x9e3779b9u);
          vec3 facet = microfacet(bounce.surface.normal, bounce.alpha, randomPair(pathSeed));
          found = staysAbove(towards, facet, bounce.planeNormal);
          m = found ? facet : m;
        }
      }
    }
    vec3 own = vec3(0.0);
    bool black = all(equal(bounce.surface.diffuse + bounce.surface.specular + bounce.surface.emission, vec3(0.0)));
    if (meets && !black) {
      own = tracedSurfaceRadiance(bounce.surface, -towards, bounce.self, mixedBits(pathSeed - depth), first);
      own *= bounce.reflects ? 1.0 - bounce.reflectance : vec3(1.0);
    }
    base = first ? own : base;
    sum += first ? vec3(0.0) : weight * own;
    starts = first || !meets || !bounce.reflects;
    first = false;
    ends = starts && (!surface.reflects || taken == (rough ? draws.wanted : 1) || drawn == most);
  }
  return base + sum / float(max(taken, 1));
}
