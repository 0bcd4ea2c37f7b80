// A glTF model, drawn against the ray tracer.
#include "image/picture_files.hpp"
#include "made_gltf.hpp"
#include "made_pictures.hpp"
#include "truth_support.hpp"

namespace speculum {
namespace {

using namespace testing_support;

// A column as a strip with normals, colors and a texture that is turned, drawn twice, once mirrored by its nodes.
MadeGltf column() {
  MadeGltf made;
  std::vector<float> positions;
  std::vector<int8_t> normals;
  std::vector<uint8_t> colors;
  std::vector<uint16_t> texcoords;
  std::vector<uint8_t> indices;
  constexpr int sides = 9;
  for (int i = 0; i <= sides; ++i) {
    const double turn = glm::radians(360.0) * i / sides;
    for (const int end : {-1, 1}) {
      positions.insert(positions.end(), {static_cast<float>(0.4 * std::cos(turn)), 0.7f * static_cast<float>(end),
                                         static_cast<float>(0.4 * std::sin(turn))});
      normals.insert(normals.end(),
                     {static_cast<int8_t>(127 * std::cos(turn)), 0, static_cast<int8_t>(127 * std::sin(turn))});
      colors.insert(colors.end(),
                    {static_cast<uint8_t>(255 - 20 * i), static_cast<uint8_t>(150 + 100 * end), 255, 255});
      texcoords.insert(texcoords.end(),
                       {static_cast<uint16_t>(65535 * i / sides), static_cast<uint16_t>(end > 0 ? 65535 : 0)});
      indices.push_back(static_cast<uint8_t>(indices.size()));
    }
  }
  made.add("images",
           {{"bufferView", made.addView(readText(sceneDirectory() / "checker.png"))}, {"mimeType", "image/png"}});
  made.add("textures", {{"source", 0}});
  made.add(
      "materials",
      {{"pbrMetallicRoughness",
        {{"baseColorFactor", {0.9, 0.8, 0.7, 1}},
         {"metallicFactor", 0.3},
         {"roughnessFactor", 0.6},
         {"baseColorTexture",
          {{"index", 0}, {"extensions", {{"KHR_texture_transform", {{"rotation", 0.4}, {"scale", {2, 1.5}}}}}}}}}}});
  made.addMesh({{"POSITION", made.addNumbers(positions, "VEC3")},
                {"NORMAL", made.addNumbers(normals, "VEC3", true)},
                {"COLOR_0", made.addNumbers(colors, "VEC4", true)},
                {"TEXCOORD_0", made.addNumbers(texcoords, "VEC2", true)}},
               {{"indices", made.addNumbers(indices, "SCALAR")}, {"mode", 5}, {"material", 0}});
  made.add("nodes", {{"rotation", {0.2, 0.1, 0.3, 0.9}}, {"children", {1, 2}}});
  made.add("nodes", {{"mesh", 0}, {"translation", {-0.5, 0, 0}}});
  made.add("nodes", {{"mesh", 0}, {"translation", {0.5, 0, 0}}, {"scale", {1, -1, 0.7}}});
  made.add("scenes", {{"nodes", {0}}});
  return made;
}

TEST(GltfModel, EqualsTheTracer) {
  constexpr PictureSize size{160, 120};
  writePng(sceneDirectory() / "checker.png",
           madePicture(8, 8, [](int x, int y) { return glm::ivec4(255, 255 * ((x + y) % 2), 60 * (x % 4), 255); }));
  writeModel("column.glb", column().binary());
  const std::filesystem::path file = writeScene("gltf_column", R"(
[environment] background = [0.2, 0.3, 0.4], ambient = [0.3, 0.3, 0.3]
[camera] position = [0.3, 0.6, 3], target = [0, 0.2, 0]
[[object]] model = "column.glb", rotation = [10, 20, 30]
[[mirror]] position = [0, 0, -1.2], size = [4, 3]
[[light]] position = [1.5, 2, 2], intensity = 8, casts_shadow = true
)");
  expectTruth(file, size, 3, trace(file, size, 3));
}

}  // namespace
}  // namespace speculum
