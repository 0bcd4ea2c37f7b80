#include "ui/foreign_glyphs.hpp"

#include <imgui_internal.h>
#include <spdlog/fmt/fmt.h>
#include <stb_truetype.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace speculum {

namespace {

constexpr size_t most = 4000;          // characters that are taken down
constexpr float texels = 4096 * 3000;  // of all glyphs, so that each device can have their texture

bool isOwn(ImWchar character) {
  for (const ImWchar* range = ForeignGlyphs::own(); range[0] != 0; range += 2) {
    if (range[0] <= character && character <= range[1]) {
      return true;
    }
  }
  return false;
}

// Returns the height of a line in ems; 0 without outlines that Dear ImGui reads: it asserts on files of other formats.
float lineHeight(const FontFace& font) {
  constexpr size_t header = 12;
  const std::vector<uint8_t> file = readFileIfAny(font.file).value_or(std::vector<uint8_t>());
  const int offset = file.size() < header ? -1 : stbtt_GetFontOffsetForIndex(file.data(), font.index);
  stbtt_fontinfo info;
  if (offset < 0 || stbtt_InitFont(&info, file.data(), offset) == 0) {
    return 0.0f;
  }
  int ascent = 0, descent = 0, gap = 0;
  stbtt_GetFontVMetrics(&info, &ascent, &descent, &gap);
  return std::clamp(stbtt_ScaleForMappingEmToPixels(&info, 1.0f) * static_cast<float>(ascent - descent), 0.0f, 3.0f);
}

}  // namespace

const ImWchar* ForeignGlyphs::own() {
  static constexpr ImWchar ranges[] = {0x20, 0x17f, 0x391, 0x3c9, 0x400, 0x45f, 0x2010, 0x2026, 0};
  return ranges;
}

void ForeignGlyphs::note(ImWchar character) {
  constexpr ImWchar space = 0x20;  // what comes before it controls terminals
  if (character >= space && !isOwn(character) && wanted_.size() < most) {
    wanted_.insert(character);
  }
}

void ForeignGlyphs::note(std::string_view text) {
  constexpr unsigned char firstForeign = 0xc6;  // begins U+0180
  for (const char* at = text.data(); at != text.data() + text.size();) {
    if (static_cast<unsigned char>(*at) < firstForeign) {
      ++at;
      continue;
    }
    unsigned int character = 0;
    at += ImTextCharFromUtf8(&character, at, text.data() + text.size());
    if (character <= IM_UNICODE_CODEPOINT_MAX) {
      note(static_cast<ImWchar>(character));
    }
  }
}

void ForeignGlyphs::noteNames(const UiInput& input) {
  for (const std::string& text :
       {input.message, input.status.text, input.browser.loading, input.edit.note, input.edit.proposedFile.string()}) {
    note(text);
  }
  const Scene* scene = input.edit.scene;
  if (!scene) {
    return;
  }
  const std::string edit =
      fmt::format("{} {} {} {} {} {} {}", scene->file.string(), input.edit.undo, input.edit.redo, scene->objects.size(),
                  scene->lights.size(), scene->mirrors.size(), input.browser.scenes.size());
  if (edit == edit_) {
    return;
  }
  edit_ = edit;
  const auto noteAll = [&](const auto& nodes) {
    for (const auto& node : nodes) {
      note(node.name);
    }
  };
  noteAll(scene->objects);
  noteAll(scene->lights);
  noteAll(scene->mirrors);
  noteAll(scene->bookmarks);
  noteAll(input.browser.scenes);
  note(scene->file.string());
  for (const std::filesystem::path& file : input.browser.recent) {
    note(file.string());
  }
}

void ForeignGlyphs::noteFiles(const PanelState::Files& files) {
  if (files.listed == listed_ && files.entries.size() == entries_) {
    return;
  }
  listed_ = files.listed;
  entries_ = files.entries.size();
  note(listed_.string());
  for (const std::filesystem::directory_entry& entry : files.entries) {
    note(entry.path().filename().string());
  }
}

bool ForeignGlyphs::takeNew() {
  return std::exchange(known_, wanted_.size()) != wanted_.size();
}

void ForeignGlyphs::addTo(ImFontAtlas& atlas, float pixels) {
  ranges_.clear();
  const auto fit = static_cast<size_t>(texels / (pixels * pixels));
  const std::u32string shown(wanted_.begin(), std::next(wanted_.begin(), std::min(wanted_.size(), fit)));
  if (shown.empty()) {
    return;
  }
  for (const char32_t code : shown) {
    const auto character = static_cast<ImWchar>(code);
    if (!ranges_.empty() && ranges_.back() + 1 == character) {
      ranges_.back() = character;
    } else {
      ranges_.insert(ranges_.end(), {character, character});
    }
  }
  ranges_.push_back(0);
  ImFontConfig config;
  config.MergeMode = true;
  config.OversampleH = 1;
  for (const FontFace& font : fontsFor(shown)) {
    // Dear ImGui scales a font by the height of its lines. Scripts with tall lines are to have letters of the same
    // size.
    constexpr float ownHeight = 1.164f;  // ems of DejaVu Sans
    if (const float height = lineHeight(font); height > 0.0f) {
      config.FontNo = font.index;
      atlas.AddFontFromFileTTF(font.file.string().c_str(), pixels * height / ownHeight, &config, ranges_.data());
    }
  }
}

}  // namespace speculum
