#include "window/document_controller.hpp"

#include <algorithm>
#include <array>

#include "edit/recovery.hpp"
#include "platform/files.hpp"
#include "scene/fingerprint.hpp"
#include "window/scene_browser.hpp"

namespace speculum {

namespace fs = std::filesystem;

namespace {

constexpr size_t mostCopies = 100;

// Returns the folder of the copies of scenes that copied command lines draw.
fs::path viewsFolder() {
  return userCacheDir() / "views";
}

// Says whether the file lies in a folder of shipped scenes or models, or of copies.
bool isShipped(const fs::path& file) {
  const fs::path scenes = dataDirectory("scenes");
  const std::array folders{scenes, scenes.parent_path() / "models", viewsFolder()};
  const auto holds = [&](const fs::path& folder) { return isBelow(withoutLinks(file), withoutLinks(folder)); };
  return Recovery::isCopy(file) || std::ranges::any_of(folders, holds);
}

// Returns the default folder for saved scenes; created on first use.
fs::path ownFolder() {
  return documentsDir() / "Speculum";
}

// Names what waits for the user's answer.
std::string waitingText(const std::optional<Command>& waiting) {
  if (!waiting) {
    return "closing this scene";
  }
  if (const auto* open = std::get_if<OpenScene>(&*waiting)) {
    return SceneBrowser::isNew(open->file) ? "starting a new scene" : "opening " + open->file.filename().string();
  }
  return std::holds_alternative<Quit>(*waiting) ? "quitting" : "closing this scene";
}

}  // namespace

DocumentController::DocumentController(LoadedScene& loaded, SceneDocument& document, SceneEditor& editor, bool prompts)
    : loaded_(loaded), document_(document), editor_(editor), prompts_(prompts), settingsAtLoad_(loaded.settings) {
  findSaveFile();
}

// Finds the file that Save writes. Call it when the scene has another file. It accesses the disk.
void DocumentController::findSaveFile() {
  const fs::path file = document_.usualFile();
  saveFile_ = !isShipped(file) && isWritable(file) ? std::optional(file) : std::nullopt;
  isCopy_ = Recovery::isCopy(file);
  isNew_ = isModelFile(loaded_.scene.file) || SceneBrowser::isNew(loaded_.scene.file);
}

bool DocumentController::hasUnsaved(const Settings& settings) const {
  return document_.modified() || settings != loaded_.settings || isCopy_;
}

bool DocumentController::confirmDiscard(const Settings& settings, std::optional<Command> then) {
  const bool alreadyDiscarded =
      discarded_ && discarded_->revision == document_.revision() && discarded_->settings == settings;
  if (alreadyDiscarded || !prompts_ || (!hasUnsaved(settings) && !refusedEdit_)) {
    return true;
  }
  prompt_ = prompt_ == Prompt::none ? Prompt::unsavedChanges : prompt_;
  if (then) {
    afterPrompt_ = std::move(then);
  }
  waitingText_ = waitingText(afterPrompt_);
  return false;
}

// Prompts for another file instead of overwriting one that comes with the program.
std::optional<Command> DocumentController::save(const Settings& settings) {
  editor_.release();
  prompt_ = Prompt::none;
  if (isShipped(document_.usualFile())) {
    askWhere();
    return std::nullopt;
  }
  if (saveTo(document_.usualFile(), settings, false)) {
    return discard(settings);
  }
  const std::string why = note_;
  askWhere();
  note_ = why;
  return std::nullopt;
}

void DocumentController::askWhere() {
  const fs::path file = document_.usualFile();
  findSaveFile();
  const fs::path usual = isCopy_ ? originalFile() : saveFile_.value_or("");
  ask(Prompt::saveAs, wholePath(usual.empty() ? ownFolder() / file.filename() : usual));
}

fs::path DocumentController::originalFile() const {
  return isCopy_ ? Recovery::originalOf(loaded_.scene.file) : saveFile_ && !isNew_ ? wholePath(*saveFile_) : "";
}

void DocumentController::ask(Prompt prompt, const fs::path& proposed) {
  prompt_ = prompt;
  proposed_ = proposed;
  note_.clear();
}

std::optional<Command> DocumentController::saveAs(const fs::path& file, const Settings& settings, bool copyModels) {
  proposed_ = proposed_.parent_path() / typedPath(file);  // a bare name goes into the suggested folder
  return saveTo(proposed_, settings, copyModels) ? discard(settings) : std::nullopt;
}

std::optional<Command> DocumentController::discard(const Settings& settings) {
  prompt_ = Prompt::none;
  discarded_ = Discarded{document_.revision(), settings};
  return std::exchange(afterPrompt_, std::nullopt);
}

void DocumentController::cancelPrompt() {
  prompt_ = Prompt::none;
  afterPrompt_.reset();
  refused_.reset();
}

bool DocumentController::saveTo(const fs::path& named, const Settings& settings, bool copyModels) {
  fs::path file = named;
  try {
    file = sceneFileNamed(named);
    if (file.parent_path() == ownFolder()) {
      std::error_code none;
      fs::create_directories(ownFolder(), none);
    }
    requireFolder(file);
    if (isShipped(file) && file != refused_) {
      throw OverwriteError(file.string() + ": not saved: it comes with the program");
    }
    if (isFile(file) && !isWritable(file)) {
      throw SaveError(file.string() + ": not saved: it is read-only (save under another name)");
    }
    document_.save(file, settingChanges(settingsAtLoad_, settings), file == refused_, copyModels);
    note_ = "Saved " + wholePath(file).lexically_normal().string();
    loaded_.settings = settings;
    refused_.reset();
    saved_ = true;
    findSaveFile();
    if (copyModels) {
      editor_.modelsChanged();
    }
    return true;
  } catch (const SaveError& error) {
    const bool refused = dynamic_cast<const OverwriteError*>(&error) != nullptr;
    const bool overwritable = refused && file.extension() == ".toml" && isFile(file);
    note_ = error.what();
    note_ += overwritable ? "\nSave once more to overwrite it." : "";
    refused_ = overwritable ? std::optional(file) : std::nullopt;
    return false;
  }
}

std::string DocumentController::text(const fs::path& file, const Settings& settings, ReadBack readBack) const {
  return document_.text(file, settingChanges(settingsAtLoad_, settings), readBack);
}

fs::path DocumentController::savedOrCopy(const Settings& settings) const {
  if (!hasUnsaved(settings)) {
    return loaded_.scene.file;
  }
  const fs::path folder = viewsFolder();
  std::error_code none;
  fs::create_directories(folder, none);
  const std::string text = this->text(folder / "view.toml", settings, ReadBack::required);
  // Names the copy by its content, so that commands copied earlier still draw the same picture.
  Fingerprint fingerprint;
  fingerprint.add(std::string_view(text));
  const fs::path file = folder / fileNameOf(loaded_.scene.file.stem().string(), "-" + fingerprint.hex() + ".toml");
  keepNewest(folder, mostCopies, [](const fs::path& copy) { return copy.extension() == ".toml"; });
  replaceFile(file, std::string_view(text));
  return file;
}

void DocumentController::fill(ShownEdit& view, const Settings& settings) const {
  editor_.fill(view);
  view.unsaved = hasUnsaved(settings);
  view.saveFile = saveFile_;
  view.isNew = isNew_;
  view.prompt = prompt_;
  view.afterPrompt = waitingText_;
  view.proposedFile = proposed_;
  view.ownFile = prompt_ == Prompt::recovery ? Recovery::originalOf(proposed_)
                 : isCopy_                   ? originalFile()
                                             : loaded_.scene.file;
  view.note = note_;
}

}  // namespace speculum
