#include "cli/commands.hpp"
#include "platform/process.hpp"

int main(int argc, char** argv) {
  const std::vector<const char*> arguments = speculum::prepareProcess(argc, argv);
  return speculum::speculumMain(static_cast<int>(arguments.size()), arguments.data());
}
