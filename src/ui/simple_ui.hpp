#pragma once

#include <memory>

#include "core/renderer.hpp"
#include "ui/look.hpp"
#include "ui/panel_choices.hpp"
#include "ui/panel_dock.hpp"
#include "ui/thumbnails.hpp"
#include "ui/ui_model.hpp"

namespace speculum {

// The panel over the picture, in Dear ImGui. One instance a process; the only place that knows ImGui.
class SimpleUI {
 public:
  // Installs its input callbacks behind those that the window has.
  SimpleUI(Renderer& renderer, Window& window);
  ~SimpleUI();
  SimpleUI(const SimpleUI&) = delete;
  SimpleUI& operator=(const SimpleUI&) = delete;

  // Of UiModel::scenes, from the next frame on.
  void setThumbnails(std::vector<Image8> pictures);
  // Lays out this frame's panel and applies input to the model. Call it once a frame, also when nothing is drawn.
  void build(UiModel& model);
  void record(const PassScope& scope);

  // Whether what the pointer does there is the panel's: one of its windows is there, or it holds one of its widgets.
  // Screen coordinates of the window.
  bool takesPointer(double x, double y) const;
  bool holdsEscape() const;       // ImGui closes something at Esc by itself, or lets go of it
  bool holdsWidget() const;       // one is being dragged, pressed or typed into
  bool closeTop(UiModel& model);  // the window on top, but for the panel itself; false if there is none
  bool wantsKeyboard() const;     // a text field is being edited
  bool navigating() const;        // a widget is chosen by keyboard or gamepad
  bool wantsFrames() const;       // something of the panel changes by itself: a text cursor, a button that is held
  bool visible() const { return visible_; }
  void setVisible(bool visible) { visible_ = visible; }

 private:
  void initVulkan();
  void prepareLook();
  void buildPanel(UiModel& model);
  void buildWindows(UiModel& model);
  void panelChoices(UiModel& model);
  void themeChoice(UiModel& model);
  void presentMode(UiModel& model);
  void buildTargets(UiModel& model);

  struct Context {
    Context();
    ~Context();
    std::string iniFile;
  };
  struct Backend;

  Renderer& renderer_;
  Window& window_;
  PanelDock dock_;  // outlives the context, which saves it
  Context context_;
  Theme theme_;
  Theme chosenTheme_ = theme_;
  PanelChoices choices_;
  PanelChoices savedChoices_ = choices_;
  float scale_ = 0.0f;  // of fonts and sizes: the monitor's content's and the person's; 0: nothing is made yet
  int pendingPercent_ = choices_.percent;  // while its slider is held
  Thumbnails thumbnails_;
  DescriptorPoolHandle pool_;
  std::unique_ptr<Backend> backend_;
  float statusWidth_ = 0.0f;  // pixels
  bool visible_ = true;
  bool showDemoWindow_ = false;
};

}  // namespace speculum
