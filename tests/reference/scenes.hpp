#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "scene/scene_state.hpp"

// Scenes and meshes assembled in memory.
namespace speculum::testing {

// Vertices of a polygon with one flat normal; appended to the mesh's last part.
Mesh polygonMesh(const std::vector<glm::dvec3>& corners, const Material& material = {});

// A sphere of radius 1 with smooth normals, 2 * rings * (rings - 1) * 2 triangles.
Mesh sphereMesh(int rings, const Material& material = {});

// A sphere with bumps whose positions are floats, so that another tracer sees the same triangles.
Mesh bumpyMesh(int rings, unsigned seed);

// Adds an object of that mesh; returns its index.
int addObject(Scene& scene, Mesh mesh, const glm::dvec3& position = glm::dvec3(0.0));

Mirror mirrorOf(const std::vector<glm::dvec3>& polygon, double reflectance = 1.0);

// A camera at `eye` looking at `target` with the given vertical field of view in degrees.
CameraSpec cameraAt(const glm::dvec3& eye, const glm::dvec3& target, double fov = 60.0);

}  // namespace speculum::testing
