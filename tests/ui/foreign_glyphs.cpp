#include "ui/foreign_glyphs.hpp"

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

TEST(ForeignGlyphs, AFoldersNamesAreReadOnceItIsListed) {
  ForeignGlyphs glyphs;
  PanelState::Files files;
  files.listed = "/a";
  glyphs.noteFiles(files);
  EXPECT_FALSE(glyphs.takeNew());
  files.listed = "/\xe9\x8f\xa1";
  glyphs.noteFiles(files);
  EXPECT_TRUE(glyphs.takeNew());
}

}  // namespace
}  // namespace speculum::test
