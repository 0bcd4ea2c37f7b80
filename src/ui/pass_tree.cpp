#include "ui/pass_tree.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

#include "ui/panels.hpp"

namespace speculum {

namespace {

bool isSeenIn(const std::vector<int>& path, const std::vector<int>& parent) {
  return path.size() == parent.size() + 1 && std::equal(parent.begin(), parent.end(), path.begin());
}

PassBranch nodeOf(int pass, std::span<const PassView> passes, std::span<const SkippedView> skipped) {
  PassBranch node{.pass = pass};
  const std::vector<int>& path = passes[static_cast<size_t>(pass)].path;
  const auto isListed = [&](const std::vector<int>& mirror) {
    return std::ranges::any_of(passes, [&](const PassView& other) { return other.path == mirror; });
  };
  for (size_t i = 0; i < skipped.size(); ++i) {
    if (isSeenIn(skipped[i].path, path) && !isListed(skipped[i].path)) {
      node.skipped.push_back(static_cast<int>(i));
    }
  }
  for (size_t i = 0; i < passes.size(); ++i) {
    if (isSeenIn(passes[i].path, path)) {
      node.children.push_back(nodeOf(static_cast<int>(i), passes, skipped));
    }
  }
  return node;
}

}  // namespace

std::vector<PassBranch> passTree(std::span<const PassView> passes, std::span<const SkippedView> skipped) {
  std::vector<PassBranch> roots;
  for (size_t i = 0; i < passes.size(); ++i) {
    if (!passes[i].path.empty()) {
      continue;
    }
    const int pass = static_cast<int>(i);
    roots.push_back(passes[i].kind == PassKind::main ? nodeOf(pass, passes, skipped) : PassBranch{.pass = pass});
  }
  return roots;
}

std::string pathText(const std::string& name) {
  constexpr std::string_view kind = "mirror ";
  return name.starts_with(kind) ? name.substr(kind.size()) : name;
}

std::string pathEnd(const std::string& name) {
  const size_t last = name.rfind(" > ");
  return last != std::string::npos ? name.substr(last + 3) : pathText(name);
}

std::string pathParent(const std::string& name) {
  const size_t last = name.rfind(" > ");
  return last != std::string::npos ? name.substr(0, last) : "";
}

double restOfPasses(const FrameView& frame) {
  double rest = frame.timedGpuMs > 0.0 ? frame.timedGpuMs : std::nan("");
  for (const PassView& pass : frame.passes) {
    rest -= pass.timed ? pass.gpuMs : 0.0;
  }
  return std::max(rest, 0.0);
}

std::string mirrorCost(const FrameView& frame, int mirror) {
  int passes = 0;
  double ms = 0.0;
  double pixels = 0.0;
  bool reused = true;
  for (const PassView& pass : frame.passes) {
    if (pass.kind == PassKind::mirror && pass.path.back() == mirror) {
      ++passes;
      ms += pass.timed && !pass.reused ? pass.gpuMs : 0.0;
      reused = reused && pass.reused;
      pixels += pass.areaPx;
    }
  }
  if (passes > 0) {
    return fmt::format("{} {}, {:.0f} pixels", passes, passes == 1 ? "pass" : "passes", pixels) +
           (reused     ? ", reused"
            : ms > 0.0 ? ", " + panels::duration(ms) + " on the GPU"
                       : "");
  }
  const auto isOf = [&](const SkippedView& skip) { return skip.path.back() == mirror; };
  if (std::ranges::any_of(frame.skipped, [&](const SkippedView& skip) { return isOf(skip) && skip.byRays; })) {
    return "Drawn by rays";
  }
  const auto skipped = std::ranges::find(frame.skipped, std::vector{mirror}, &SkippedView::path);
  return skipped == frame.skipped.end() ? "No pass" : "No pass: " + skipped->reason;
}

}  // namespace speculum
