#pragma once

#include <span>
#include <vector>

#include "ui/ui_model.hpp"

namespace speculum {

// A pass with what is seen in it.
struct PassNode {
  int pass = -1;             // index into UiModel::passes
  std::vector<int> skipped;  // indices into UiModel::skipped: mirrors seen in it that have no pass of their own
  std::vector<PassNode> children;
};

// The main view first, with every mirror pass below the one that it is seen in, then the passes that are no view.
// Mirrors whose parent is not listed are left out, and skipped ones likewise.
std::vector<PassNode> passTree(std::span<const UiPass> passes, std::span<const UiSkipped> skipped);

}  // namespace speculum
