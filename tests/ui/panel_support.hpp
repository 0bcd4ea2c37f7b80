#pragma once

#include <imgui.h>
#include <imgui_internal.h>

#include "picture_support.hpp"
#include "scene/scene_loader.hpp"
#include "test_headers.hpp"
#include "ui/panel_windows.hpp"
#include "user_folders.hpp"

namespace speculum::testing_support {

// Lays the panels out without a window, a GPU or a display; a pointer and keys act on them, and their commands are
// collected.
class PanelTest : public testing::Test {
 protected:
  PanelTest() {
    scene_ = loadScene(sceneFile("facing_mirrors"));
    browser_.scenes = {{"one", "One", "/scenes/one.toml"}, {"two", "", "/scenes/two.obj"}};
    edit_.scene = &scene_;
    start();
  }
  ~PanelTest() override { stop(); }

  // Begins a session of the program, with the layout that the last one left.
  void start() {
    windows_ = std::make_unique<PanelWindows>();
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    iniFile_ = (config_.path() / "layout.ini").string();
    io.IniFilename = nullptr;
    io.DisplaySize = {900.0f, 700.0f};
    io.DeltaTime = 1.0f / 60.0f;
    io.ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
    io.ConfigWindowsMoveFromTitleBarOnly = true;
    io.ConfigDragClickToInputText = true;
    unsigned char* texels = nullptr;
    int width = 0;
    int height = 0;
    io.Fonts->GetTexDataAsAlpha8(&texels, &width, &height);
#if IMGUI_VERSION_NUM < 18700
    for (int i = 0; i < ImGuiKey_COUNT; ++i) {
      io.KeyMap[i] = i;
    }
#endif
    windows_->rememberLayout();
    const std::string layout = readTextIfAny(iniFile_);
    ImGui::LoadIniSettingsFromMemory(layout.data(), layout.size());
    run(4);
  }
  void stop() {
    if (windows_) {
      size_t bytes = 0;
      const char* layout = ImGui::SaveIniSettingsToMemory(&bytes);
      std::ofstream(iniFile_) << std::string_view(layout, bytes);
      ImGui::DestroyContext();
      windows_.reset();
    }
  }

  void restart() {
    stop();
    start();
  }
  void resize(float width, float height) {
    ImGui::GetIO().DisplaySize = {width, height};
    run(5);
  }

  const UiOutput& run(int frames = 1) {
    for (int i = 0; i < frames; ++i) {
      ImGui::NewFrame();
      const UiInput input{.frame = frame_,
                          .device = device_,
                          .browser = browser_,
                          .settings = settings_,
                          .sceneSettings = sceneSettings_,
                          .camera = camera_,
                          .playback = playback_,
                          .edit = edit_,
                          .accuracy = accuracy_,
                          .split = split_,
                          .status = status_,
                          .log = log_,
                          .message = message_};
      output_ = windows_->build(input);
      ImGui::Render();
      for (const Command& command : output_.commands) {
        commands_.push_back(command);
        if (const auto* set = std::get_if<SetSettings>(&command)) {
          settings_ = set->settings;
        }
        const auto* edit = std::get_if<EditNode>(&command);
        if (edit && appliesEdits_) {
          scene_.mirrors.at(static_cast<size_t>(edit_.selected.index)) = std::get<Mirror>(edit->node);
        }
      }
    }
    return output_;
  }

