#pragma once

#include "platform/files.hpp"
#include "test_headers.hpp"

namespace speculum::testing_support {

// Expects a FileError of one line that names the file, the problem and what would help.
template <typename Action>
void expectFileFault(const Action& action, const std::filesystem::path& file, const std::string& problem) {
  try {
    action();
    ADD_FAILURE() << "nothing was thrown for " << file;
  } catch (const FileError& error) {
    EXPECT_TRUE(startsWith(error.what(), file.string() + ": " + error.problem() + " ("));
    EXPECT_TRUE(contains(error.problem(), problem));
    EXPECT_FALSE(contains(error.what(), "\n"));
  }
}

}  // namespace speculum::testing_support
