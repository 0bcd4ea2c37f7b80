#include <imgui.h>

#include "ui/panels.hpp"

namespace speculum::panels {

void loading(PanelContext& ui) {
  const BrowserView& browser = ui.view.browser;
  if (browser.loading.empty()) {
    return;
  }
  const ImGuiIO& io = ImGui::GetIO();
  const float unit = ImGui::GetFontSize();
  ImGui::SetNextWindowPos(ImVec2(0.5f * io.DisplaySize.x, io.DisplaySize.y - unit), ImGuiCond_Always,
                          ImVec2(0.5f, 1.0f));
  ImGui::SetNextWindowSize(ImVec2(26.0f * unit, 0.0f));
  if (ImGui::Begin("Loading", nullptr,
                   ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                       ImGuiWindowFlags_NoFocusOnAppearing)) {
    ImGui::Text("Loading %s", browser.loading.c_str());
    ImGui::ProgressBar(static_cast<float>(browser.loaded), ImVec2(-5.0f * unit, 0.0f));
    ImGui::SameLine();
    commandButton(ui, "Cancel", "loading.cancel", "", CancelLoading{});
  }
  ImGui::End();
}

}  // namespace speculum::panels
