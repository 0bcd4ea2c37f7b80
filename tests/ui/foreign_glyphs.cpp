#include "ui/foreign_glyphs.hpp"

#include <fmt/format.h>

#include "platform/bytes.hpp"
#include "platform/files.hpp"
#include "temporary_folder.hpp"
#include "test_headers.hpp"

namespace speculum::test {
namespace {

TEST(ForeignGlyphs, ComeFromTheSystemsFonts) {
  ForeignGlyphs glyphs;
  glyphs.note("Spiegel \xc3\xa4, \xd0\x96");
  EXPECT_FALSE(glyphs.takeNew()) << "the panels' own font has these";
  glyphs.note("\xe1\x83\x9b\xe1\x83\x98 \xff\x1b");  // two Georgian letters; what is no character
  EXPECT_TRUE(glyphs.takeNew());
  EXPECT_FALSE(glyphs.takeNew());
  ImFontAtlas atlas;
  const ImFont* font = atlas.AddFontDefault();
  glyphs.addTo(atlas, 15.0f);
  ASSERT_TRUE(atlas.Build());
  EXPECT_TRUE(font->FindGlyphNoFallback(0x10db));
  EXPECT_TRUE(font->FindGlyphNoFallback(0x10d8));
  EXPECT_FALSE(font->FindGlyphNoFallback(0x10d9)) << "nothing shows it";
}

// Fontconfig may name a font of a format that Dear ImGui asserts on: some systems have these in Type 1 alone.
TEST(ForeignGlyphs, FontsOfOtherFormatsAreLeftOut) {
  ForeignGlyphs glyphs;
  glyphs.note("\xef\x9b\x99\xef\x9b\x9a");  // U+F6D9, U+F6DA
  ImFontAtlas atlas;
  atlas.AddFontDefault();
  glyphs.addTo(atlas, 15.0f);
  EXPECT_TRUE(atlas.Build());
}

// Returns the width of a letter of DejaVu Sans, whose lines are made higher by the ascent in its table hhea.
float widthOfLetter(uint8_t ascent) {
  const TemporaryFolder folder;
  std::string font = readText(systemFont());
  const size_t entry = font.find("hhea");
  font[bigEndian(font.substr(entry + 8, 4)) + 4] = static_cast<char>(ascent);
  folder.write("font.ttf", font);
  const auto fonts = folder.write(
      "fonts.conf",
      fmt::format("<fontconfig><dir>{0}</dir><cachedir>{0}</cachedir></fontconfig>", folder.path().string()));
  ForeignGlyphs glyphs;
  glyphs.note("\xe1\x83\x9b");  // U+10DB
  ImFontAtlas atlas;
  const ImFont* all = atlas.AddFontDefault();
  ::setenv("FONTCONFIG_FILE", fonts.c_str(), 1);
  glyphs.addTo(atlas, 60.0f);
  ::unsetenv("FONTCONFIG_FILE");
  EXPECT_TRUE(atlas.Build());
  const ImFontGlyph* letter = all->FindGlyphNoFallback(0x10db);
  return letter ? letter->X1 - letter->X0 : 0.0f;
}

TEST(ForeignGlyphs, FontsOfTallLinesHaveLettersAsLarge) {
  const float width = widthOfLetter(7);
  EXPECT_GT(width, 20.0f);
  EXPECT_NEAR(widthOfLetter(14), width, 1.0f);
}

TEST(ForeignGlyphs, NamesOfAListedFolderAreRead) {
  const TemporaryFolder folder;
  folder.write("\xe9\x8f\xa1.toml", "");
  ForeignGlyphs glyphs;
  PanelState::Files files;
  files.listed = folder.path();
  glyphs.noteFiles(files);
  EXPECT_FALSE(glyphs.takeNew());
  files.entries.assign(std::filesystem::directory_iterator(folder.path()), {});
  glyphs.noteFiles(files);
  EXPECT_TRUE(glyphs.takeNew());
}

}  // namespace
}  // namespace speculum::test