  // Says whether the panels show the text, whose spaces do not count, once what has changed is laid out.
  bool shows(std::string text) {
    run(3);
    std::erase(text, ' ');
    return contains(shownText(), text);
  }
  struct DrawnGlyph {
    char letter;
    float lineTop;  // the top of its line of text, in pixels of the display
    int vertex;     // index of its first vertex
  };
  // Returns the letters of a list in the order of drawing, without spaces.
  static std::vector<DrawnGlyph> glyphsOf(const ImDrawList& list) {
    std::map<std::pair<float, float>, const ImFontGlyph*> glyphs;  // by the corner of their picture
    for (const ImFontGlyph& glyph : ImGui::GetFont()->Glyphs) {
      glyphs[{glyph.U0, glyph.V0}] = &glyph;
    }
    std::vector<DrawnGlyph> found;
    const ImVector<ImDrawVert>& vertices = list.VtxBuffer;
    for (int k = 0; k + 3 < vertices.Size; ++k) {
      const auto at = glyphs.find({vertices[k].uv.x, vertices[k].uv.y});
      if (at != glyphs.end() && at->second->U1 == vertices[k + 2].uv.x && at->second->V1 == vertices[k + 2].uv.y &&
          at->second->U0 != at->second->U1) {
        const ImFontGlyph& glyph = *at->second;
        found.push_back({static_cast<char>(glyph.Codepoint), vertices[k].pos.y - glyph.Y0, k});
        k += 3;
      }
    }
    return found;
  }
  // Returns the draw lists of the last frame.
  static std::vector<const ImDrawList*> drawLists() {
    std::vector<const ImDrawList*> lists;
    for (int i = 0; i < ImGui::GetDrawData()->CmdListsCount; ++i) {
      lists.push_back(ImGui::GetDrawData()->CmdLists[i]);
    }
    return lists;
  }
  // Returns the letters of the last frame whose lines begin below `top`.
  static std::string shownText(float top = -INFINITY) {
    std::string text;
    for (const ImDrawList* list : drawLists()) {
      for (const DrawnGlyph& glyph : glyphsOf(*list)) {
        if (glyph.lineTop > top) {
          text += glyph.letter;
        }
      }
    }
    return text;
  }
  // Returns the texts of the last frame that overlap another one's height but do not stand on its line, in one window.
  // Numbers alone do not count, because the ticks of a plot stand anywhere.
  static std::string textsOffTheirLine() {
    std::string found;
    for (const ImDrawList* list : drawLists()) {
      std::map<float, std::string> lines;  // by their top
      for (const DrawnGlyph& glyph : glyphsOf(*list)) {
        lines[glyph.lineTop] += glyph.letter;
      }
      std::erase_if(lines, [](const auto& line) {
        return std::ranges::none_of(line.second, [](unsigned char c) { return std::isalpha(c); });
      });
      for (auto line = lines.begin(); line != lines.end() && std::next(line) != lines.end(); ++line) {
        const auto& [top, text] = *std::next(line);
        if (top - line->first < 0.8f * ImGui::GetFontSize()) {
          found += "'" + line->second + "' and '" + text + "'; ";
        }
      }
    }
    return found;
  }
  // Returns the texts of the last frame that a column's or a window's side cuts.
  static std::string cutTexts() {
    std::string found;
    for (const ImDrawList* list : drawLists()) {
      for (const ImDrawCmd& command : list->CmdBuffer) {
        const auto first = list->IdxBuffer.begin() + command.IdxOffset;
        for (const DrawnGlyph& glyph : glyphsOf(*list)) {
          const bool drawnHere = std::find(first, first + command.ElemCount, glyph.vertex) != first + command.ElemCount;
          const ImVec4& clip = command.ClipRect;
          const ImVec2& corner = list->VtxBuffer[glyph.vertex].pos;
          const bool inSight = corner.y >= clip.y && corner.y < clip.w;
          if (drawnHere && inSight && (corner.x < clip.x || list->VtxBuffer[glyph.vertex + 2].pos.x > clip.z)) {
            found += glyph.letter;
          }
        }
      }
    }
    return found;
  }
  // Returns the tooltip that is shown; null if there is none.
  static const ImGuiWindow* tooltip() {
    const auto& windows = ImGui::GetCurrentContext()->Windows;
    const auto shown = std::ranges::find_if(windows, [](const ImGuiWindow* window) {
      return window->Active && (window->Flags & ImGuiWindowFlags_Tooltip) != 0;
    });
    return shown == windows.end() ? nullptr : *shown;
  }

