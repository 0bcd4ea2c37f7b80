#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scene/model_files.hpp"
#include "scene/support.hpp"
#include "test_headers.hpp"

namespace speculum {

inline const std::string squareText = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

// Loads models from text. Messages name files without their folder.
class ModelTest : public testing::Test {
 protected:
  std::string warnings() const { return withoutFolder(log_.text()); }
  std::string withoutFolder(std::string text) const {
    const std::string folder = folder_.path().string() + "/";
    for (size_t i = text.find(folder); i != std::string::npos; i = text.find(folder)) {
      text.erase(i, folder.size());
    }
    return text;
  }

  TemporaryFolder folder_;
  std::vector<Texture> textures_;
  LogCapture log_;
};

// Loads models from the files m.obj and m.mtl.
class ObjTest : public ModelTest {
 protected:
  Mesh load(const std::string& obj) { return loadModel(folder_.write("m.obj", obj), textures_).mesh; }
  // The first line of the OBJ file names the MTL file.
  Mesh load(const std::string& obj, const std::string& mtl) {
    folder_.write("m.mtl", mtl);
    return load("mtllib m.mtl\n" + obj);
  }
  template <typename... Texts>
  std::string faultOf(const Texts&... texts) {
    return withoutFolder(messageOf<InputError>([&] { load(texts...); }));
  }
};

}  // namespace speculum
