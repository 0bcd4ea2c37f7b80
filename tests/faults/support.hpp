#pragma once

#include "command_support.hpp"
#include "picture_support.hpp"
#include "platform/files.hpp"
#include "scene_text.hpp"
#include "virtual_display.hpp"

namespace speculum::testing_support {

// The program under the Vulkan layer of layer/fault_layer.cpp.
class FaultTest : public testing::Test {
 protected:
  struct Kind {
    std::string command;
    std::vector<std::string> options;
  };
  inline static const Kind render{"render", {"--size", "48x36", "--log-level", "warn"}};
  inline static const Kind window{
      "demo", {"--size", "320x240", "--frames", "4", "--present-mode", "immediate", "--log-level", "warn"}};
  struct Run {
    int exitCode = 0;
    std::string output;  // stdout and stderr
    long lines = 0;      // number of lines of `output`
    std::optional<std::vector<uint8_t>> picture;
    std::string otherFiles;  // files that were left beside the picture
  };

  // Places of the layer. outer: nearest to the program. inner: between the validation layer and the driver, so that
  // validation sees the layer's limits. early: called also before there is an instance.
  enum class Place { outer, inner, early };

  // `variables`: NAME=VALUE of the environment.
  Run run(const Kind& kind, const std::vector<std::string>& variables, Place place = Place::outer) {
    const std::string layer = (binaryDir() / "tests" / "fault_layer").string();
    const TemporaryDirectory out;
    const std::filesystem::path picture = out.path() / "out.png";
    std::vector<std::string> command = {"timeout", "-k", "5", "60", "env"};
    if (place == Place::early) {
      command.push_back("XDG_DATA_HOME=" + layer + "/data");
    } else {
      // Nearest to the program is the layer that the loader finds first in these folders, for newer loaders the first
      // one of these names.
      const std::string validation = "/usr/share/vulkan/explicit_layer.d:";
      const bool inner = place == Place::inner;
      command.push_back("VK_ADD_LAYER_PATH=" + (inner ? validation : "") + layer);
      command.push_back("VK_INSTANCE_LAYERS=" + std::string(inner ? "VK_LAYER_KHRONOS_validation:" : "") +
                        "VK_LAYER_SPECULUM_fault");
    }
    // The check of queue submissions, which the program turns on unless this variable is set, crashes in
    // vkDeviceWaitIdle while images are presented (layer of 1.3.239).
    command.push_back("VK_LAYER_ENABLES=VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT");
    command.push_back("NODEVICE_SELECT=1");  // turns off a layer of Mesa's that ignores errors
    const auto add = [&](const std::vector<std::string>& more) {
      command.insert(command.end(), more.begin(), more.end());
    };
    for (const char* name : {"XDG_CONFIG_HOME", "XDG_PICTURES_DIR", "XDG_DOCUMENTS_DIR", "HOME"}) {
      add({name + ("=" + (out.path() / "home").string())});
    }
    add(variables);
    add({program, kind.command, "--scene", scene_, "--validation"});
    add(kind.options);
    if (kind.command == "render") {
      add({"--out", picture.string()});
    }
    const ProcessResult result = runProcess(command);
    Run run{.exitCode = result.exitCode,
            .output = result.output,
            .lines = std::ranges::count(result.output, '\n'),
            .picture = readFileIfAny(picture)};
    for (const auto& entry : std::filesystem::directory_iterator(out.path())) {
      const std::string name = entry.path().filename().string();
      run.otherFiles += name == "out.png" || name == "home" ? "" : name + " ";
    }
    return run;
  }

  void addToScene(const std::string& toml) { std::ofstream(scene_, std::ios::app) << tomlOf(toml); }
  // A mirror whose rays count as if it filled the picture: with many such mirrors, frames are submitted in parts.
  inline static const std::string smallRoughMirror =
      "[[mirror]] position = [-1, 1, 0], size = [0.1, 0.1], roughness = 0.3\n";
  static Kind withSettings(Kind kind, const std::vector<std::string>& settings) {
    for (const std::string& setting : settings) {
      kind.options.insert(kind.options.end(), {"--set", setting});
    }
    return kind;
  }
  // Returns the number of calls of each Vulkan function in a run without a fault. Stores its picture in `picture`.
  std::map<std::string, int> callsOf(const Kind& kind, std::optional<std::vector<uint8_t>>* picture = nullptr) {
    const TemporaryDirectory folder;
    const std::filesystem::path file = folder.path() / "calls";
    Run good = run(kind, {"SPECULUM_FAULT_CALLS=" + file.string()});
    EXPECT_EQ(good.exitCode, 0);
    EXPECT_EQ(good.output, "");
    if (picture) {
      *picture = std::move(good.picture);
    }
    std::map<std::string, int> calls;
    std::ifstream stream(file);
    std::string name;
    for (int count = 0; stream >> name >> count;) {
      calls[name] = count;
    }
    return calls;
  }

  test::VirtualDisplay display_;
  // A mirror, an object with a texture, rays, and a setting that needs a compute shader.
  std::string scene_ = writeScene("faults", R"(
[camera] position = [0, 1, 4], target = [0, 1, 0]
[settings] "debug.check_finite" = true
[[object]] model = "MODELS/column.obj"
[[light]] position = [0, 3, 3], intensity = 10, casts_shadow = true
[[mirror]] position = [0, 1, -2], size = [5, 3]
)")
                           .string();
};

}  // namespace speculum::testing_support
