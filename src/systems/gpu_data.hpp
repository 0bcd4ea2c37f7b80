#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>

#include "core/buffer.hpp"

namespace speculum {

// What FrameData and TraceFrame share on the way from the scene, in double, to the buffers of a frame.

// Row `r` of a matrix, and `w`.
glm::vec4 row(const glm::dmat3& m, int r, double w);
// What a scene puts in the place of a material's colour; w: 1 if it does.
glm::vec4 replacement(const std::optional<glm::dvec3>& value);
// The normal matrix of a linear map, at unit size: shaders normalise, and a float would overflow at the extremes.
glm::dmat3 unitNormalMatrix(const glm::dmat3& linear);

// Writes `data` into a host buffer for shaders and vertex attributes, which is made anew with half as much again when
// it is too small. Throws std::runtime_error with `advice` if the device takes no buffer of that size.
void writeGrown(Device& device, Buffer& buffer, std::span<const std::byte> data, const std::string& name,
                const std::string& advice);

}  // namespace speculum
