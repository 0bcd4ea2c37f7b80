#pragma once

#include <array>
#include <functional>
#include <span>
#include <string_view>

#include "image/image.hpp"
#include "settings/setting_fields.hpp"
#include "ui/panel_dock.hpp"
#include "ui/shown.hpp"

struct ImDrawList;
struct ImFontAtlas;

namespace speculum {

enum class Theme { dark, light };

// Open windows and sections of the main panel, theme and size of the panels; saved beside the layout in
// userConfigDir().
struct PanelChoices {
  bool inspector = false;
  bool scenes = false;
  bool performance = false;
  bool targets = false;
  bool device = false;
  bool log = false;
  bool accuracy = false;
  bool passes = false;
  bool viewSection = true;
  bool reflectionsSection = true;
  bool effectsSection = false;
  Theme theme = Theme::dark;
  int percent = 100;  // of the size for the monitor's scale, 50 .. 300

  bool operator==(const PanelChoices&) const = default;
};

struct PanelName {
  std::string_view name;  // in the file and on the screen
  bool PanelChoices::*open;
  const char* about = "";
};
inline constexpr std::array<PanelName, 11> rememberedPanels{
    {{"Inspector", &PanelChoices::inspector, "Selects, moves, adds and deletes objects, lights and mirrors (F2)."},
     {"Scenes", &PanelChoices::scenes, "Pictures of the scenes; a click opens one."},
     {"Performance", &PanelChoices::performance, "Times of the last frames and their passes, as graphs."},
     {"Targets", &PanelChoices::targets, "What each pass drew: color, depth and mask."},
     {"Device", &PanelChoices::device, "The GPU, its features and its memory."},
     {"Log", &PanelChoices::log, "Messages of the program and of the validation layer."},
     {"Accuracy", &PanelChoices::accuracy, "Measures the time and the error of settings, and chooses the best."},
     {"Passes", &PanelChoices::passes, "What each frame renders and what it costs, and why a mirror has no image."},
     {"View", &PanelChoices::viewSection},
     {"Reflections", &PanelChoices::reflectionsSection},
     {"Effects", &PanelChoices::effectsSection}}};
inline constexpr std::span<const PanelName> panelNames = std::span(rememberedPanels).first(8);  // windows

// State that only the panels use.
struct PanelState {
  PanelChoices choices;
  bool help = false;
  bool widgetDemo = false;            // the window that Dear ImGui brings along to show its widgets
  std::optional<glm::vec2> openedAt;  // pointer when a click opened the inspector; none once the pointer moved
  bool focusNodes = false;            // the list of nodes takes the keyboard in the next frame
  bool focusFields = false;           // the fields of the selected node take the keyboard in the next frame
  Selection fieldsOf;                 // node that the inspector showed last
  bool editing = false;               // a continued EditNode has not ended
  bool setting = false;               // the widget of the last SetSettings is held
  bool showDifference = false;
  float errorGain = 10.0f;  // factor on the errors of the difference map, of which most are small

  struct Targets {
    std::optional<MirrorPath> path;  // mirrors from the eye of the pass that is shown
    enum class Kind { color, depth, mask } kind = Kind::color;
    double zoom = 0.0;                  // pixels of the display a texel; 0: as large as fits
    double shownZoom = 1.0;             // zoom that is in use, never 0
    double halfDistance = 5.0;          // metres, see TargetDisplay
    glm::dvec2 center{0.0};             // texel in the middle
    std::optional<glm::ivec2> pointed;  // texel under the pointer
    std::optional<WindowRect> canvas;   // where the target is drawn; none while the window is closed
  } targets;

  struct Rows {
    std::vector<PassRow> passes;  // rows
    std::vector<SkippedRow> skipped;
    std::vector<PassId> order;        // of rows, by a click on a column's head; empty: the scene's
    std::optional<std::string> step;  // label of undo when the pointer came upon the rows; none after an edit
    bool held = false;                // the rows keep their places, because the pointer is on them
  } passes;

  std::array<char, 64> logFilter{};  // text that a line must contain
  LogLevel logLevel = LogLevel::info;

  // Vertices of the selected mirror while they are typed, which may not be a valid polygon yet.
  struct Polygon {
    std::vector<glm::dvec3> vertices;    // world, metres
    std::vector<glm::dvec3> taken;       // the mirror's vertices when both were last equal
    int mirror = -1;                     // index into Scene::mirrors
    std::optional<std::string> problem;  // why `vertices` are not a valid polygon: one line
  } polygon;

  // A camera that was typed and gives no view.
  struct RefusedCamera {
    CameraSpec camera;
    CameraSpec taken;  // the scene's camera meanwhile
  };
  std::optional<RefusedCamera> refusedCamera;

  const Scene* modelsOf = nullptr;             // scene that `model` was chosen for
  std::optional<std::filesystem::path> model;  // model to add next

  std::string dismissedMessage;  // message that the user dismissed

