#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

namespace speculum {

// Copies of unsaved changes, so that a session that ends in any way can be continued. Each window keeps its own, in a
// locked folder of the user's configuration; others offer a copy only when no window holds it any more.
class Recovery {
 public:
  static bool isCopy(const std::filesystem::path& file);
  // Returns the scene that a copy was made of; empty for a scene without a file of the user's.
  static std::filesystem::path originalOf(const std::filesystem::path& copy);

  // Holds the newest copy that no window holds, and returns its path; empty if there is none.
  std::filesystem::path findNewest();
  void postpone() { offered_ = {}; }  // that copy is offered again
  void discardOffer() { remove(offered_); }

  // Call when another scene is shown: forgets the changes of the scene before. If it is a copy, later ones replace it.
  void setScene(const std::filesystem::path& file);
  // Replaces this window's copy by `text` of the file, once that is on the disk. `name` is the scene's, and `original`
  // what originalOf() returns of the copy. Returns the file. Throws what `text` does, and FileError.
  std::filesystem::path keep(const std::string& name, const std::filesystem::path& original,
                             const std::function<std::string(const std::filesystem::path& file)>& text);
  void forget() { remove(own_); }  // call when the changes are saved or discarded

 private:
  struct Copy {
    std::filesystem::path file;  // empty: there is none
    std::shared_ptr<const int> lock;
  };
  static Copy held(const std::filesystem::path& folder);
  static Copy freeFolder();
  static void remove(Copy& copy);

  Copy offered_;
  Copy own_;
};

}  // namespace speculum
