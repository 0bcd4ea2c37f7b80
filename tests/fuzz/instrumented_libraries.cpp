// Builds these parsers with sanitizers and coverage, which the distribution's builds lack.
#define TOML_IMPLEMENTATION
#include <toml++/toml.h>
#define TINYGLTF_IMPLEMENTATION
#include <tiny_gltf.h>
