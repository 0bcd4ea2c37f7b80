// Builds these two parsers with sanitizers and coverage, which the distribution's builds lack.
#define TINYOBJLOADER_IMPLEMENTATION
#include <tiny_obj_loader.h>
#define TOML_IMPLEMENTATION
#include <toml++/toml.h>
