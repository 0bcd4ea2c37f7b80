// Finds the point at which the pixel's ray meets a mirror's plane. This is exact at every distance and angle, unlike
// interpolation over a polygon that may reach behind the eye. A pixel whose centre lies beyond the horizon is seen at
// grazing angle.

struct PlaneHit {
  vec3 ray;
  float inward;     // component of the ray along the normal, below zero
  vec3 position;    // relative
  float disparity;  // of the plane
};

// `ray`: one metre long along the view's axis.
PlaneHit planeHit(vec3 normal, float eyeDistance, vec3 ray) {
  float inward = min(dot(normal, ray), -1e-7 * length(ray));
  return PlaneHit(ray, inward, ray * (-eyeDistance / inward), disparityLength * inward / min(-eyeDistance, -1e-30));
}
