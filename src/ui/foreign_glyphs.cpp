#include "ui/foreign_glyphs.hpp"

#include <imgui_internal.h>
#include <spdlog/fmt/fmt.h>

#include <utility>

namespace speculum {

namespace {

constexpr size_t most = 4000;  // characters: more might not fit the texture that a device can have

bool isOwn(ImWchar character) {
  for (const ImWchar* range = ForeignGlyphs::own(); range[0] != 0; range += 2) {
    if (range[0] <= character && character <= range[1]) {
      return true;
    }
  }
  return false;
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
  if (files.listed == listed_) {
    return;
  }
  listed_ = files.listed;
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
  for (const ImWchar character : wanted_) {
    if (!ranges_.empty() && ranges_.back() + 1 == character) {
      ranges_.back() = character;
    } else {
      ranges_.insert(ranges_.end(), {character, character});
    }
  }
  ranges_.push_back(0);
  ImFontConfig config;
  config.MergeMode = true;
  for (const FontFace& font : fontsFor({wanted_.begin(), wanted_.end()})) {
    config.FontNo = font.index;
    atlas.AddFontFromFileTTF(font.file.string().c_str(), pixels, &config, ranges_.data());
  }
}

}  // namespace speculum
