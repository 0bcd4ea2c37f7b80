// The tables of docs/ that list settings follow from their descriptions. UPDATE_DOCS=1 in the environment rewrites
// them.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "frame/setting_fields.hpp"
#include "test_paths.hpp"

namespace speculum {
namespace {

// In a table '|' would end the cell.
std::string cell(std::string_view text) {
  std::string cell;
  for (const char c : text) {
    cell.append(c == '|' ? "\\|" : c == '\n' ? " " : std::string(1, c));
  }
  return cell;
}

std::string settingsTable(std::string_view group) {
  std::string table = "| key | default | values | meaning | cost |\n|---|---|---|---|---|\n";
  for (const SettingField& field : settingFields()) {
    if (field.key.starts_with(group)) {
      const std::string value = settingValue(Settings(), field.key);
      const std::string need =
          field.needs ? "; with `" + std::string(field.needs->key) + "=" + std::string(field.needs->value) + "`" : "";
      table += "| `" + std::string(field.key) + "` | " + (value.empty() ? "none" : "`" + value + "`") + " | " +
               cell(settingRangeWithUnit(field)) + " | " + cell(field.text) + need + " | " + cell(field.cost) + " |\n";
    }
  }
  return table;
}

// Holds the tables of `page` between "<!-- table NAME -->" and "<!-- end -->" against what they should be.
void expectTable(const std::string& page, const std::string& name, const std::string& expected) {
  const std::filesystem::path file = sourceDir() / "docs" / page;
  std::ifstream stream(file);
  std::stringstream content;
  content << stream.rdbuf();
  std::string text = content.str();
  const std::string mark = "<!-- table " + name + " -->\n";
  const size_t begin = text.find(mark);
  const size_t end = text.find("<!-- end -->", begin);
  ASSERT_TRUE(begin != std::string::npos && end != std::string::npos) << page << " lacks " << mark;
  const std::string table = "\n" + expected + "\n";
  if (std::getenv("UPDATE_DOCS")) {
    std::ofstream(file) << text.replace(begin + mark.size(), end - begin - mark.size(), table);
    return;
  }
  EXPECT_EQ(text.substr(begin + mark.size(), end - begin - mark.size()), table)
      << page << ": run frame_tests --gtest_filter='Docs*' with UPDATE_DOCS=1";
}

TEST(DocsTables, ListEverySetting) {
  for (const std::string group : {"reflection", "view", "effects", "quality", "debug"}) {
    expectTable("settings.md", group, settingsTable(group + "."));
  }
}

}  // namespace
}  // namespace speculum
