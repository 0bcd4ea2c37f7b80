#include "image/image.hpp"
#include "image/picture_files.hpp"
#include "made_pictures.hpp"
#include "picture_support.hpp"
#include "scene_text.hpp"
#include "studio.hpp"

namespace speculum {
namespace {

using namespace testing_support;

constexpr PictureSize floorSize{160, 90};

// A square of two metres with a texture, repeated so many times; `rest` adds camera and lights, `options` those of MTL.
std::filesystem::path squareWith(const std::string& name, const Image8& texture, int repeats, const std::string& rest,
                                 const std::string& options = "") {
  writePng(sceneDirectory() / (name + ".png"), texture);
  writeModel(name + ".mtl", "newmtl m\nKd 1 1 1\nmap_Kd " + options + name + ".png\n");
  const std::string n = std::to_string(repeats);
  writeModel(name + ".obj", "mtllib " + name + ".mtl\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt " + n +
                                " 0\nvt " + n + " " + n + "\nvt 0 " + n + "\nusemtl m\nf 1/1 2/2 3/3 4/4\n");
  return writeScene(name, rest);
}

// Shadows of a dim light are traced, so that rays shade everything.
const std::string byRays = "[[light]]\nposition = [0, 5, 5]\nintensity = 0.01\ncasts_shadow = true\n";

class TextureFilters : public testing::TestWithParam<bool> {
 protected:
  std::string rest() const { return GetParam() ? byRays : ""; }
};

TEST_P(TextureFilters, NearestShowsTexels) {
  const Image8 texture = madePicture(8, 4, [](int x, int y) { return glm::ivec4(30 * x + 5, 60 * y + 9, 200, 255); });
  Studio studio(headless(squareWith("texels", texture, 1,
                                    "[camera]\nposition = [0, 0, 1]\ntarget = [0, 0, 0]\n"
                                    "vertical_fov = 90\n[environment]\nambient = [1, 1, 1]\n[[object]]\n"
                                    "model = \"texels.obj\"\n" +
                                        rest()),
                         {96, 96}, {{"view.texture_filter", "nearest"}, {"view.samples", "1"}}));
  const Image8 picture = studio.fresh();
  EXPECT_EQ(studio.plan.effects.any(), GetParam());
  for (int y = 0; y < 96; ++y) {
    for (int x = 0; x < 96; ++x) {
      const uint8_t* expected = texture.at(x * 8 / 96, y * 4 / 96);
      for (int channel = 0; channel < 3; ++channel) {
        ASSERT_NEAR(picture.at(x, y)[channel], expected[channel], 1) << x << " " << y;
      }
    }
  }
}

// Coordinates reach from 0 to 2, so that the texture fills the lower left quarter.
TEST_P(TextureFilters, ClampedTexturesEndInTheirEdges) {
  const Image8 texture = madePicture(8, 4, [](int x, int y) { return glm::ivec4(30 * x + 5, 60 * y + 9, 200, 255); });
  const std::filesystem::path file = squareWith("clamped", texture, 2,
                                                "[camera]\nposition = [0, 0, 1]\ntarget = [0, 0, 0]\n"
                                                "vertical_fov = 90\n[environment]\nambient = [1, 1, 1]\n[[object]]\n"
                                                "model = \"clamped.obj\"\n" +
                                                    rest(),
                                                "-clamp on ");
  for (const char* filter : {"nearest", "bilinear", "trilinear", "anisotropic"}) {
    Studio studio(headless(file, {96, 96}, {{"view.texture_filter", filter}, {"view.samples", "1"}}));
    const Image8 picture = studio.fresh();
    const bool nearest = filter == std::string("nearest");
    for (int y = 0; y < (nearest ? 96 : 48); ++y) {
      for (int x = nearest ? 0 : 48; x < 96; ++x) {
        const uint8_t* expected = texture.at(std::min(x * 16 / 96, 7), std::max(y * 8 / 96 - 4, 0));
        for (int channel = 0; channel < 3; ++channel) {
          ASSERT_NEAR(picture.at(x, y)[channel], expected[channel], 1) << filter << " " << x << " " << y;
        }
      }
    }
  }
}

// Stripes along a floor that is seen at a grazing angle.
TEST_P(TextureFilters, AnisotropicIsSharperThanTrilinear) {
  const Image8 texture =
      madePicture(32, 32, [](int x, int) { return glm::ivec4(glm::ivec3(x % 16 < 8 ? 20 : 230), 255); });
  const std::filesystem::path file =
      squareWith("stripes", texture, 12,
                 "[camera]\nposition = [0, 0.12, 1.2]\ntarget = [0, 0, 0]\n[environment]\n"
                 "ambient = [1, 1, 1]\n[[object]]\nmodel = \"stripes.obj\"\nrotation = [-90, 0, 0]\n" +
                     rest());
  const auto drawn = [&](const char* filter, const char* pictures) {
    QuietSession session(headless(
        file, floorSize, {{"view.texture_filter", filter}, {"view.samples", "1"}, {"view.accumulate", pictures}}));
    return drawRadiance(session);
  };
  const LinearImage truth = drawn("bilinear", "25");
  const auto errorOf = [&](const char* filter) { return rootMeanSquare(drawn(filter, "1"), truth); };
  const double trilinear = errorOf("trilinear");
  EXPECT_GT(trilinear, 0.01);
  EXPECT_LT(errorOf("anisotropic"), 0.8 * trilinear);
  EXPECT_GT(errorOf("nearest"), errorOf("bilinear"));
}

// Where a texture repeats within a pixel, every filter returns its mean, and soon.
TEST_P(TextureFilters, AnisotropicEndsWhereTexturesRepeatOften) {
  const Image8 texture =
      madePicture(32, 32, [](int x, int) { return glm::ivec4(glm::ivec3(x % 16 < 8 ? 20 : 230), 255); });
  const std::filesystem::path file =
      squareWith("repeats", texture, 100'000,
                 "[camera]\nposition = [0, 0.3, 1.6]\ntarget = [0, 0, 0]\n[environment]\n"
                 "ambient = [1, 1, 1]\n[[object]]\nmodel = \"repeats.obj\"\nrotation = [-90, 0, 0]\n" +
                     rest());
  const auto drawn = [&](const char* filter) {
    QuietSession session(headless(file, {64, 36}, {{"view.texture_filter", filter}, {"view.samples", "1"}}));
    return drawRadiance(session);
  };
  EXPECT_LT(rootMeanSquare(drawn("anisotropic"), drawn("trilinear")), 0.01);
}

// A bumpy floor of 88 200 triangles, whose normals stand in the file or are left to the loader.
std::string bumpyFloor(bool normals) {
  constexpr int side = 211;
  const auto pointAt = [](int x, int z) {
    return glm::dvec3(x / 105.0 - 1.0, 0.04 * std::sin(0.3 * x) * std::cos(0.37 * z), z / 105.0 - 1.0);
  };
  std::ostringstream vertices;
  std::ostringstream faces;
  vertices.precision(17);
  for (int i = 0; i < side * side; ++i) {
    const glm::dvec3 p = pointAt(i % side, i / side);
    vertices << "v " << p.x << " " << p.y << " " << p.z << "\n";
  }
  int faceCount = 0;
  for (int i = 0; i < side * (side - 1); ++i) {
    const glm::ivec2 at(i % side, i / side);
    for (const std::array<glm::ivec2, 3>& corners :
         {std::array{at, at + glm::ivec2(0, 1), at + glm::ivec2(1, 0)},
          std::array{at + glm::ivec2(1, 0), at + glm::ivec2(0, 1), at + glm::ivec2(1, 1)}}) {
      if (at.x + 1 == side) {
        continue;
      }
      ++faceCount;
      faces << "f";
      for (const glm::ivec2& corner : corners) {
        faces << " " << corner.y * side + corner.x + 1;
        faces << (normals ? "//" + std::to_string(faceCount) : "");
      }
      faces << "\n";
      const auto p = [&](int k) { return pointAt(corners[k].x, corners[k].y); };
      const glm::dvec3 normal = glm::normalize(glm::cross(p(1) - p(0), p(2) - p(0)));
      vertices << "vn " << normal.x << " " << normal.y << " " << normal.z << "\n";
    }
  }
  return vertices.str() + faces.str();
}

class FlatShading : public TextureFilters {};

TEST_P(FlatShading, SharedCornersOfFlatTrianglesDrawTheSame) {
  const auto pictureWith = [&](bool normals) {
    const std::string name = normals ? "with_normals" : "without_normals";
    writeModel(name + ".obj", bumpyFloor(normals));
    Studio studio(headless(writeScene(name,
                                      "[camera]\nposition = [0, 0.7, 1.2]\ntarget = [0, 0, 0]\n[[light]]\n"
                                      "position = [1, 1, 0.5]\nintensity = 2\n[[mirror]]\nposition = [0, 0.3, -1]\n"
                                      "size = [2, 1]\n[[object]]\nmodel = \"" +
                                          name + ".obj\"\n" + rest()),
                           floorSize));
    EXPECT_EQ(studio.scene.meshes[0].flatVertices > 0, !normals);
    return studio.fresh();
  };
  const PictureAgreement agreement = difference(pictureWith(true), pictureWith(false), 1);
  EXPECT_TRUE(agreement.holds()) << agreement.over;
}

INSTANTIATE_TEST_SUITE_P(Methods, FlatShading, testing::Bool(),
                         [](const auto& info) { return info.param ? "Rays" : "Draws"; });
INSTANTIATE_TEST_SUITE_P(Shading, TextureFilters, testing::Values(false, true),
                         [](const auto& info) { return info.param ? "Rays" : "Draws"; });

TEST(TextureFormat, EightBitsStayWhereTheDeviceDecodesThemExactly) {
  Uploader& uploader = Gpu::shared().renderer.uploader();
  const Image8 texture = madePicture(64, 64, [](int x, int y) { return glm::ivec4(4 * x, 4 * y, x ^ y, 255); });
  const std::filesystem::path file = squareWith("codes", texture, 1,
                                                "[camera]\nposition = [0, 0, 1]\ntarget = [0, 0, 0]\n"
                                                "vertical_fov = 90\n[environment]\nambient = [1, 1, 1]\n[[object]]\n"
                                                "model = \"codes.obj\"\n");
  const auto bytesWith = [&](std::optional<bool> exact) {
    uploader.exactSrgb = exact;
    Studio studio(headless(file, {64, 64}, {{"view.samples", "1"}, {"debug.check_finite", "false"}}));
    const Image8 picture = studio.fresh();
    for (int i = 0; i < 64 * 64; ++i) {
      for (int channel = 0; channel < 3; ++channel) {
        EXPECT_NEAR(picture.rgba[4 * i + channel], texture.rgba[4 * i + channel], 1) << i;
      }
    }
    return studio.sceneRenderer.ledger()[EffectKind::textures].bytes;
  };
  constexpr uint64_t texels = 64 * 64;
  EXPECT_EQ(bytesWith(true), 4 * texels * 4 / 3) << "mip levels add a third";
  EXPECT_EQ(bytesWith(false), 8 * texels * 4 / 3);
  double error = 0.0;
  const std::array<float, 256> decoded = uploader.decodedSrgb();
  for (size_t code = 1; code < decoded.size(); ++code) {
    error = std::max(error, std::abs(decoded[code] / srgbDecode(static_cast<double>(code) / 255.0) - 1.0));
  }
  EXPECT_EQ(bytesWith(std::nullopt), (error <= 0x1p-10 ? 4 : 8) * texels * 4 / 3) << "error " << error;
}

}  // namespace
}  // namespace speculum
