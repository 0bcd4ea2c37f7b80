#include "fuzz_support.hpp"
#include "image/image.hpp"
#include "image/picture_files.hpp"
#include "scene/gltf_file.hpp"

namespace speculum::fuzz {

bool checkGltf(std::string_view content) {
  static const TemporaryFolder folder;
  static const bool hasFiles = [] {
    writePng(folder / "t.png", Image8(2, 2));
    folder.write("t.bin", std::string(64, '\1'));
    return true;
  }();
  require(hasFiles, "the files are there");
  const std::filesystem::path file = folder.write("m.glb", content);
  std::vector<Texture> textures;
  Model model;
  if (!accepted([&] { model = loadGltf(file, textures); })) {
    return false;
  }
  checkMesh(model.mesh, textures.size());
  try {
    const Scene scene = loadScene(file);
    require(scene.lights.size() == (model.lights.empty() ? 2 : model.lights.size()),
            "the scene has the model's lights");
  } catch (const InputError& refusal) {
    require(std::string_view(refusal.what()).find("bounding sphere") != std::string_view::npos,
            "a scene is refused for its size only");
  }
  return true;
}

}  // namespace speculum::fuzz
