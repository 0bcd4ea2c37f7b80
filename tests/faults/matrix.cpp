// Every Vulkan function that can fail fails with every result that the registry lists, over a picture that is rendered
// and over a window: the program recovers, or ends with one line and exit code 2.
#include <atomic>
#include <cstdio>
#include <mutex>
#include <thread>

#include "core/vulkan_result.hpp"
#include "faults/layer/failing_functions.hpp"
#include "faults/support.hpp"
#include "sampling.hpp"

namespace speculum {
namespace {

using namespace testing_support;

struct FailingFunction {
  std::string name;
  std::vector<VkResult> results;
};
const std::vector<FailingFunction>& failingFunctions() {
#define SPECULUM_ROW(NAME, ...) {#NAME, {__VA_ARGS__}},
  static const std::vector<FailingFunction> rows = {SPECULUM_FAILING_FUNCTIONS(SPECULUM_ROW)};
  return rows;
}

// Says whether a function is called before there is an instance.
bool isEarly(const std::string& function) {
  return function.starts_with("vkEnumerateInstance");
}

struct Fault {
  std::string function;
  VkResult result = VK_SUCCESS;
  int call = 0;

  // Says whether the program must recover and may not end. GLFW does not read lists again.
  bool mustRecover() const {
    const bool ofSurface = function == "vkAcquireNextImageKHR" || function == "vkQueuePresentKHR" ||
                           function == "vkCreateSwapchainKHR" ||
                           function == "vkGetPhysicalDeviceSurfaceCapabilitiesKHR";
    const bool waits = function == "vkAcquireNextImageKHR";
    return result == VK_ERROR_DEVICE_LOST || result == VK_ERROR_OUT_OF_DATE_KHR || result == VK_SUBOPTIMAL_KHR ||
           (result == VK_INCOMPLETE && !isEarly(function)) || (result == VK_ERROR_SURFACE_LOST_KHR && ofSurface) ||
           ((result == VK_TIMEOUT || result == VK_NOT_READY) && waits);
  }
};

class Faults : public FaultTest {
 protected:
  enum class End { recovered, line, wrong };

  End endOf(const Kind& kind, const Fault& fault) {
    const std::string what =
        kind.command + ": " + fault.function + " " + std::to_string(fault.call) + " " + resultName(fault.result);
    const Run result = run(
        kind,
        {"SPECULUM_FAULT=" + fault.function + " " + std::to_string(fault.call) + " " + std::to_string(fault.result)},
        isEarly(fault.function) ? Place::early : Place::outer);
    // If the picture differs, a warning must say what was lowered.
    const bool whole = result.picture == picture_;
    const bool recovered = result.exitCode == 0 && (whole || result.lines == 1) && result.lines <= 1;
    const bool line = result.exitCode == 2 && result.lines == 1 && (whole || !result.picture) && !fault.mustRecover();
    const bool quiet = result.output.find("validation: ") == std::string::npos;
    const bool good = (recovered || line) && quiet && result.otherFiles.empty();
    EXPECT_TRUE(good) << what << ": exit code " << result.exitCode << (whole ? "" : ", other picture") << "\n"
                      << result.output << result.otherFiles;
    return !good ? End::wrong : recovered ? End::recovered : End::line;
  }

  // Every `stride`-th fault of the matrix.
  void expectGoodEnds(const Kind& kind, size_t stride) {
    std::map<std::string, int> calls = callsOf(kind, &picture_);
    std::vector<Fault> faults;
    size_t functions = 0;
    for (const FailingFunction& function : failingFunctions()) {
      const int last = isEarly(function.name) ? 1 : calls[function.name];
      functions += last > 0;
      for (const VkResult result : function.results) {
        // The last call may be the loader's own, which only asks for a count.
        const std::set<int> tried = result == VK_INCOMPLETE ? std::set{1} : std::set{1, (1 + last) / 2, last};
        for (auto call = tried.begin(); last > 0 && call != tried.end(); ++call) {
          faults.push_back({function.name, result, *call});
        }
      }
    }
    std::map<End, int> ends;
    std::mutex counting;
    std::atomic<size_t> next = 0;
    const auto tryFaults = [&] {
      for (size_t i = next.fetch_add(stride); i < faults.size(); i = next.fetch_add(stride)) {
        try {
          const End end = endOf(kind, faults[i]);
          const std::lock_guard lock(counting);
          ++ends[end];
        } catch (const std::exception& error) {
          ADD_FAILURE() << error.what();
        }
      }
    };
    // Each fault has a process of its own. In the short suite other test programs use the other cores.
    std::vector<std::jthread> workers(stride == 1 ? std::max(1u, std::thread::hardware_concurrency()) : 1u);
    for (std::jthread& worker : workers) {
      worker = std::jthread(tryFaults);
    }
    workers.clear();
    std::printf("%s: %zu functions, %d faults: %d recovered, %d ended with a line, %d wrong\n", kind.command.c_str(),
                functions, ends[End::recovered] + ends[End::line] + ends[End::wrong], ends[End::recovered],
                ends[End::line], ends[End::wrong]);
  }

  size_t stride_ = environment("SPECULUM_ALL_FAULTS").empty() ? 97 : 1;
  std::optional<std::vector<uint8_t>> picture_;
};

TEST_F(Faults, RenderEndsWell) {
  Kind kind = render;
  kind.options.insert(kind.options.end(), {"--render-path", "renderpass"});
  expectGoodEnds(kind, stride_);
}

TEST_F(Faults, WindowEndsWell) {
  expectGoodEnds(window, stride_);
}

// Faults between and in the parts of a frame that is submitted in parts.
TEST_F(Faults, LongDrawsEndWell) {
  addToScene(smallRoughMirror);
  const Kind kind = withSettings(window, {"quality.motion_ms=0", "effects.rough_samples=500"});
  std::map<std::string, int> whole = callsOf(withSettings(window, {"quality.motion_ms=0"}));
  std::map<std::string, int> calls = callsOf(kind);
  std::vector<std::string> functions = {"vkEndCommandBuffer", "vkQueueSubmit", "vkWaitForFences"};
  if (fullTests()) {
    functions.insert(functions.end(),
                     {"vkResetFences", "vkResetCommandPool", "vkBeginCommandBuffer", "vkGetQueryPoolResults"});
  }
  for (const std::string& function : functions) {
    ASSERT_GT(calls[function], whole[function] + 4) << function;
    EXPECT_EQ(endOf(kind, {function, VK_ERROR_OUT_OF_HOST_MEMORY, calls[function] - 4}), End::line) << function;
  }
  EXPECT_EQ(endOf(kind, {"vkWaitForFences", VK_ERROR_DEVICE_LOST, calls["vkWaitForFences"] - 4}), End::recovered);
}

TEST_F(Faults, LostDevicesAndSurfacesComeBack) {
  for (const Fault& fault :
       {Fault{"vkQueueSubmit", VK_ERROR_DEVICE_LOST, 9}, Fault{"vkAcquireNextImageKHR", VK_ERROR_SURFACE_LOST_KHR, 2},
        Fault{"vkAcquireNextImageKHR", VK_TIMEOUT, 2}, Fault{"vkQueuePresentKHR", VK_ERROR_OUT_OF_DATE_KHR, 1},
        Fault{"vkCreateSwapchainKHR", VK_ERROR_SURFACE_LOST_KHR, 1}}) {
    endOf(window, fault);
  }
}

}  // namespace
}  // namespace speculum
