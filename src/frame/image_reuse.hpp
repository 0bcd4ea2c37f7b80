#pragma once

#include <span>
#include <vector>

#include "frame/held_image.hpp"
#include "frame/image_content.hpp"

namespace speculum {

// Images that are to be held are rendered with a margin on each side, as wide as the motion of the last frames calls
// for but at most this part of the picture's height.
inline constexpr double largestMargin = 0.1;

// A mirror seen directly whose image is to be held.
struct HeldRequest {
  const View& view;  // that the mirror makes, without a margin
  const Projection& projection;
  std::span<const glm::dvec3> visible;  // world; the part of the mirror that is seen
  const Settings& settings;
  int interval = 1;  // frames between two images
  int order = 0;     // of the mirror's discovery, from which turns are given
};

struct HeldChoice {
  HeldImage image;     // one of an earlier frame if it serves; else this frame's, whose view has the margin
  bool moved = false;  // since the earlier image
};

// Which image the mirror shows, by the age of the one in `before`, what it covers and the settings it was drawn under.
HeldChoice chooseHeld(std::span<const HeldImage> before, const HeldRequest& request);

// By what it shows: turns an image of this frame into the earlier one if that is the same bit for bit. `main` is the
// view that both are seen in, `passes` are as for imageContent.
void keepIfUnchanged(HeldImage& image, std::span<const HeldImage> before, const ImageSurroundings& around,
                     const View& main, std::span<const PlannedPass* const> passes);

// Of `maps`, as environmentMaps() gives them, those of the frame before that serve, by reflection.skip_unchanged and
// effects.environment_interval; the others get a new serial. `around` is without maps, since a map shows none.
void keepMaps(std::vector<EnvironmentMap>& maps, std::span<const EnvironmentMap> before,
              const ImageSurroundings& around, const View& main);

// The same for the main view of a plan whose passes are known: shown again if it draws what it drew, with images that
// the frame before had already. `before` may be null.
void keepMain(FramePlan& plan, const MainImage* before, const ImageSurroundings& around);

}  // namespace speculum
