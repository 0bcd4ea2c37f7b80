// The code of tinygltf's header, for systems that package the header only.
#include <fstream>  // which the header leaves out without its reader of files, and needs for its writer

#define TINYGLTF_IMPLEMENTATION
#include <tiny_gltf.h>
