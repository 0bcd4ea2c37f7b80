#include "ui/foreign_glyphs.hpp"

#include <imgui_internal.h>
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <utility>

#include "platform/bytes.hpp"

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
  std::ifstream file(font.file, std::ios::binary);
  const auto read = [&](uint32_t offset, size_t bytes) {
    std::string data(bytes, '\0');
    file.seekg(offset);
    file.read(data.data(), static_cast<std::streamsize>(bytes));
    return file ? data : std::string();
  };
  uint32_t begin = 0;
  if (read(0, 4) == "ttcf") {
    begin = static_cast<uint32_t>(font.index) < bigEndian(read(8, 4))
                ? bigEndian(read(12 + 4 * static_cast<uint32_t>(font.index), 4))
                : UINT32_MAX;
  }
  const std::string version = read(begin, 4);
  if (version != std::string("\0\1\0\0", 4) && version != "true" && version != "OTTO") {
    return 0.0f;
  }
  const uint32_t tables = bigEndian(read(begin + 4, 2));
  bool outlines = false;
  float unitsPerEm = 0.0f, height = 0.0f;
  for (uint32_t i = 0; i < tables; ++i) {
    const uint32_t entry = begin + 12 + 16 * i;
    const std::string name = read(entry, 4);
    const uint32_t table = bigEndian(read(entry + 8, 4));
    outlines |= name == "glyf" || name == "CFF ";
    if (name == "head") {
      unitsPerEm = static_cast<float>(bigEndian(read(table + 18, 2)));
    } else if (name == "hhea") {
      const uint32_t metrics = bigEndian(read(table + 4, 4));  // above the baseline, and below it
      height = static_cast<float>(static_cast<int16_t>(metrics >> 16) - static_cast<int16_t>(metrics));
    }
  }
  return outlines && unitsPerEm > 0.0f ? std::clamp(height / unitsPerEm, 0.0f, 3.0f) : 0.0f;
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
