#include "app/scene_opener.hpp"

#include <spdlog/spdlog.h>

#include "platform/files.hpp"

namespace speculum {

namespace fs = std::filesystem;

SceneOpener::SceneOpener(const Options& options, const Settings& settings) : options_(options), settings_(settings) {
  options_.sweepResults.clear();  // they belong to the first scene
}

void SceneOpener::offerRecovery() {
  if (const std::optional<fs::path>& copy = recovery_.findNewest()) {
    document_->ask(Prompt::recovery, *copy);
  }
}

// Returns the scene's folder; for a new one that of the scenes that come with the program.
fs::path SceneOpener::folderToOpen() const {
  const fs::path folder = wholePath(shownFile()).parent_path();
  return (SceneBrowser::isNew(shownFile()) ? folder.parent_path() : folder) / "";
}

void SceneOpener::ask() {
  if (!dialog_.open(folderToOpen())) {
    document_->ask(Prompt::open, folderToOpen());
  }
}

void SceneOpener::takeChosenFile() {
  const std::optional<FileDialog::Answer> answer = dialog_.poll();
  if (answer && answer->file) {
    open(*answer->file);
  } else if (answer && answer->failed && !document_->prompting()) {
    document_->ask(Prompt::open, folderToOpen());
  }
}

void SceneOpener::setProblem(const std::string& problem) {
  problem_ = problem;
  if (!problem.empty()) {
    spdlog::error("{}", problem);
  }
}

void SceneOpener::open(const fs::path& file) {
  std::error_code none;
  if (!fs::exists(file, none)) {
    return setProblem(file.string() + ": there is no such file");
  }
  if (document_->prompt() == Prompt::recovery) {
    recovery_.postpone(file);
  }
  document_->closeOpenPrompt();
  if (document_->confirmDiscard(settings_, OpenScene{file})) {
    problem_.clear();
    browser_.open(file, options_);
  }
}

void SceneOpener::openDropped(const std::vector<fs::path>& files) {
  try {
    open(SceneBrowser::choose(files));
  } catch (const InputError& error) {
    setProblem(error.what());
  }
}

void SceneOpener::cancelLoading() {
  browser_.cancelLoading();
  document_->forgetDiscard();
}

void SceneOpener::cancelPrompt() {
  if (document_->prompt() == Prompt::recovery) {
    recovery_.forget();
  }
  document_->cancelPrompt();
  if (browser_.loaded()) {
    browser_.cancelLoading();
  }
}

std::unique_ptr<LoadedScene> SceneOpener::update() {
  takeChosenFile();
  std::unique_ptr<LoadedScene> loaded;
  // Prompts for changes made while the scene was loading, too.
  if (browser_.loaded() && document_->confirmDiscard(settings_, std::nullopt)) {
    loaded = browser_.takeLoaded();
  } else if (const std::optional<std::string> error = browser_.takeError()) {
    setProblem(*error);
    document_->forgetDiscard();
  }
  browser_.updateView();
  return loaded;
}

bool SceneOpener::working() const {
  const bool waitsForAnswer = browser_.loaded() && document_->prompting();
  return (browser_.busy() && !waitsForAnswer) || dialog_.isOpen();
}

bool SceneOpener::confirmQuit() {
  const bool confirmed = document_->confirmDiscard(settings_, Quit{});
  if (confirmed && document_->prompt() != Prompt::recovery) {
    recovery_.forget();
  }
  return confirmed;
}

void SceneOpener::forgetSaved() {
  if (!document_->hasUnsaved(settings_)) {
    recovery_.forget();
  }
}

// Returns the copy, and what is wrong if it does not read back as the scene.
std::pair<fs::path, std::string> SceneOpener::keptCopy() const {
  try {
    return {document_->savedOrCopy(settings_), ""};
  } catch (const SaveError& error) {
    return {document_->savedOrCopy(settings_, ReadBack::untested), error.what()};
  }
}

void SceneOpener::keepUnsavedWork() noexcept {
  try {
    const auto [file, problem] = keptCopy();
    if (file != shownFile()) {
      recovery_.record(file, document_->prompt() == Prompt::recovery || !problem.empty());
      if (!problem.empty()) {
        spdlog::warn("the copy of unsaved changes has to be mended: {}", problem);
      }
      spdlog::warn("unsaved changes are kept in {}", file.string());
    }
  } catch (const std::exception& error) {
    spdlog::error("unsaved changes are lost: {}", error.what());
  }
}

}  // namespace speculum
