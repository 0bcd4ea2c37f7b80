#include <imgui.h>
#include <imgui_internal.h>

#include <array>

#include "fuzz_support.hpp"
#include "ui/panel_dock.hpp"

namespace speculum::fuzz {

namespace {

constexpr std::array<std::pair<const char*, PanelDock::Edge>, 3> panelEdges{
    {{"Speculum", PanelDock::Edge::left}, {"Log", PanelDock::Edge::right}, {"Inspector", PanelDock::Edge::right}}};

// A context of Dear ImGui without a display.
class Context {
 public:
  Context() : context_(ImGui::CreateContext(&fonts())) { ImGui::GetIO().IniFilename = nullptr; }
  ~Context() { ImGui::DestroyContext(context_); }
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

 private:
  static ImFontAtlas& fonts() {
    static ImFontAtlas atlas;
    unsigned char* texels = nullptr;
    int width = 0;
    int height = 0;
    atlas.GetTexDataAsAlpha8(&texels, &width, &height);
    return atlas;
  }
  ImGuiContext* context_;
};

void checkWindow(const char* name, const ImVec2& display) {
  const ImRect title = ImGui::FindWindowByName(name)->TitleBarRect();
  require(
      title.Min.x <= display.x - 8.0f && title.Max.x >= 8.0f && title.Min.y <= display.y - 8.0f && title.Min.y >= 0.0f,
      "titles can be reached");
  require(title.GetWidth() >= 8.0f && title.GetWidth() <= display.x + 32.0f, "windows are as wide as can be used");
}

// Lays out panels as `text` says, and returns what is saved afterwards.
std::string savedAgain(const std::string& text) {
  PanelDock dock;
  const Context context;
  dock.remember();
  ImGui::LoadIniSettingsFromMemory(text.c_str(), text.size());
  for (const ImVec2 display : {ImVec2(900, 700), ImVec2(300, 200), ImVec2(1920, 1080)}) {
    ImGui::GetIO().DisplaySize = display;
    for (int frame = 0; frame < 2; ++frame) {
      ImGui::NewFrame();
      dock.beginFrame(20.0f, 10.0f, false);
      for (const auto& [name, edge] : panelEdges) {
        dock.begin(name, nullptr, edge, {28.0f, 20.0f});
        ImGui::End();
      }
      ImGui::Render();
    }
    for (const auto& [name, edge] : panelEdges) {
      checkWindow(name, display);
    }
  }
  return ImGui::SaveIniSettingsToMemory();
}

}  // namespace

bool checkLayout(std::string_view text) {
  const std::string saved = savedAgain(std::string(text));
  require(savedAgain(saved) == saved, "what was saved is read");
  return !saved.empty();
}

}  // namespace speculum::fuzz
