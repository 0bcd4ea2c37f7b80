#pragma once

#include "session/session.hpp"
#include "window/scene_editor.hpp"

namespace speculum {

// Unsaved changes of the scene that is shown, the prompts about them, and saving.
class DocumentController {
 public:
  // Keeps its references: `document` and `editor` are of the scene. Without `prompts` unsaved changes are discarded
  // without a prompt.
  DocumentController(LoadedScene& loaded, SceneDocument& document, SceneEditor& editor, bool prompts);

  // Says whether the scene may be replaced: true if nothing is unsaved or the user has discarded the changes. Otherwise
  // shows the prompt, and keeps the command `then` to carry out once the prompt is answered.
  bool confirmDiscard(const Settings& settings, std::optional<Command> then);
  Prompt prompt() const { return prompt_; }
  bool prompting() const { return prompt_ != Prompt::none; }
  void forgetDiscard() { discarded_.reset(); }  // the next confirmDiscard() prompts again

  // Says whether scene or settings have unsaved changes. A scene opened from a copy that Recovery kept counts as
  // changed.
  bool hasUnsaved(const Settings& settings) const;
  // Call with true while the panels show an edit that could not be applied. Such an edit counts as unsaved.
  void setRefusedEdit(bool refused) { refusedEdit_ = refused; }

  // Answers to a prompt. Each returns the command that waited for the answer, if there is one. If the scene's own file
  // cannot be written, save() prompts for another.
  std::optional<Command> save(const Settings& settings);
  std::optional<Command> saveAs(const std::filesystem::path& file, const Settings& settings, bool copyModels);
  std::optional<Command> discard(const Settings& settings);
  void askWhere();  // prompts for the file to save to
  // Shows a prompt that proposes a file, or a folder to open a file from.
  void ask(Prompt prompt, const std::filesystem::path& proposed);
  // Closes a prompt for a file to read.
  void closeOpenPrompt() { prompt_ = prompt_ >= Prompt::open ? Prompt::none : prompt_; }
  void cancelPrompt();

  bool savedSinceLastCall() { return std::exchange(saved_, false); }

  // Returns a file with the scene, its unsaved changes and these settings: a copy in the user's cache folder, or the
  // scene's own file if nothing is unsaved. Throws std::runtime_error if the copy cannot be written or does not read
  // back.
  std::filesystem::path savedOrCopy(const Settings& settings) const;
  // Returns the text that the scene, its unsaved changes and these settings have as `file`. Throws SaveError.
  std::string text(const std::filesystem::path& file, const Settings& settings, ReadBack readBack) const;

  const std::string& note() const { return note_; }  // result of the last save, or why a model was not added
  void setNote(const std::string& note) { note_ = note; }
  // Returns the user's file that the scene is saved to or, if the scene is a copy of unsaved changes, the file that it
  // is a copy of; empty if there is none.
  std::filesystem::path originalFile() const;
  // Fills all of `view` but the overlay.
  void fill(ShownEdit& view, const Settings& settings) const;

 private:
  struct Discarded {
    uint64_t revision = 0;
    Settings settings;
  };

  bool saveTo(const std::filesystem::path& named, const Settings& settings, bool copyModels);
  void findSaveFile();

  LoadedScene& loaded_;
  SceneDocument& document_;
  SceneEditor& editor_;
  bool prompts_;
  Settings settingsAtLoad_;                        // before the user changed any
  std::optional<std::filesystem::path> saveFile_;  // the scene's file; none: it is shipped or cannot be written
  bool isCopy_ = false;                            // the scene's file is a copy that Recovery kept
  bool isNew_ = false;                             // a model or a new scene, which has no file yet
  Prompt prompt_ = Prompt::none;
  std::filesystem::path proposed_;                // file or folder that the prompt proposes
  std::optional<Command> afterPrompt_;            // waits for the prompt's answer
  std::string waitingText_;                       // names what waits, as in "quitting"
  std::optional<Discarded> discarded_;            // changes that the user discarded
  std::optional<std::filesystem::path> refused_;  // existing file that was not overwritten; a second save overwrites it
  std::string note_;
  bool saved_ = false;  // since the last savedSinceLastCall()
  bool refusedEdit_ = false;
};

}  // namespace speculum
