#include "ui/foreign_glyphs.hpp"

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