  // State of the prompts for a file.
  struct Files {
    enum class Focus { none, field, list } focus = Focus::field;  // part that takes the keyboard in the next frame
    std::filesystem::path folder;                                 // that typed names are relative to
    std::filesystem::path listed;                                 // folder whose entries are listed
    std::vector<std::filesystem::directory_entry> entries;        // of `listed`: folders, scenes and models
    std::string typed;
    std::filesystem::path marked;  // row that was clicked last
    std::string problem;           // why the typed file cannot be opened
    std::string note;              // why the last file was not saved
    size_t modelsOutside = 0;      // number of the scene's models that are neither in the listed folder nor below
  } files;
  bool copyModels = true;         // when the scene is saved into another folder
  glm::vec2 promptDisplay{0.0f};  // size of the display that a prompt was centered in

  std::vector<std::pair<std::string, PixelRect>> widgets;  // of this frame, by name
};

// Everything that a panel reads and writes while a frame is laid out.
struct PanelContext {
  const UiInput& input;
  PanelState& state;
  Settings settings;  // edited by the widgets
  UiOutput output;

  void send(Command command) { output.commands.push_back(std::move(command)); }
};

// Small pictures within the font atlas, the one texture that ImGui's Vulkan backend draws.
class Thumbnails {
 public:
  // Pictures without pixels stand for missing ones.
  void setPictures(std::vector<Image8> pictures) { pictures_ = std::move(pictures); }
  // Sets the thumbnail that stands in the picture's place, and enlarges it. Returns false if there was none and is
  // none.
  bool setPoster(const Image8& picture);

  // Packs the pictures with the fonts. Call it after the fonts are added and before the atlas is uploaded.
  void addTo(ImFontAtlas& atlas);
  // Draw a picture into a rectangle of the screen. Return false if there is no such picture.
  bool draw(ImDrawList& list, size_t picture, const glm::vec2& low, const glm::vec2& high) const;
  bool drawPoster(ImDrawList& list, const glm::vec2& low, const glm::vec2& high) const;

