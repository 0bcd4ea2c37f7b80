#pragma once

#include <imgui.h>

#include <set>
#include <string>
#include <string_view>

#include "platform/files.hpp"
#include "ui/panels.hpp"

namespace speculum {

// Characters of names beyond those of the panels' own font, and the system's fonts that have them. Fonts are looked for
// only when such a character is shown. Characters that are put together of several, or run from right to left, are
// drawn one by one.
class ForeignGlyphs {
 public:
  // Ranges of the panels' own font: Latin, Greek and Cyrillic, as Dear ImGui takes them.
  static const ImWchar* own();

  // Takes down what the text needs.
  void note(std::string_view text);
  void note(ImWchar character);
  // Takes down what names of the scene and messages need. Names of nodes are read only after an edit.
  void noteNames(const UiInput& input);
  void noteFiles(const PanelState::Files& files);  // the names in a folder, once it is listed
  // Returns true once after something new was taken down: the fonts must be made again.
  bool takeNew();
  // Adds the glyphs to the font that was added to the atlas last. The object must outlive the atlas's building.
  void addTo(ImFontAtlas& atlas, float pixels);

 private:
  std::set<ImWchar> wanted_;
  size_t known_ = 0;  // number of `wanted_` at the last takeNew()
  std::string edit_;  // stands for the state of the scene that was read last
  std::filesystem::path listed_;
  size_t entries_ = 0;  // of the folder `listed_`
  std::vector<ImWchar> ranges_;
};

}  // namespace speculum
