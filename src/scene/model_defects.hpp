#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace speculum {

// Counts the defects of a model and of the files that it names, so that each kind of a file is one warning.
class ModelDefects {
 public:
  // Counts a defect in a line of a file, from 1. `kind` is a text that outlives this object; its {} stands for
  // `detail`.
  void add(const std::filesystem::path& file, int line, std::string_view key, std::string_view kind,
           std::string_view detail = {});

  // Logs one warning for each kind, `FILE:LINE: key: kind (and N more)` with the line of the first, in the order of the
  // first. Returns these texts and forgets the defects.
  std::vector<std::string> report();

 private:
  struct Entry {
    std::filesystem::path file;
    std::string key;
    std::string_view kind;
    std::string text;  // about the first
    size_t count = 1;
  };

  std::vector<Entry> entries_;
};

}  // namespace speculum