 private:
  std::vector<Image8> pictures_;
  Image8 poster_;
  std::vector<int> rects_;  // by picture, then of the poster: its rectangle in the atlas; -1: none
};

namespace panels {

inline constexpr const char* helpTitle = "Keys";
inline constexpr const char* inspectorTitle = "Inspector";
inline constexpr const char* statusTitle = "##status";
inline constexpr const char* dividerTitle = "##divider";  // of the window that has the labels of A | B too
// Returns a size in sizes of the font for a window that would be so large on a large display; on a small one it takes
// no more of the width than necessary and a quarter of the display. A height of 0 stays.
glm::vec2 modestEms(const glm::vec2& ems);
inline constexpr glm::vec2 inspectorEms{25.0f, 46.0f};

// The main menu bar.
void menus(PanelContext& ui);            // File, Edit and View
void frameTime(const PanelContext& ui);  // of the last frame that drew the scene
// Calls ImGui::BeginMenu, and records the menu as "menu." and the label, as menu entries are recorded.
bool menu(PanelContext& ui, const char* label, bool enabled = true);

// Sections of the main panel and contents of the windows beside it, each within the current ImGui window.
void scene(PanelContext& ui);
void splitChoice(PanelContext& ui);  // half of A | B whose settings follow, if there is A | B
void settings(PanelContext& ui);
void effects(PanelContext& ui);
void lesson(PanelContext& ui);
void lessonMenu(PanelContext& ui);
void passes(PanelContext& ui);
void gallery(PanelContext& ui, const Thumbnails& thumbnails);
void performance(PanelContext& ui);
void device(PanelContext& ui);
void log(PanelContext& ui);
void accuracy(PanelContext& ui);
bool comparesPoint(const PanelContext& ui);  // A | B can begin with the picked point
// Leaves its lower part transparent, because the renderer draws the target there.
void targets(PanelContext& ui);
bool hasTarget(const PassRow& pass);  // the Targets window can show its target

// Windows of their own.
void loading(PanelContext& ui);  // while something is loaded
void help(PanelContext& ui);
void inspector(PanelContext& ui, PanelDock& dock);
void message(PanelContext& ui, const WindowRect& picture);  // an error, until it is dismissed
// Draws a button that says what playing costs, while the animation is paused, `below` pixels over the picture's lower
// edge. Only where there is room; Space plays too.
void playOffer(PanelContext& ui, const WindowRect& picture, float below);
void prompts(PanelContext& ui);  // over all others, while a prompt is open
// The divider of A | B, which can be dragged, and a label on each side of it. Does nothing without A | B.
void divider(PanelContext& ui, const WindowRect& picture);

// Drawn over the picture, behind all windows.
void poster(const PanelContext& ui, const Thumbnails& thumbnails, const WindowRect& free);  // instead of the picture
void passOutline(const PanelContext& ui);  // around the mirror whose row is under the pointer
// Call while the pointer is on a row of a mirror, which `path` leads to: outlines the mirror, and a click selects it.
void mirrorRow(PanelContext& ui, const MirrorPath& path);
void editOverlay(const ShownOverlay& overlay, const WindowRect& picture);  // `picture`: the part that panels leave free
// Draws behind all windows, but not over the target that the Targets window shows.
void besideTarget(const PanelContext& ui, const std::function<void()>& draw);

float statusHeight();  // least height of the status line, in pixels
// Draws the status line at the lower left edge of the display, which PanelDock keeps free, up to `right`, where windows
// of the right edge begin. `width` is the main panel's, in pixels; 0 while the panel is hidden, and the line is then as
// wide as its text. Returns the line's height, in pixels; 0 if nothing is shown.
float statusLine(const ShownStatus& status, float width, float right);

// Offers to stand an object up that seems to lie on its back.
void standUpButton(PanelContext& ui, const Selection& object, const std::string& name);

// Call after each widget of a setting: records it, shows its tooltip, and adds a button at the line's end that resets
// it to the scene's value if it differs. The button is recorded as "reset." and the key.
void describe(PanelContext& ui, std::string_view key);
// Says whether Enter was pressed, but not the press that opened this window.
bool enterPressed();
// Call after a widget: gives it the keyboard's focus.
void focusItem();
// Call after a widget: shows a tooltip while the pointer is on it.
void tip(const std::string& text);
// Shows a tooltip about the last widget, but not over it: beside the window or, without room there, below or above.
void showTip(const std::string& text);
// Call after a widget: records its rectangle by name, and shows the tooltip unless it is empty.
void recordWidget(PanelContext& ui, std::string_view key, const std::string& tip = {});
// Draw rows for the settings whose keys begin with `prefix`, except those whose need is not met, and for the fields of
// a node. fieldRows() returns true if the user changed a field. Rows come from the descriptions of settings and fields.
void settingRows(PanelContext& ui, std::string_view prefix);
void settingWidget(const PanelContext& ui, const SettingField& field, Settings& settings);  // without tooltip
bool fieldRows(PanelContext& ui, SceneNode& node);
bool fieldRows(PanelContext& ui, CameraSpec& camera);
// Draws a drop-down list. Returns true if the user chose another of `names`.
bool choice(const char* label, int& index, std::span<const std::string> names);
// Draws a color as linear numbers up to `most`, as files have them, and a swatch that opens a picker. Returns true if
// the user changed it.
bool colorEdit(const char* label, glm::dvec3& linear, double most);

// Call between the widgets of a row. Continues on the next line if the next widget does not fit, which is `further`
// pixels wider than a button with this label.
void continueRow(const char* label, float further = 0.0f);
// Returns the label for a widget that needs so many pixels; if the line has no room for both, draws the label above.
std::string labelFor(const std::string& label, float width);

float textWidth(std::string_view text);                     // pixels
void figure(const std::string& text, bool dimmed = false);  // text at the right edge of its line or cell
// Sets up a table's column of figures, as wide as its head and at least `ems`, in sizes of the font. `flags`: of
// ImGuiTableColumnFlags_.
void figureColumn(const char* head, float ems, int flags = 0);
// Returns `text`, or its ends if it is wider than `room` (pixels, by default the rest of the line or cell).
std::string thatFits(const std::string& text, std::optional<float> room = {});
std::string mebibytes(uint64_t bytes);  // without the unit
std::string milliseconds(double ms);    // without the unit; "-" for NaN
std::string duration(double ms);        // "3.21 ms", "757 ms", "14.20 s"
// Draw text that is wrapped at the window's edge, but not within numbers: as it is, dimmed, in a color.
void wrappedText(const std::string& text);
void dimmedText(const std::string& text);
inline constexpr glm::vec3 errorColor{0.92f, 0.38f, 0.28f};  // display sRGB
inline constexpr glm::vec3 warningColor{0.85f, 0.60f, 0.10f};
void coloredText(const glm::vec3& color, const std::string& text);
glm::vec3 onTheme(const glm::vec3& color);  // darker on a light theme, as coloredText() shows it
// Draws an ImGui::CollapsingHeader that is open or closed as `open`, the user's choice, says, and records it as
// "section." and `key`. Returns whether it is open.
bool section(PanelContext& ui, std::string_view key, const std::string& label, bool& open);
// button() draws a button, records it and shows its tooltip; it returns true if the button is pressed. commandButton()
// sends the command then. nextButton() also continues the row.
bool button(PanelContext& ui, const char* label, std::string_view key, const std::string& tip, bool enabled = true);
void commandButton(PanelContext& ui, const char* label, std::string_view key, const std::string& tip, Command command,
                   bool enabled = true);
void nextButton(PanelContext& ui, const char* label, std::string_view key, const std::string& tip, Command command,
                bool enabled = true);

}  // namespace panels

}  // namespace speculum
