// The code of tinyobjloader's header, for systems that package the header only.
#define TINYOBJLOADER_IMPLEMENTATION
#include <tiny_obj_loader.h>
