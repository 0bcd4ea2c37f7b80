#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <tuple>
#include <vector>

namespace speculum {

// Numbers points from 0; equal coordinates are one point.
class PointWelder {
 public:
  struct Less {
    bool operator()(const glm::dvec3& a, const glm::dvec3& b) const {
      return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
    }
  };

  uint32_t weld(const glm::dvec3& p) {
    const auto [it, isNew] = numbers_.try_emplace(p, static_cast<uint32_t>(points_.size()));
    if (isNew) {
      points_.push_back(p);
    }
    return it->second;
  }
  const std::vector<glm::dvec3>& points() const { return points_; }  // by number

 private:
  std::map<glm::dvec3, uint32_t, Less> numbers_;
  std::vector<glm::dvec3> points_;
};

}  // namespace speculum
