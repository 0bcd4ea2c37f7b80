#include <spdlog/spdlog.h>

#include <cstdlib>
#include <memory>

#include "cli/commands.hpp"
#include "platform/process.hpp"
#include "platform/text.hpp"
#include "window/demo.hpp"

namespace speculum {

namespace {

Demo* shownDemo = nullptr;

void endWithoutDisplay() {
  if (shownDemo) {
    shownDemo->keepUnsavedWork();
  }
  printLine("the window system has ended (start it again)", stderr);
  std::_Exit(2);
}

}  // namespace

int runDemo(const Options& options) {
  chooseWindowPlatform(options.window.platform);
  installInterruptHandler();
  letBrokenPipesFail();
  Demo demo(options);
  const std::unique_ptr<Demo, void (*)(Demo*)> shown(shownDemo = &demo, [](Demo*) { shownDemo = nullptr; });
  onDisplayLost(&endWithoutDisplay);
  while (demo.step() && !interruptRequested() && (options.frames == 0 || demo.framesDrawn() < options.frames)) {
  }
  if (interruptRequested()) {
    demo.keepUnsavedWork();
  }
  demo.renderer().waitIdle();
  spdlog::info("{} frames", demo.framesDrawn());
  return exitCodeOfChecks(demo.device().validationMessages(), demo.nonFinite());
}

}  // namespace speculum
