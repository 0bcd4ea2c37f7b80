#include "example.hpp"

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <map>
#include <stdexcept>

#include "compare/image_metrics.hpp"
#include "image/image.hpp"
#include "image/picture_files.hpp"
#include "platform/files.hpp"
#include "platform/process.hpp"
#include "platform/text.hpp"
#include "reference/ray_tracer.hpp"
#include "scene/scene_loader.hpp"
#include "shader_objects.hpp"

namespace speculum::examples {

std::unique_ptr<Window> Options::openWindow() const {
  return out.empty()
             ? std::make_unique<Window>(WindowOptions{
                   .title = name, .width = static_cast<int>(size.width), .height = static_cast<int>(size.height)})
             : nullptr;
}

DeviceOptions Options::device(Window* window) const {
  DeviceOptions device{.validation = validation, .window = window, .renderPath = renderPath};
  if (shaderObjects) {
    ShaderObjects::require(device);
  }
  return device;
}

RendererOptions Options::renderer(Window* window) const {
  return {.window = window, .extent = size, .spirvDir = dataDirectory("shaders/" + name)};
}

std::filesystem::path Options::model(const std::string& path) const {
  return dataDirectory("examples/" + name) / path;
}

bool Loop::next() {
  if (!window_) {
    return frames_++ < options_.frames.value_or(1);
  }
  do {
    window_->paused() ? window_->waitEvents(0.1) : window_->pollEvents();
    if (window_->shouldClose() || window_->keyDown(Key::escape)) {
      return false;
    }
  } while (window_->paused());
  shown_ = std::chrono::steady_clock::now() - start_;
  return !options_.frames || frames_++ < *options_.frames;
}

std::array<float, 4> radiance(const glm::vec3& linear) {
  return {linear.x, linear.y, linear.z, 1.0f};
}

std::array<float, 4> displayed(const glm::vec3& linear) {
  const auto encoded = [](float value) { return static_cast<float>(srgbEncode(std::clamp(value, 0.0f, 1.0f))); };
  return {encoded(linear.x), encoded(linear.y), encoded(linear.z), 1.0f};
}

Drawn finish(Renderer& renderer) {
  renderer.waitIdle();
  return {.picture = renderer.headless() ? renderer.readback() : Pixels{},
          .gpuMs = renderer.timings().gpuMs,
          .validationMessages = renderer.device().validationMessages()};
}

namespace {

// Writes what would be logged to stderr, warnings and worse, because stdout is for figures.
void setUpLog() {
  const auto logger = std::make_shared<spdlog::logger>("example", std::make_shared<spdlog::sinks::stderr_sink_mt>());
  logger->set_pattern("%l: %v");
  logger->set_level(spdlog::level::warn);
  spdlog::set_default_logger(logger);
}

Options parse(int argc, const char* const* argv, const std::string& name) {
  Options options{.name = name};
  std::string size, path = "auto", shaders = "pipelines";
  CLI::App app("One step of docs/learn.md", name);
  app.add_option("--out", options.out, "PNG to write, without a window");
  app.add_option("--size", size, "WIDTHxHEIGHT in pixels");
  app.add_option("--time", options.time, "seconds of animation")->check(CLI::Range(-1e6, 1e6));
  app.add_option("--frames", options.frames, "frames to draw")->check(CLI::Range(1, 1'000'000));
  app.add_option("--shaders", shaders, "pipelines | objects")->check(CLI::IsMember({"pipelines", "objects"}));
  app.add_option("--render-path", path, "auto | dynamic | renderpass")
      ->check(CLI::IsMember({"auto", "dynamic", "renderpass"}));
  app.add_flag("--validation", options.validation, "validation layer with synchronisation validation");
  app.add_flag("--naive", options.naive, "draws the mirror as most demos do, and compares");
  app.parse(argc, argv);
  if (!options.out.empty() && options.out.extension() != ".png") {
    throw std::runtime_error("--out: '" + options.out.string() + "' must end in .png (the picture is a PNG)");
  }
  const std::optional<PictureSize> asked = size.empty() ? PictureSize{1280, 720} : pictureSize(size);
  if (!asked) {
    throw std::runtime_error("--size: '" + size + "' is not a size (" + std::string(pictureSizes) + ")");
  }
  if (!std::isfinite(options.time.value_or(0.0))) {
    throw std::runtime_error("--time: not a finite number (seconds of animation, such as 2.5)");
  }
  if (options.naive && !isFile(options.model("scene.toml"))) {
    throw std::runtime_error("--naive: " + name + " has no mirror (use one_mirror or mirror_in_mirror)");
  }
  options.size = extentOf(asked->width, asked->height);
  options.renderPath = renderPathFromName(path).value();
  options.shaderObjects = shaders == "objects";
  if (options.shaderObjects && options.renderPath == RenderPath::renderPass) {
    throw std::runtime_error("--shaders objects: draws in dynamic rendering only (leave out --render-path renderpass)");
  }
  return options;
}

Image8 image8(const Pixels& pixels) {
  Image8 image(static_cast<int>(pixels.extent.width), static_cast<int>(pixels.extent.height));
  image.rgba = pixels.rgba;
  return image;
}

// Compares both pictures with what the tracer makes of the example's scene file at the same samples: one a pixel.
std::string againstTracer(const Options& options, const Drawn& naive, const Drawn& exact) {
  const Scene scene = loadScene(options.model("scene.toml"));
  const RayTracer tracer(scene, evaluate(scene, options.time.value_or(0.0)));
  const Image8 truth = toDisplay(tracer
                                     .render({.width = static_cast<int>(options.size.width),
                                              .height = static_cast<int>(options.size.height),
                                              .samples = 1,
                                              .maxDepth = 8})
                                     ->image);
  const auto figures = [&](const Drawn& drawn) {
    char text[64];
    std::snprintf(text, sizeof text, "FLIP %.4f in %.3f ms",
                  compareImages(comparedImage(truth), comparedImage(image8(drawn.picture))).whole.flip, drawn.gpuMs);
    return std::string(text);
  };
  return "naive: " + figures(naive) + "; exact: " + figures(exact) + "\n";
}

int runExample(Options options, Drawn (*run)(const Options&)) {
  const Drawn drawn = run(options);
  int messages = drawn.validationMessages;
  if (!options.out.empty()) {
    writePng(options.out, image8(drawn.picture));
    if (options.naive) {
      options.naive = false;
      const Drawn exact = run(options);
      messages += exact.validationMessages;
      std::fputs(againstTracer(options, drawn, exact).c_str(), stdout);
    }
  }
  return messages > 0 ? 1 : 0;
}

}  // namespace

int exampleMain(int argc, char** argv, const std::string& name, Drawn (*run)(const Options&)) {
  const std::vector<const char*> arguments = prepareProcess(argc, argv);
  try {
    setUpLog();
    return runExample(parse(static_cast<int>(arguments.size()), arguments.data(), name), run);
  } catch (const CLI::CallForHelp&) {
    std::printf(
        "%s [--out F.png] [--size WxH] [--time S] [--frames N] [--naive] [--shaders pipelines|objects]\n"
        "  [--render-path auto|dynamic|renderpass] [--validation]\nSee docs/learn.md.\n",
        name.c_str());
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", oneLine(error.what()).c_str());
    return 2;
  }
}

}  // namespace speculum::examples
