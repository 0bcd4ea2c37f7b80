#include "platform/folders.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "platform/process.hpp"

namespace speculum::test {
namespace {

TEST(Folders, CacheDirectoryFollowsXdg) {
  setEnvironment("XDG_CACHE_HOME", "/somewhere");
  EXPECT_EQ(userCacheDir(), "/somewhere/speculum");
  setEnvironment("XDG_CACHE_HOME", "relative/is/ignored");
  setEnvironment("HOME", "/home/me");
  EXPECT_EQ(userCacheDir(), "/home/me/.cache/speculum");
}

TEST(Folders, MissingDataDirectoryListsWhereItLooked) {
  try {
    dataDirectory("no-such-data");
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("share/speculum/no-such-data"), std::string::npos) << error.what();
  }
  EXPECT_TRUE(std::filesystem::exists(dataDirectory("shaders")));
}

}  // namespace
}  // namespace speculum::test
