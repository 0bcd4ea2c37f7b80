#pragma once

#include "session/session.hpp"
#include "window/scene_editor.hpp"

namespace speculum {

// The scene that is shown as a document: its editor, unsaved changes and the prompts about them, saving.
class DocumentController {
 public:
  // Keeps a reference to the scene. Without `prompts` unsaved changes are discarded without a prompt.
  DocumentController(LoadedScene& loaded, std::span<const std::filesystem::path> shippedModels, bool prompts,
                     std::function<void()> beforeChange);

  SceneEditor& editor() { return editor_; }
  const SceneEditor& editor() const { return editor_; }

  // Says whether the scene may be replaced: true if nothing is unsaved or the user has discarded the changes. Otherwise
  // shows the prompt, and keeps the command `then` to carry out once it is answered.
  bool confirmDiscard(const Settings& settings, std::optional<Command> then);
  Prompt prompt() const { return prompt_; }
  bool prompting() const { return prompt_ != Prompt::none; }
  void forgetDiscard() { discarded_.reset(); }  // the next confirmDiscard() prompts again

  // Says whether scene or settings have unsaved changes. A copy that was kept counts as one.
  bool hasUnsaved(const Settings& settings) const;
  // Says whether the panels show an edit that could not be applied, which counts as unsaved too.
  void setRefusedEdit(bool refused) { refusedEdit_ = refused; }

  // Answers to a prompt. Each returns the command that waited for it, if any.
  std::optional<Command> save(const Settings& settings);
  std::optional<Command> saveAs(const std::filesystem::path& file, const Settings& settings, bool copyModels);
  std::optional<Command> discard(const Settings& settings);
  void askWhere();
  // Shows a prompt that proposes a file, or a folder to open one from.
  void ask(Prompt prompt, const std::filesystem::path& proposed);
  void closeOpenPrompt() { prompt_ = prompt_ == Prompt::open || prompt_ == Prompt::recovery ? Prompt::none : prompt_; }
  void cancelPrompt();

  bool savedSinceLastCall() { return std::exchange(saved_, false); }

  // Returns a file with the scene, its unsaved changes and these settings: a copy in the user's cache folder, or the
  // scene's own file if that is the same. Throws std::runtime_error if the copy cannot be written or does not read
  // back.
  std::filesystem::path savedOrCopy(const Settings& settings) const;
  // Returns the text of such a file. Throws SaveError.
  std::string text(const std::filesystem::path& file, const Settings& settings, ReadBack readBack) const;

  const std::string& note() const { return note_; }  // result of the last save, or why a model was not added
  void setNote(const std::string& note) { note_ = note; }
  // Fills everything but the overlay.
  // Returns the user's file that the scene is saved to or, if it is a copy of unsaved changes, that it is a copy of;
  // empty if there is none.
  std::filesystem::path originalFile() const;
  void fill(ShownEdit& view, const Settings& settings) const;

 private:
  struct Discarded {
    uint64_t revision = 0;
    Settings settings;
  };

  bool saveTo(const std::filesystem::path& named, const Settings& settings, bool copyModels);
  void findSaveFile();

  LoadedScene& loaded_;
  SceneEditor editor_;
  bool prompts_;
  Settings settingsAtLoad_;                        // before the user changed any
  std::optional<std::filesystem::path> saveFile_;  // none if it comes with the program or cannot be written
  bool isCopy_ = false;                            // the scene's file, made by the program
  bool isNew_ = false;                             // a model or a new scene, which has no file yet
  Prompt prompt_ = Prompt::none;
  std::filesystem::path proposed_;  // by the prompt
  std::optional<Command> afterPrompt_;
  std::string waitingText_;                       // names it
  std::optional<Discarded> discarded_;            // changes that the user discarded
  std::optional<std::filesystem::path> refused_;  // existing file that was not overwritten; a second save overwrites it
  std::string note_;
  bool saved_ = false;
  bool refusedEdit_ = false;
};

}  // namespace speculum
