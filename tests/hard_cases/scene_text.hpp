#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <string>

namespace speculum::hard_cases {

// Numbers as a scene file takes them, with all their digits.
std::string text(double value);
std::string text(const glm::dvec3& v);

// Writes a model beside the scenes of writeScene; scenes name it by file name.
void writeModel(const std::string& file, const std::string& obj);

// quad.obj: 2 x 2 m in the plane z = 0 about the origin, facing +z.
void writeQuad();

}  // namespace speculum::hard_cases
