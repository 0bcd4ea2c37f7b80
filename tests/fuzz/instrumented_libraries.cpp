// The distribution's builds of these two parsers know no sanitizer and no coverage; here they stand in for them.
#define TINYOBJLOADER_IMPLEMENTATION
#include <tiny_obj_loader.h>
#define TOML_IMPLEMENTATION
#include <toml++/toml.h>
