#include "edit/recovery.hpp"
#include "edit/scene_document.hpp"
#include "fuzz_support.hpp"
#include "platform/process.hpp"

namespace speculum::fuzz {

namespace fs = std::filesystem;

// The first line of the input is the name of the scene, the rest its text.
bool checkRecovery(std::string_view input) {
  static const TemporaryFolder folder;
  setEnvironment("XDG_CONFIG_HOME", folder.path().string());
  folder.write("speculum/t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const size_t line = std::min(input.find('\n'), input.size());
  std::string name(input.substr(0, line));
  std::ranges::replace(name, '/', '_');
  std::ranges::replace(name, '\0', '_');
  name = name.empty() ? "untitled" : name;
  const std::string text(input.substr(std::min(line + 1, input.size())));

  const fs::path kept = Recovery().keep(name, "/scenes/" + name, [&](const fs::path&) { return text; });
  Recovery recovery;
  require(Recovery::originalOf(kept) == "/scenes/" + name, "a copy knows its original");
  require(recovery.findNewest() == kept, "a copy that nobody holds is offered");
  require(Recovery().findNewest().empty(), "a copy is offered once");
  require(readText(kept) == text, "a copy has what was kept");
  Scene scene;
  const bool read = accepted([&] {
    scene = loadScene(kept);
    settingsOf(scene);  // as opening it does
  });
  recovery.setScene(kept);
  if (read) {
    const SceneDocument document(scene);
    const auto again = [&](const fs::path& file) { return document.text(file, {}, ReadBack::untested); };
    require(recovery.keep(kept.stem().string(), "", again) == kept, "a scene that goes on has one copy");
    require(readText(kept) == text, "a scene that was not changed has the same text");
  }
  recovery.forget();
  require(!fs::exists(kept), "copies of changes that are saved are gone");
  return read;
}

}  // namespace speculum::fuzz
