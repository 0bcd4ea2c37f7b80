#pragma once

#include <map>

#include "app/background_job.hpp"
#include "app/session.hpp"
#include "ui/views.hpp"

namespace speculum {

// The scenes to choose from, and the one that is read in the background.
class SceneBrowser {
 public:
  // Lists the scenes in the folder of `file`, then those that come with the program, then others that were opened
  // before; `file` is shown.
  void list(const std::filesystem::path& file);
  // The file is shown: one from elsewhere becomes the last of the list, or brings its folder if `withFolder`. True if
  // the list changed.
  bool show(const std::filesystem::path& file, bool withFolder);
  std::vector<Image8> thumbnails() const;  // of the list; without pixels for a scene that has none

  // Reads a scene or a model on a thread of its own; one that is being read is cancelled.
  void open(const std::filesystem::path& file, const Options& options);
  // The first of the files that can be opened. Throws InputError if there is none.
  static std::filesystem::path choose(const std::vector<std::filesystem::path>& files);
  void cancelLoading() { load_.cancel(); }
  bool loading() const { return load_.running(); }
  bool loaded() const { return load_.hasResult(); }
  std::unique_ptr<LoadedScene> takeLoaded();
  std::optional<std::string> takeError() { return load_.takeError(); }

  void updateView();  // once a frame, for the progress of loading
  const BrowserView& view() const { return view_; }

 private:
  struct Progress {
    std::filesystem::path file;  // that is read
    double done = 0.0;           // share, 0 .. 1
  };

  size_t add(const std::filesystem::path& file);  // its index

  BrowserView view_;
  std::map<std::filesystem::path, size_t> indices_;  // into BrowserView::scenes, by canonical path
  BackgroundJob<std::unique_ptr<LoadedScene>, Progress> load_;
};

}  // namespace speculum
