// The code of tinygltf's header, for systems that package the header only.
#define TINYGLTF_IMPLEMENTATION
#include <tiny_gltf.h>
