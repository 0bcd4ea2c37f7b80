#include "ui/pass_tree.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "ui/panels.hpp"

namespace speculum {

namespace {

bool isSeenIn(const MirrorPath& path, const MirrorPath& parent) {
  return path.size() == parent.size() + 1 && std::equal(parent.begin(), parent.end(), path.begin());
}

// Returns the name of the pass that a pass is seen in; empty for a mirror seen directly, and for passes of no mirror.
std::string pathParent(const std::string& name) {
  const size_t last = name.rfind(" > ");
  return last != std::string::npos ? name.substr(0, last) : "";
}

// Returns the branches below `parent`, each with its own branches.
std::vector<TreeNode> nested(std::span<const TreeNode> branches, int parent = -1) {
  std::vector<TreeNode> children;
  for (const TreeNode& branch : branches) {
    if (branch.parent == parent) {
      children.push_back(branch);
      children.back().children = nested(branches, branch.pass);
    }
  }
  return children;
}

// Returns the milliseconds of a pass: the median that the Performance panel shows, because times of single frames jump.
// If that panel has no such times, or sums several passes of this name, returns the time in the timed frame.
double usualMs(const ShownFrame& frame, const PassRow& pass) {
  const bool known = !frame.history.paused() && std::ranges::count(frame.passes, pass.name, &PassRow::name) == 1;
  const double median = known ? percentile(frame.history.filledSeries(pass.name), 0.5) : std::nan("");
  return !std::isnan(median) ? median : pass.timed ? pass.gpuMs : 0.0;
}

}  // namespace

std::vector<TreeNode> passTree(std::span<const PassRow> passes, std::span<const SkippedRow> skipped,
                               std::span<const PassId> order) {
  constexpr int notListed = -2;
  const auto parentOf = [&](const MirrorPath& path) {
    const auto parent = std::ranges::find_if(
        passes, [&](const PassRow& pass) { return panels::hasTarget(pass) && isSeenIn(path, pass.path); });
    return parent == passes.end() ? notListed : static_cast<int>(parent - passes.begin());
  };
  std::vector<TreeNode> branches;
  for (const PassRow& pass : passes) {
    branches.push_back(
        {.pass = static_cast<int>(branches.size()), .parent = pass.path.empty() ? -1 : parentOf(pass.path)});
  }
  for (size_t i = 0; i < skipped.size(); ++i) {
    const int parent = parentOf(skipped[i].path);
    if (parent >= 0 && std::ranges::find(passes, skipped[i].path, &PassRow::path) == passes.end()) {
      branches[static_cast<size_t>(parent)].skipped.push_back(static_cast<int>(i));
    }
  }
  for (TreeNode& branch : branches) {
    std::ranges::stable_sort(branch.skipped, {}, [&](int i) { return skipped[static_cast<size_t>(i)].path; });
  }
  std::ranges::stable_sort(branches, {}, [&](const TreeNode& branch) {
    const PassRow& pass = passes[static_cast<size_t>(branch.pass)];
    const auto rank = std::ranges::find(order, PassId(pass)) - order.begin();
    return std::tuple(rank, pass.kind != PassKind::main, pass.path, pass.kind, pass.light, pass.instance, pass.face);
  });
  return nested(branches);
}

std::vector<TreeNode> passTree(std::span<const std::string> names) {
  std::vector<TreeNode> branches;
  for (const std::string& name : names) {
    const auto parent = std::ranges::find(names, pathParent(name));
    branches.push_back({.pass = static_cast<int>(branches.size()),
                        .parent = parent == names.end() ? -1 : static_cast<int>(parent - names.begin())});
  }
  return nested(branches);
}

std::string pathText(const std::string& name) {
  constexpr std::string_view kind = "mirror ";
  return name.starts_with(kind) ? name.substr(kind.size()) : name;
}

std::string pathEnd(const std::string& name) {
  const size_t last = name.rfind(" > ");
  return last != std::string::npos ? name.substr(last + 3) : pathText(name);
}

double restOfPasses(const ShownFrame& frame) {
  double rest = frame.timedGpuMs > 0.0 ? frame.timedGpuMs : std::nan("");
  for (const PassRow& pass : frame.passes) {
    rest -= pass.timed ? pass.gpuMs : 0.0;
  }
  return std::max(rest, 0.0);
}

std::string mirrorCost(const ShownFrame& frame, int mirror) {
  int passes = 0;
  double ms = 0.0;
  double allMs = 0.0;
  bool allTimed = true;
  double pixels = 0.0;
  bool reused = true;
  for (const PassRow& pass : frame.passes) {
    const double passMs = pass.reused ? 0.0 : usualMs(frame, pass);
    allMs += passMs;
    allTimed = allTimed && (pass.reused || passMs > 0.0);
    if (pass.kind == PassKind::mirror && pass.path.back() == mirror) {
      ++passes;
      ms += passMs;
      reused = reused && pass.reused;
      pixels += pass.areaPx;
    }
  }
  if (passes > 0) {
    std::string share;
    if (ms > 0.0 && allTimed) {
      const double percent = 100.0 * ms / allMs;
      share = (percent < 1.0 ? ", under 1" : fmt::format(", {:.0f}", percent)) + " % of all passes";
    }
    return fmt::format("{} {}, {:.0f} pixels", passes, passes == 1 ? "pass" : "passes", pixels) +
           (reused     ? ", reused"
            : ms > 0.0 ? ", " + panels::duration(ms) + " on the GPU" + share
                       : "");
  }
  const auto isOf = [&](const SkippedRow& skip) { return skip.path.back() == mirror; };
  if (std::ranges::any_of(frame.skipped, [&](const SkippedRow& skip) { return isOf(skip) && skip.byRays; })) {
    return "Drawn by rays";
  }
  const auto skipped = std::ranges::find(frame.skipped, MirrorPath{mirror}, &SkippedRow::path);
  return skipped == frame.skipped.end() ? "No pass" : "No pass: " + skipped->reason;
}

}  // namespace speculum