  // Find a widget by its name, once what has changed is laid out.
  bool has(const std::string& name) {
    return find(name) != nullptr;
  }
  PixelRect widget(const std::string& name) {
    const PixelRect* rect = find(name);
    EXPECT_TRUE(rect) << "no widget " << name;
    return rect ? *rect : PixelRect{};
  }
  void moveTo(double x, double y) {
    ImGui::GetIO().MousePos = {static_cast<float>(x), static_cast<float>(y)};
    run(2);
  }
  void hover(const std::string& name, double part = 0.5) {
    const PixelRect rect = widget(name);
    moveTo(rect.x + rect.width * part, rect.y + rect.height / 2.0);
  }
  void hold(bool down) {
    ImGui::GetIO().MouseDown[0] = down;
    run(2);
  }
  void press() {
    hold(true);
    hold(false);
  }
  // Clicks on the widget, at a part of its width, and returns the commands that this makes.
  std::vector<Command> click(const std::string& name, double part = 0.5) {
    hover(name, part);
    commands_.clear();
    press();
    return commands_;
  }
  // Opens or closes a window.
  void toggle(const std::string& window) {
    click("panel." + window, 0.1);
    run(3);
  }
  // Presses, moves, releases.
  void dragFrom(double x, double y, double dx, double dy = 0.0) {
    moveTo(x, y);
    const ImVec2 from = ImGui::GetIO().MousePos;
    commands_.clear();
    hold(true);
    for (int i = 1; i <= 4; ++i) {
      moveTo(from.x + dx * i / 4, from.y + dy * i / 4);
    }
    hold(false);
  }
  // Drags from a part of the widget's width.
  void drag(const std::string& name, double part, double dx, double dy = 0.0) {
    const PixelRect rect = widget(name);
    dragFrom(rect.x + rect.width * part, rect.y + rect.height / 2.0, dx, dy);
  }
  // Opens a prompt about a file, or with Prompt::none closes it.
  void ask(Prompt prompt, const std::filesystem::path& file = {}) {
    edit_.prompt = prompt;
    edit_.proposedFile = file;
    run(4);
  }
  void wheel(double notches) {
    ImGui::GetIO().MouseWheel = static_cast<float>(notches);
    run(3);
  }
  void type(const std::string& text) {
    ImGui::GetIO().AddInputCharactersUTF8(text.c_str());
    run(2);
  }
#if IMGUI_VERSION_NUM < 18700
  static void holdShift(bool down) {
    ImGui::GetIO().KeyShift = down;
  }
  static void holdControl(bool down) {
    ImGui::GetIO().KeyCtrl = down;
  }
  static void holdAlt(bool down) {
    ImGui::GetIO().KeyAlt = down;
  }
#else
  static void holdShift(bool down) {
    ImGui::GetIO().AddKeyEvent(ImGuiMod_Shift, down);
  }
  static void holdControl(bool down) {
    ImGui::GetIO().AddKeyEvent(ImGuiMod_Ctrl, down);
  }
  static void holdAlt(bool down) {
    ImGui::GetIO().AddKeyEvent(ImGuiMod_Alt, down);
    ImGui::GetIO().AddKeyEvent(ImGuiKey_LeftAlt, down);
  }
#endif
  void setFocused(bool focused) {
    windows_->setFocused(focused);
    ImGui::GetIO().AddFocusEvent(focused);
    run();
  }
  void tap(ImGuiKey key) {
    for (const bool down : {true, false}) {
#if IMGUI_VERSION_NUM < 18700
      ImGui::GetIO().KeysDown[key] = down;
#else
      ImGui::GetIO().AddKeyEvent(key, down);
#endif
      run(2);
    }
  }

  // Returns the only command of that kind among the last ones.
  template <typename Kind>
  const Kind& only() const {
    static const Kind none{};
    const Kind* found = nullptr;
    for (const Command& command : commands_) {
      if (const Kind* match = std::get_if<Kind>(&command)) {
        EXPECT_FALSE(found) << "more than one";
        found = match;
      }
    }
    EXPECT_TRUE(found) << "no such command";
    return found ? *found : none;
  }
  // Clicks on the widget and returns the only command of that kind.
  template <typename Kind>
  const Kind& clickFor(const std::string& name, double part = 0.5) {
    click(name, part);
    return only<Kind>();
  }
  template <typename Kind>
  bool sent() const {
    return std::ranges::any_of(commands_, [](const Command& command) { return std::holds_alternative<Kind>(command); });
  }

  UserFolders config_{"XDG_CONFIG_HOME"};
  std::string iniFile_;
  Scene scene_;
  ShownFrame frame_;
  ShownDevice device_;
  ShownScenes browser_;
  Settings settings_;
  Settings sceneSettings_;
  ShownCamera camera_;
  ShownPlayback playback_;
  ShownEdit edit_;
  ShownAccuracy accuracy_;
  ShownSplit split_;
  ShownStatus status_;
  LogHistory log_;
  std::string message_;
  std::unique_ptr<PanelWindows> windows_;
  UiOutput output_;  // of the last frame
  std::vector<Command> commands_;
  bool appliesEdits_ = false;  // EditNode commands change the selected mirror

 private:
  const PixelRect* find(const std::string& name) {
    run(3);
    const auto& widgets = windows_->state().widgets;
    const auto known = std::ranges::find_if(widgets, [&](const auto& widget) { return widget.first == name; });
    return known == widgets.end() ? nullptr : &known->second;
  }
};

}  // namespace speculum::testing_support
