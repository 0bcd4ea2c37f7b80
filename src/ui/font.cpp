#include "ui/font.hpp"

#include "platform/process.hpp"

namespace speculum {

namespace fs = std::filesystem;

fs::path findFont() {
  std::error_code none;
  for (const char* file : {"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf", "/usr/share/fonts/TTF/DejaVuSans.ttf",
                           "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf",
                           "/usr/share/fonts/truetype/roboto/unhinted/RobotoTTF/Roboto-Regular.ttf",
                           "/usr/share/fonts/truetype/noto/NotoSans-Regular.ttf"}) {
    if (fs::is_regular_file(file, none)) {
      return file;
    }
  }
  const ProcessResult found = runProcess({"fc-match", "-f", "%{file}", "sans-serif:fontformat=TrueType"});
  return found.exitCode == 0 && fs::is_regular_file(found.output, none) ? fs::path(found.output) : fs::path();
}

}  // namespace speculum
