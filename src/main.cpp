#include "cli/commands.hpp"

int main(int argc, char** argv) {
  return speculum::speculumMain(argc, argv);
}
