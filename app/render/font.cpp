#include "render/font.h"

#include <ft2build.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include FT_FREETYPE_H

#include "mesh/error.h"
#include "render/embedded.h"

namespace isorelax::render {

struct Font::Impl {
  FT_Library library = nullptr;
  FT_Face face = nullptr;
  double digit_advance = 0;
  double cap_height = 0;
  std::unordered_map<char32_t, Glyph> glyphs;

  ~Impl() {
    FT_Done_Face(face);
    FT_Done_FreeType(library);
  }

  Glyph rasterize(char32_t character) const {
    if (FT_Load_Char(face, character, FT_LOAD_NO_HINTING | FT_LOAD_RENDER) != 0)
      throw Error("the built-in font has no usable glyph for U+" + std::to_string(character));
    const FT_GlyphSlot slot = face->glyph;
    Glyph glyph;
    glyph.left = slot->bitmap_left;
    glyph.top = slot->bitmap_top;
    glyph.width = static_cast<int>(slot->bitmap.width);
    glyph.height = static_cast<int>(slot->bitmap.rows);
    for (int row = 0; row < glyph.height; ++row) {
      const unsigned char* start = slot->bitmap.buffer + std::ptrdiff_t{row} * slot->bitmap.pitch;
      glyph.coverage.insert(glyph.coverage.end(), start, start + glyph.width);
    }
    glyph.advance = static_cast<double>(slot->linearHoriAdvance) / 65536.0;
    return glyph;
  }

  /// Numbers stand below each other digit by digit: every digit gets the widest one's advance, centred.
  void even_out_digits() {
    for (char32_t c = U'0'; c <= U'9'; ++c) {
      glyphs[c] = rasterize(c);
      digit_advance = std::max(digit_advance, glyphs[c].advance);
    }
    for (char32_t c = U'0'; c <= U'9'; ++c) {
      Glyph& glyph = glyphs[c];
      glyph.left += static_cast<int>(std::lround(0.5 * (digit_advance - glyph.advance)));
      glyph.advance = digit_advance;
    }
  }
};

Font::Font(double pixels) : impl_(std::make_unique<Impl>()) {
  const std::string_view bytes = embedded_file("Inter-Regular.otf");
  const auto size = static_cast<FT_F26Dot6>(std::lround(64 * std::max(pixels, 1.0)));
  if (FT_Init_FreeType(&impl_->library) != 0 ||
      FT_New_Memory_Face(impl_->library, reinterpret_cast<const FT_Byte*>(bytes.data()),
                         static_cast<FT_Long>(bytes.size()), 0, &impl_->face) != 0 ||
      FT_Set_Char_Size(impl_->face, 0, size, 72, 72) != 0)
    throw Error("FreeType cannot read the built-in font");
  impl_->even_out_digits();
  impl_->cap_height = glyph(U'H').top;
}

Font::~Font() = default;

const Glyph& Font::glyph(char32_t character) {
  const auto found = impl_->glyphs.find(character);
  if (found != impl_->glyphs.end()) return found->second;
  return impl_->glyphs.emplace(character, impl_->rasterize(character)).first->second;
}

double Font::width(std::string_view text) {
  double sum = 0;
  for (const char32_t c : decode_utf8(text)) sum += glyph(c).advance;
  return sum;
}

std::string Font::fitted(std::string_view text, double room) {
  if (width(text) <= room) return std::string(text);
  const auto continues = [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; };
  while (!text.empty()) {
    while (text.size() > 1 && continues(text.back())) text.remove_suffix(1);
    text.remove_suffix(1);
    std::string shorter = std::string(text) + "\xE2\x80\xA6";
    if (width(shorter) <= room) return shorter;
  }
  return {};
}

double Font::cap_height() const {
  return impl_->cap_height;
}

std::u32string decode_utf8(std::string_view text) {
  std::u32string decoded;
  for (std::size_t i = 0; i < text.size();) {
    const auto first = static_cast<unsigned char>(text[i++]);
    const int following = first < 0x80   ? 0
                          : first < 0xC2 ? -1
                          : first < 0xE0 ? 1
                          : first < 0xF0 ? 2
                          : first < 0xF5 ? 3
                                         : -1;
    char32_t c = following <= 0 ? first : first & (0x3FU >> following);
    bool good = following >= 0;
    for (int k = 0; good && k < following; ++k) {
      good = i < text.size() && (static_cast<unsigned char>(text[i]) & 0xC0U) == 0x80U;
      if (good) c = (c << 6U) | (static_cast<unsigned char>(text[i++]) & 0x3FU);
    }
    decoded += good ? c : U'\xFFFD';
  }
  return decoded;
}

}  // namespace isorelax::render
