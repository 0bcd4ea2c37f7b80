#pragma once

#include <cstdint>
#include <filesystem>

#include "model.hpp"
#include "profile.hpp"

namespace speculum::generator {

// Every model stands on y = 0 (frames: on z = 0, looking along +Z), centred in x and z, without a face in that plane.

Model torusKnot(int along, int around, const Paint& paint);  // (2, 3) knot about Y, 1 m high; 2 along around triangles
Model sphere(int around, int up, const Paint& paint);        // radius 0.5, centred at the origin
Model gem(const Paint& paint);                               // brilliant cut, flat facets, 0.8 m
Model ammonite(int along, int around,
               const Paint& paint);  // a ribbed spiral shell in the XY plane, 0.9 m, open at its mouth
Model vase(const Paint& paint);      // twisted and fluted, 0.9 m high
Model moebius(int along, int across, const Paint& paint);  // a Moebius band of finite thickness, 1 m

// M. Newell's teapot (1975): 32 bicubic patches of `steps` x `steps` cells, 1.27 m from handle to spout.
Model teapot(int steps, const Paint& paint);

Model pawn(const Paint& paint);    // 0.50 m
Model rook(const Paint& paint);    // 0.56 m
Model bishop(const Paint& paint);  // 0.78 m
Model queen(const Paint& paint);   // 0.90 m
Model king(const Paint& paint);    // 1.00 m

Model column();     // fluted, 3.4 m high, base 0.72 m wide
Model pedestal();   // 1 m high, 0.6 m wide
Model post();       // round, 2.52 m high, 0.12 m thick
Model plinth();     // round, 0.35 m high, 1.1 m across
Model bench();      // 1.6 m long, 0.45 m high
Model arcadeBay();  // 3 m wide, 4.6 m high wall in z = 0 facing +Z with an arched opening of 2 m, 0.5 m deep
Model arch();       // free-standing gate of two columns' width, 2.6 m high
Model room();       // 10 x 4.6 x 15 m: end walls and one long wall with panels and mouldings; open on -X, and above
Model coffers();    // 2 x 2 m of coffered ceiling in y = 0 seen from below
// 4 x 4 m: the light squares (0.5 m) of a chequered floor, 1.5 mm high with cut edges. BoxFaces::top suits a floor in
// y = 0 that hides what is below.
Model chequer(BoxFaces faces);
Model baluster();  // turned, 0.75 m high
Model tile();      // 1 x 1 m slab, 0.02 m high, with cut edges
Model lamp();      // hanging lamp; its hook is at y = 0 and it hangs 1.2 m down
Model box();       // the unit cube on y = 0 with cut edges
Model block();     // the same in marble

// Moulded frame around an opening of width x height with its lip 0.035 m above z = 0; a mirror at z = 0.02 that is
// 0.02 m larger than the opening on every side fits under it. The outer edge reaches back to z = -0.05.
enum class Opening { rectangle, arch, ellipse };
Model frame(Opening opening, double width, double height, double border, const Paint& paint);

// marble_white.png, marble_green.png, plaster.png, wood.png: tileable procedural textures.
void writeTextures(const std::filesystem::path& directory);

// A torus knot with waves of about `triangles` triangles (within 1 %), streamed to an OBJ file without a material.
// Returns the number written.
int64_t writeLargeKnot(const std::filesystem::path& file, int64_t triangles);

}  // namespace speculum::generator
