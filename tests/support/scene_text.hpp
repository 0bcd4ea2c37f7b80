#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <string>

namespace speculum::hard_cases {

// Numbers as a scene file takes them, with all their digits.
std::string text(double value);
std::string text(const glm::dvec3& v);

// writeScene with the running test's name before `name`: tests that run at the same time do not meet.
std::filesystem::path sceneFile(const std::string& name, const std::string& toml);

// Writes a model beside the scenes; they name it by file name. The same text for the same name, whichever test writes.
void writeModel(const std::string& file, const std::string& obj);

// quad.obj: 2 x 2 m in the plane z = 0 about the origin, facing +z.
void writeQuad();

}  // namespace speculum::hard_cases
