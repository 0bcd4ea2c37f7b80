#pragma once

#include <span>
#include <string>
#include <vector>

#include "ui/shown.hpp"

namespace speculum {

// A pass with the mirrors that are seen in it.
struct TreeNode {
  int pass = -1;             // index into the passes of the tree
  int parent = -1;           // index of the pass that this one is seen in; -1: none
  std::vector<int> skipped;  // indices into ShownFrame::skipped: mirrors seen in it that have no pass of their own
  std::vector<TreeNode> children;
};

// Returns the main view, with every mirror pass below the pass that it is seen in, and then the passes that are no
// view. On each level the passes of `order` come first, then the others in the order of the scene. Leaves out mirrors,
// with a pass or skipped, whose parent is not listed. A mirror whose image is reused is listed with the pass that
// rendered it, not among the skipped ones.
std::vector<TreeNode> passTree(std::span<const PassRow> passes, std::span<const SkippedRow> skipped,
                               std::span<const PassId> order = {});
// Returns a tree of passes by their names. A pass whose parent is not among the names has no parent.
std::vector<TreeNode> passTree(std::span<const std::string> names);

// Returns the last mirror in a pass's name, which is enough in a tree that shows its parents.
std::string pathEnd(const std::string& name);
// Returns all mirrors in a pass's name.
std::string pathText(const std::string& name);

// Returns the milliseconds of the timed frame that no listed pass took: for the panels, and between passes. NaN if no
// frame was timed.
double restOfPasses(const ShownFrame& frame);

// Says what the images of a mirror (index into Scene::mirrors) cost, on the screen and in other mirrors, or why it has
// none. Times are medians of the last frames.
std::string mirrorCost(const ShownFrame& frame, int mirror);

}  // namespace speculum
