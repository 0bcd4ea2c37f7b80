#include <cstdlib>
#include <iostream>

#include "models.hpp"
#include "paints.hpp"

namespace {

using namespace speculum::generator;

void writeAll(const std::filesystem::path& directory) {
  std::filesystem::create_directories(directory);
  writeTextures(directory);
  torusKnot(104, 12, paints::kGold).write(directory, "torus_knot");
  Model upright;
  upright.append(torusKnot(132, 16, paints::kGold), place({0.0, 0.506, -0.251}, {90.0, 0.0, 0.0}));
  upright.write(directory, "torus_knot_upright");
  sphere(36, 18, paints::kPorcelain).write(directory, "sphere");
  gem(paints::kRuby).write(directory, "gem");
  ammonite(168, 14, paints::kShell).write(directory, "ammonite");
  vase(paints::kGlaze).close().write(directory, "vase");
  moebius(80, 16, paints::kBronze).write(directory, "moebius");
  teapot(6, paints::kPorcelain).write(directory, "teapot");
  pawn(paints::kIvory).write(directory, "pawn");
  rook(paints::kIvory).close().write(directory, "rook");
  bishop(paints::kIvory).write(directory, "bishop");
  queen(paints::kIvory).write(directory, "queen");
  king(paints::kIvory).write(directory, "king");
  column().close().write(directory, "column");
  pedestal().close().write(directory, "pedestal");
  plinth().close().write(directory, "plinth");
  post().close().write(directory, "post");
  baluster().close().write(directory, "baluster");
  bench().close().write(directory, "bench");
  arcadeBay().write(directory, "arcade_bay");
  arch().close().write(directory, "arch");
  room().write(directory, "room");
  coffers().write(directory, "coffers");
  chequer(BoxFaces::allButBottom).close().write(directory, "chequer");
  chequer(BoxFaces::top).write(directory, "chequer_inlay");
  tile().close().write(directory, "tile");
  lamp().close().write(directory, "lamp");
  block().write(directory, "block");
  box().write(directory, "box");
  frame(Opening::rectangle, 1.0, 1.0, 0.12, paints::kGold).write(directory, "frame");
  frame(Opening::rectangle, 3.0, 2.0, 0.20, paints::kGold).write(directory, "frame_wide");
  frame(Opening::rectangle, 1.0, 2.0, 0.14, paints::kGold).write(directory, "frame_tall");
  frame(Opening::arch, 2.4, 3.4, 0.20, paints::kGold).write(directory, "frame_arch");
  frame(Opening::ellipse, 1.5, 1.5, 0.16, paints::kGold).write(directory, "frame_round");
}

}  // namespace

int main(int argc, char** argv) {
  const int64_t triangles = argc == 3 ? std::atoll(argv[2]) : 0;
  if ((argc != 2 && argc != 3) || (argc == 3 && triangles < 1000)) {
    std::cerr
        << "speculum_models FOLDER: writes the models and textures of the demo\n"
           "speculum_models FILE.obj TRIANGLES: writes one large mesh for benchmarks, of 1000 triangles or more\n";
    return 2;
  }
  try {
    if (triangles > 0) {
      std::cout << writeLargeKnot(argv[1], triangles) << " triangles\n";
    } else {
      writeAll(argv[1]);
    }
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
  return 0;
}
