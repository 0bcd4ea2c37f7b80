#include <algorithm>

#include "cli/commands.hpp"
#include "cli/progress.hpp"
#include "cli/stats.hpp"
#include "image/picture_files.hpp"
#include "platform/process.hpp"
#include "platform/renderdoc_capture.hpp"
#include "session/output_files.hpp"
#include "session/session.hpp"

namespace speculum {

namespace {

void savePicture(Session& session, const std::filesystem::path& file) {
  if (file.extension() == ".exr") {
    writeExr(file, session.radiance());
  } else {
    writePng(file, session.picture());
  }
}

}  // namespace

int runRender(const Options& options) {
  const int count = std::max(1, options.frames);
  const PictureSequence files(options.out, options.frames > 0 ? count : 0);
  Session session(options);
  if (options.out.extension() != ".exr") {
    session.showOnly();
  }
  session.renderer().setTimerDetail(options.render.stats.empty() ? TimerDetail::frame : TimerDetail::samples);
  installInterruptHandler();
  const int pictures = session.settings().view.accumulate;
  Progress progress("render", count * pictures);
  for (int i = 0; i < count; ++i) {
    // A mean that has converged is complete before its last picture.
    const auto advance = [&] { return progress.set(i * pictures + session.lastFrame().pictures); };
    const auto draw = [&] {
      session.draw(options.time + i / options.fps, true, advance);
      session.finish();
    };
    if (options.render.capture && i == 0) {
      captureWithRenderDoc(*options.render.capture, draw);
    } else {
      draw();
    }
    if (session.lastFrame().pictures < pictures) {
      return 1;  // interrupted
    }
    savePicture(session, files.at(i));
    if (interruptRequested()) {
      return 1;
    }
  }
  if (!options.render.stats.empty()) {
    writeJson(options.render.stats, frameStats(session));
  }
  return session.exitCode();
}

}  // namespace speculum
