#include "platform/folders.hpp"

#include "error_message.hpp"
#include "platform/process.hpp"
#include "test_headers.hpp"

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
  EXPECT_TRUE(contains(error, "share/speculum/no-such-data"));
  EXPECT_TRUE(std::filesystem::exists(dataDirectory("shaders")));
}

}  // namespace
}  // namespace speculum::test
