#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>

#include "edit/recovery.hpp"
#include "platform/file_dialog.hpp"
#include "window/document_controller.hpp"
#include "window/scene_browser.hpp"

namespace speculum {

// Opens scenes: asks for a file, prompts about unsaved changes first, loads in the background, and offers the copy that
// a session that failed has kept.
class SceneOpener {
 public:
  // Keeps the reference to the settings in use.
  SceneOpener(const Options& options, const Settings& settings);

  void setDocument(const SceneDocument& document, DocumentController& saving);  // call when another scene is shown
  // Lists the scene of the command line among the recent ones, and prompts for the newest copy of unsaved changes, if
  // there is one.
  void beginSession();

  // Asks for a file to open: by the desktop's dialog, if there is one that can be started, else by a prompt.
  void ask();
  void ask(Prompt prompt);  // in the window itself
  void open(const OpenScene& wanted);
  void openDropped(const std::vector<std::filesystem::path>& files);
  void cancelLoading();
  void cancelPrompt();
  std::optional<Command> discard();  // as DocumentController::discard, or deletes the copy that was offered
  // Call once a frame. Returns a scene to show when it is loaded and no unsaved changes prevent that, else null.
  std::unique_ptr<LoadedScene> update();
  bool working() const;  // update() has work left although nothing happens

  bool confirmQuit();  // as DocumentController::confirmDiscard; then deletes this window's copy
  void forgetSaved();  // call after saving: the copy of saved changes is not offered again
  using Clock = std::chrono::steady_clock;
  // Keeps unsaved changes in a copy that the next start offers: a second after a change or, if that is longer, ten
  // times what the last copy took. Call it often. Does nothing with --frames.
  void keepChanges(Clock::time_point now) noexcept;
  // Keeps unsaved changes in such a copy at once, and logs where.
  void keepUnsavedWork() noexcept;

  const std::optional<size_t>& lesson() const { return lesson_; }  // that the scene was opened for
  SceneBrowser& browser() { return browser_; }
  const SceneBrowser& browser() const { return browser_; }
  const std::string& problem() const { return problem_; }  // with the last scene; empty: none
  void setProblem(const std::string& problem);             // logs it too

 private:
  std::filesystem::path keepCopy();
  void forgetCopies();
  const std::filesystem::path& shownFile() const { return document_->scene().file; }
  std::filesystem::path folderToOpen() const;
  void takeChosenFile();

  Options options_;
  const Settings& settings_;
  const SceneDocument* document_ = nullptr;
  DocumentController* saving_ = nullptr;
  SceneBrowser browser_;
  FileDialog dialog_;
  std::optional<size_t> lesson_;  // OpenScene::lesson of the scene that is loading or was loaded
  Recovery recovery_;
  std::string problem_;
  std::optional<std::pair<uint64_t, Settings>> seen_;  // revision and settings that keepChanges() saw last
  std::optional<Clock::time_point> copyDue_;           // none: the copy has all changes
  Clock::duration copyInterval_{};                     // from a change to its copy, if longer than a second
  bool copyFailed_ = false;
};

}  // namespace speculum
