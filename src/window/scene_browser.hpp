#pragma once

#include <functional>
#include <map>
#include <set>
#include <utility>

#include "session/session.hpp"
#include "ui/shown.hpp"
#include "window/background_job.hpp"

namespace speculum {

// Lists the scenes to choose from, and loads one in the background.
class SceneBrowser {
 public:
  SceneBrowser();  // with the files that earlier sessions opened
  // Lists the scenes in the folder of `file`, then those that come with the program, then others that were opened
  // before; `file` is shown.
  void list(const std::filesystem::path& file);
  // Marks the file as shown. Adds a file from elsewhere at the end of the list or, with `withFolder`, lists the scenes
  // of its folder too. A new scene is listed only while it is shown.
  void show(const std::filesystem::path& file, bool withFolder);
  // Pictures of the list and of the shown scene, without pixels for a scene that has none.
  std::vector<Image8> thumbnails();
  Image8 thumbnail() { return readThumbnail(shown_.scenes[shown_.shown].file); }
  // Stores a picture of the shown scene as its thumbnail, unless the scene comes with one.
  void storeThumbnail(const std::function<Image8()>& picture);
  // Says whether the list or a thumbnail has changed since the last call. True at first.
  bool takeListed() { return std::exchange(listed_, false); }

  void remember(const std::filesystem::path& file);  // lists the file among the recent ones, for later sessions too
  void forgetRecent(const std::filesystem::path& file) { std::erase(shown_.recent, file); }  // it is gone

  // Loads a scene or a model on a thread of its own, and cancels one that is loading.
  void open(const std::filesystem::path& file, const Options& options);
  static std::vector<std::filesystem::path> shippedModels();  // that come with the program
  static std::filesystem::path newScene();                    // template of a new scene
  static bool isNew(const std::filesystem::path& scene);      // says whether the scene is that template
  // Returns the first of the files that can be opened. Throws InputError if there is none.
  static std::filesystem::path choose(const std::vector<std::filesystem::path>& files);
  void cancelLoading() { load_.cancel(); }
  bool busy() const { return load_.busy(); }  // true until a loaded scene or an error is taken
  bool loaded() const { return load_.hasResult(); }
  std::unique_ptr<LoadedScene> takeLoaded() { return load_.takeResult().value_or(nullptr); }
  std::optional<std::string> takeError() { return load_.takeError(); }

  void showPoster(bool shown) { shown_.poster = shown; }
  void updateView();  // once a frame, for the progress of loading
  const ShownScenes& shown() const { return shown_; }

 private:
  struct Progress {
    std::filesystem::path file;  // file that is read now
    double done = 0.0;           // share, 0 .. 1
  };

  Image8 readThumbnail(const std::filesystem::path& scene);
  void readRecent();
  size_t add(const std::filesystem::path& file);         // lists the file, and returns its index
  void addSaved(const std::vector<SceneEntry>& scenes);  // all but new scenes

  ShownScenes shown_;
  bool listed_ = true;
  std::set<std::filesystem::path> broken_;           // thumbnails that were warned of
  std::map<std::filesystem::path, size_t> indices_;  // into ShownScenes::scenes, by canonical path
  BackgroundJob<std::unique_ptr<LoadedScene>, Progress> load_;
};

}  // namespace speculum
