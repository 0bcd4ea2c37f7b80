#pragma once

#include <span>
#include <string>
#include <vector>

#include "ui/views.hpp"

namespace speculum {

// A pass with what is seen in it.
struct PassNode {
  int pass = -1;             // index into FrameView::passes
  std::vector<int> skipped;  // indices into FrameView::skipped: mirrors seen in it that have no pass of their own
  std::vector<PassNode> children;
};

// The main view first, with every mirror pass below the one that it is seen in, then the passes that are no view.
// Mirrors whose parent is not listed are left out, and skipped ones likewise.
std::vector<PassNode> passTree(std::span<const PassView> passes, std::span<const SkippedView> skipped);

// The last mirror of a pass's name, which says enough where its parents are in sight.
std::string pathEnd(const std::string& name);

}  // namespace speculum
