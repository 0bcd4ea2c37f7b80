#include "window/scene_opener.hpp"

#include <spdlog/spdlog.h>

#include <ctime>

#include "platform/files.hpp"
#include "scene/model_files.hpp"

namespace speculum {

namespace fs = std::filesystem;

SceneOpener::SceneOpener(const Options& options, const Settings& settings) : options_(options), settings_(settings) {
  options_.sweepResults.clear();  // a sweep belongs to the first scene
}

void SceneOpener::setDocument(const SceneDocument& document, DocumentController& saving) {
  document_ = &document;
  saving_ = &saving;
  seen_.reset();
  if (options_.frames == 0) {
    recovery_.setScene(shownFile());
  }
}

void SceneOpener::beginSession() {
  if (!options_.scene.empty()) {
    browser_.remember(shownFile());
  }
  if (const fs::path copy = recovery_.findNewest(); !copy.empty()) {
    saving_->ask(Prompt::recovery, copy);
  }
}

// Returns the folder of the scene's file, or of the file that it is a copy of; for a new scene the folder of the
// shipped scenes.
fs::path SceneOpener::folderToOpen() const {
  fs::path file = shownFile();
  if (Recovery::isCopy(file)) {
    file = saving_->originalFile().empty() ? SceneBrowser::newScene() : saving_->originalFile();
  }
  const fs::path folder = wholePath(file).parent_path();
  return (SceneBrowser::isNew(file) ? folder.parent_path() : folder) / "";
}

void SceneOpener::ask() {
  if (!dialog_.open(folderToOpen(), {"Scenes and models", "*.toml " + modelPatterns()})) {
    ask(Prompt::open);
  }
}

void SceneOpener::ask(Prompt prompt) {
  saving_->ask(prompt, folderToOpen());
}

void SceneOpener::takeChosenFile() {
  const std::optional<FileDialog::Answer> answer = dialog_.poll();
  if (answer && answer->file) {
    open({*answer->file});
  } else if (answer && answer->failed && !saving_->prompting()) {
    ask(Prompt::open);
  }
}

void SceneOpener::setProblem(const std::string& problem) {
  problem_ = problem;
  if (!problem.empty()) {
    spdlog::error("{}", problem);
  }
}

void SceneOpener::open(const OpenScene& wanted) {
  std::error_code none;
  if (!fs::exists(wanted.file, none)) {
    browser_.forgetRecent(wanted.file);
    return setProblem(wanted.file.string() + ": there is no such file");
  }
  saving_->closeOpenPrompt();
  if (saving_->confirmDiscard(settings_, wanted)) {
    problem_.clear();
    lesson_ = wanted.lesson;
    browser_.open(wanted.file, options_);
  }
}

void SceneOpener::openDropped(const std::vector<fs::path>& files) {
  try {
    open({SceneBrowser::choose(files)});
  } catch (const InputError& error) {
    setProblem(error.what());
  }
}

void SceneOpener::cancelLoading() {
  browser_.cancelLoading();
  saving_->forgetDiscard();
}

void SceneOpener::cancelPrompt() {
  if (saving_->prompt() == Prompt::recovery) {
    recovery_.postpone();
  }
  saving_->cancelPrompt();
  if (browser_.loaded()) {
    browser_.cancelLoading();
  }
}

std::optional<Command> SceneOpener::discard() {
  if (saving_->prompt() == Prompt::recovery) {
    recovery_.discardOffer();
    saving_->cancelPrompt();
    return std::nullopt;
  }
  return saving_->discard(settings_);
}

std::unique_ptr<LoadedScene> SceneOpener::update() {
  takeChosenFile();
  std::unique_ptr<LoadedScene> loaded;
  // Prompts for changes made while the scene was loading, too.
  if (browser_.loaded() && saving_->confirmDiscard(settings_, std::nullopt)) {
    loaded = browser_.takeLoaded();
  } else if (const std::optional<std::string> error = browser_.takeError()) {
    setProblem(*error);
    saving_->forgetDiscard();
  }
  browser_.updateView();
  return loaded;
}

bool SceneOpener::working() const {
  const bool waitsForAnswer = browser_.loaded() && saving_->prompting();
  return (browser_.busy() && !waitsForAnswer) || dialog_.isOpen();
}

bool SceneOpener::confirmQuit() {
  const bool confirmed = saving_->confirmDiscard(settings_, Quit{});
  if (confirmed && options_.frames == 0) {
    forgetCopies();
  }
  return confirmed;
}

void SceneOpener::forgetSaved() {
  if (!saving_->hasUnsaved(settings_)) {
    forgetCopies();
  }
}

void SceneOpener::forgetCopies() {
  recovery_.forget();
  copyDue_.reset();
}

fs::path SceneOpener::keepCopy() {
  return recovery_.keep(shownFile().stem().string(), saving_->originalFile(),
                        [this](const fs::path& file) { return saving_->text(file, settings_, ReadBack::untested); });
}

void SceneOpener::keepChanges(Clock::time_point now) noexcept {
  using namespace std::chrono_literals;
  const std::pair shown(document_->revision(), settings_);
  if (std::exchange(seen_, shown) != shown) {
    copyDue_ = copyDue_.value_or(now + std::max<Clock::duration>(1s, copyInterval_));
  }
  if (!copyDue_ || now < *copyDue_ || options_.frames > 0) {
    return;
  }
  const std::clock_t start = std::clock();
  copyDue_.reset();
  try {
    saving_->hasUnsaved(settings_) ? static_cast<void>(keepCopy()) : recovery_.forget();
    copyFailed_ = false;
  } catch (const std::exception& error) {
    copyDue_ = now + 10s;
    if (!std::exchange(copyFailed_, true)) {
      spdlog::warn("no copy of unsaved changes is kept: {}", error.what());
    }
  }
  copyInterval_ = 10 * std::chrono::microseconds(std::clock() - start);  // copying a large scene takes long
}

void SceneOpener::keepUnsavedWork() noexcept {
  try {
    if (saving_->hasUnsaved(settings_)) {
      spdlog::warn("unsaved changes are kept in {}", keepCopy().string());
    }
  } catch (const std::exception& error) {
    spdlog::error("unsaved changes are lost: {}", error.what());
  }
}

}  // namespace speculum
