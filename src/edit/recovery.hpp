#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

namespace speculum {

// Copies of unsaved changes, so that a session that ends in any way can be continued. Each window keeps its own copy,
// in a locked folder of the user's configuration; other windows offer that copy only when no window holds it any more.
class Recovery {
 public:
  // Says whether the file lies where copies are kept.
  static bool isCopy(const std::filesystem::path& file);
  // Returns the scene that a copy was made of; empty for a scene without a file of the user's.
  static std::filesystem::path originalOf(const std::filesystem::path& copy);

  // Holds the newest copy that no other window holds, and returns its path; empty if there is none.
  std::filesystem::path findNewest();
  void postpone() { offered_ = {}; }         // the copy that was found is offered again
  void discardOffer() { remove(offered_); }  // deletes the copy that was found

  // Call when another scene is shown: deletes this window's copy of the scene before. If `file` is a copy itself,
  // keep() replaces it from then on.
  void setScene(const std::filesystem::path& file);
  // Replaces this window's copy by what `text` returns for the copy's file, once that text is on the disk. `name`: the
  // scene's. `original`: what originalOf() returns of the copy. Returns the copy's file. Throws what `text` throws, and
  // FileError.
  std::filesystem::path keep(const std::string& name, const std::filesystem::path& original,
                             const std::function<std::string(const std::filesystem::path& file)>& text);
  void forget() { remove(own_); }  // deletes the copy; call when the changes are saved or discarded

 private:
  struct Copy {
    std::filesystem::path file;  // empty: there is none
    std::shared_ptr<const void> lock;
  };
  static Copy held(const std::filesystem::path& folder);
  static Copy freeFolder();
  static void remove(Copy& copy);

  Copy offered_;
  Copy own_;
};

}  // namespace speculum
