#include <imgui.h>
#include <spdlog/fmt/fmt.h>
#include <spdlog/fmt/ranges.h>

#include <algorithm>

#include "ui/panels.hpp"

namespace speculum::panels {

namespace {

void fact(const char* name, const std::string& value) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  dimmedText(name);
  ImGui::TableNextColumn();
  wrappedText(value);
}

bool beginFacts(const char* id) {
  const float names = std::min(11.0f * ImGui::GetFontSize(), 0.55f * ImGui::GetContentRegionAvail().x);
  if (!ImGui::BeginTable(id, 2, ImGuiTableFlags_SizingFixedFit)) {
    return false;
  }
  ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthFixed, names);
  ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch);
  return true;
}

}  // namespace

void device(PanelContext& ui) {
  const ShownDevice& device = ui.input.device;
  const ShownFrame& frame = ui.input.frame;
  if (beginFacts("device")) {
    fact("Device", device.name);
    fact("Kind", device.kind);
    fact("Driver", device.driver);
    fact("Vulkan", device.vulkan);
    fact("Render path", device.renderPath);
    fact("Samples a pixel", fmt::format("{}", fmt::join(device.samples, ", ")));
    fact("GPU memory of this window", mebibytes(frame.deviceBytes) + " MiB");
    fact("GPU memory of the program", mebibytes(frame.usedBytes) + " MiB");
    fact("GPU memory available", mebibytes(frame.budgetBytes) + " MiB");
    fact("Validation layer",
         frame.validationMessages < 0 ? "off" : std::to_string(frame.validationMessages) + " messages");
    ImGui::EndTable();
  }
  ImGui::Separator();
  if (beginFacts("features")) {
    for (const FeatureRow& feature : device.features) {
      fact(feature.name.c_str(), (feature.present ? "" : "missing: ") + feature.about);
    }
    ImGui::EndTable();
  }
  ImGui::Separator();
  settingRows(ui, "debug.");
}

}  // namespace speculum::panels
