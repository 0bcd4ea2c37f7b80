#include "platform/folders.hpp"

#include <gtest/gtest.h>

#include "error_message.hpp"
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
  const std::string error = messageOf([] { dataDirectory("no-such-data"); });
  EXPECT_NE(error.find("share/speculum/no-such-data"), std::string::npos) << error;
  EXPECT_TRUE(std::filesystem::exists(dataDirectory("shaders")));
}

}  // namespace
}  // namespace speculum::test
