// Every input that the fuzzers start from, and every one that they or a reader of the code ever found to crash, hang or
// take too much memory, goes through what the fuzzers run; without Clang.
#include <ctime>

#include "fuzz_checks.hpp"
#include "heap_watch.hpp"
#include "platform/files.hpp"
#include "test_headers.hpp"
#include "test_paths.hpp"

namespace speculum::fuzz {
namespace {

namespace fs = std::filesystem;

constexpr double mostSeconds = 10.0;
constexpr size_t mostBytes = 512u << 20;

std::vector<fs::path> inputs(const std::string& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(sourceDir() / "tests/fuzz" / folder)) {
    files.push_back(entry.path());
  }
  std::ranges::sort(files);
  return files;
}

struct Subject {
  const char* name;
  bool (*check)(std::string_view);
};

class FuzzInputs : public testing::TestWithParam<Subject> {
 protected:
  void run(const std::string& folder) {
    const std::vector<fs::path> files = inputs(folder + "/" + GetParam().name);
    EXPECT_FALSE(files.empty());
    for (const fs::path& file : files) {
      SCOPED_TRACE(file.string());
      const std::string text = readText(file);
      EXPECT_LE(text.size(), largestInput) << "the fuzzers pass over it";
      restartHeapPeak();
      const size_t before = heapPeak();
      const std::clock_t start = std::clock();
      bool accepted = false;
      EXPECT_NO_THROW(accepted = GetParam().check(text));
      EXPECT_TRUE(accepted || folder != "corpus") << "mutations of what is refused early go no deeper";
      EXPECT_LT(std::clock() - start, mostSeconds * CLOCKS_PER_SEC);
      EXPECT_LT(heapPeak() - before, mostBytes);
    }
  }
};

TEST_P(FuzzInputs, Corpus) {
  run("corpus");
}

TEST_P(FuzzInputs, Regressions) {
  run("regressions");
}

INSTANTIATE_TEST_SUITE_P(Each, FuzzInputs,
                         testing::Values(Subject{"scene", checkScene}, Subject{"model", checkModel},
                                         Subject{"gltf", checkGltf}, Subject{"picture", checkPicture},
                                         Subject{"sweep", checkSweep}, Subject{"case", checkCase},
                                         Subject{"layout", checkLayout}, Subject{"recovery", checkRecovery}),
                         [](const auto& info) { return std::string(info.param.name); });

TEST(FuzzHeapWatch, CountsAllocations) {
  restartHeapPeak();
  const size_t before = heapPeak();
  const std::vector<char> block(8u << 20, 'x');
  EXPECT_GE(heapPeak() - before, 8u << 20);
  EXPECT_EQ(block.back(), 'x');  // or a compiler may leave the block out
}

}  // namespace
}  // namespace speculum::fuzz
