#include "engine/text/glyphs.h"

#include <algorithm>

namespace stadion {
namespace {

constexpr Glyph kGlyphs[] = {
    {U' ', 34, ""},
    {U'!', 32, "M16 100L16 32;D16 8"},
    {U'"', 54, "M16 104L16 70;M38 104L38 70"},
    {U'#', 84, "M22 0L36 100;M48 0L62 100;M6 34L74 34;M10 66L78 66"},
    {U'$', 74, "A38 72 24 21 30 270A38 29 26 22 90 -150;M38 112L38 -12"},
    {U'%', 112, "A26 76 16 18 0 360Z;A86 24 16 18 0 360Z;M88 100L24 0"},
    {U'&', 92, "M84 0L28 66A40 79 17 15 225 -45L21 45A37 29 25 22 140 330L82 54"},
    {U'\'', 32, "M16 104L16 70"},
    {U'(', 38, "A54 46 42 70 126 234"},
    {U')', 38, "A-16 46 42 70 54 -54"},
    {U'*', 56, "M28 104L28 62;M10 93L46 73;M46 93L10 73"},
    {U'+', 72, "M8 45L64 45;M36 17L36 73"},
    {U',', 30, "M16 16L9 -16"},
    {U'-', 48, "M6 38L42 38"},
    {U'.', 30, "D15 8"},
    {U'/', 50, "M8 -10L42 104"},
    {U'0', 72, "A36 50 25 44 0 360Z"},
    {U'1', 72, "M42 0L42 100;M36 100L16 72"},
    {U'2', 72, "A36 68 25 25 168 -38L19 9;M9 7L65 7"},
    {U'3', 72, "A34 73 23 20 150 -90L26 53;M26 53L34 53A34 30 26 23 90 -150"},
    {U'4', 72, "M50 0L50 100;M49 100L11 27;M3 27L68 27"},
    {U'5', 72, "M62 93L19 93;M20 100L18 46;A36 31 25 24 137 -150"},
    {U'6', 72, "A37 30 25 23 0 360Z;M50 100L17 43"},
    {U'7', 72, "M8 93L64 93;M57 100L26 0"},
    {U'8', 72, "A36 73 21 20 0 360Z;A36 30 25 23 0 360Z"},
    {U'9', 72, "A35 70 25 23 0 360Z;M22 0L55 57"},
    {U':', 30, "D15 8;D15 60"},
    {U';', 30, "M16 16L9 -16;D15 60"},
    {U'<', 72, "M60 73L16 45L60 17"},
    {U'=', 72, "M8 57L64 57;M8 33L64 33"},
    {U'>', 72, "M12 73L56 45L12 17"},
    {U'?', 66, "A33 71 23 22 165 -50L34 44L34 32;D34 8"},
    {U'A', 80, "M9 0L38 100;M71 0L42 100;M18 30L62 30"},
    {U'B', 80, "M16 0L16 100;M16 93L42 93A42 73 21 20 90 -90L16 53;M42 53L45 53A45 30 24 23 90 -90L16 7"},
    {U'C', 88, "A52 50 40 44 48 312"},
    {U'D', 92, "M16 0L16 100;M16 93L37 93A37 50 43 43 90 -90L16 7"},
    {U'E', 68, "M16 0L16 100;M16 93L62 93;M16 51L57 51;M16 7L63 7"},
    {U'F', 64, "M16 0L16 100;M16 93L60 93;M16 49L55 49"},
    {U'G', 100, "A52 50 40 44 46 360L56 50"},
    {U'H', 90, "M16 0L16 100;M74 0L74 100;M16 51L74 51"},
    {U'I', 32, "M16 0L16 100"},
    {U'J', 62, "M46 100L46 30A26 30 20 23 0 -160"},
    {U'K', 78, "M67 100L21 45;M37 64L70 0;M16 0L16 100"},
    {U'L', 62, "M16 0L16 100;M16 7L59 7"},
    {U'M', 108, "M16 0L16 100;M92 0L92 100;M17 100L54 14;M91 100L54 14"},
    {U'N', 94, "M16 0L16 100;M78 0L78 100;M18 100L76 0"},
    {U'O', 106, "A53 50 41 44 0 360Z"},
    {U'P', 76, "M16 0L16 100;M16 93L42 93A42 69 24 24 90 -90L16 45"},
    {U'Q', 106, "A53 50 41 44 0 360Z;M60 32L90 0"},
    {U'R', 79, "M16 0L16 100;M16 93L42 93A42 70 24 23 90 -90L16 47;M42 48L68 0"},
    {U'S', 74, "A38 72 24 21 30 270A38 29 26 22 90 -150"},
    {U'T', 72, "M2 93L70 93;M36 0L36 100"},
    {U'U', 94, "M16 100L16 38A47 38 31 31 180 360L78 100"},
    {U'V', 80, "M9 100L38 0;M71 100L42 0"},
    {U'W', 116, "M9 100L33 0;M56 100L36 0;M60 100L80 0;M107 100L83 0"},
    {U'X', 78, "M10 100L68 0;M68 100L10 0"},
    {U'Y', 76, "M9 100L38 47;M67 100L38 47;M38 52L38 0"},
    {U'Z', 74, "M8 93L66 93;M8 7L68 7;M58 100L16 0"},
    {U'[', 40, "M36 102L16 102L16 -12L36 -12"},
    {U'\\', 50, "M8 104L42 -10"},
    {U']', 40, "M4 102L24 102L24 -12L4 -12"},
    {U'_', 60, "M0 -12L60 -12"},
    {U'a', 78, "A37 35 25 28 0 360Z;M62 0L62 70"},
    {U'b', 78, "A41 35 25 28 0 360Z;M16 0L16 104"},
    {U'c', 62, "A37 35 25 28 48 312"},
    {U'd', 78, "A37 35 25 28 0 360Z;M62 0L62 104"},
    {U'e', 74, "M14 36L62 36A37 36 25 28 0 318"},
    {U'f', 45, "M20 0L20 80A38 80 18 18 180 76;M5 63L40 63"},
    {U'g', 78, "A37 35 25 28 0 360Z;M62 70L62 -4A37 -4 25 21 0 -150"},
    {U'h', 78, "M16 0L16 104;M16 36L16 41A39 41 23 23 180 0L62 0"},
    {U'i', 32, "M16 0L16 70;D16 94"},
    {U'j', 34, "M18 70L18 -6A4 -6 14 19 0 -100;D18 94"},
    {U'k', 66, "M57 70L20 31;M33 45L59 0;M16 0L16 104"},
    {U'l', 32, "M16 0L16 104"},
    {U'm', 112, "M16 0L16 70;M16 36L16 43A36 43 20 21 180 0L56 0;M56 36L56 43A76 43 20 21 180 0L96 0"},
    {U'n', 78, "M16 0L16 70;M16 36L16 41A39 41 23 23 180 0L62 0"},
    {U'o', 76, "A38 35 26 28 0 360Z"},
    {U'p', 78, "A41 35 25 28 0 360Z;M16 -28L16 70"},
    {U'q', 78, "A37 35 25 28 0 360Z;M62 -28L62 70"},
    {U'r', 48, "M16 0L16 70;M16 36L16 42A38 42 22 22 180 72"},
    {U's', 56, "A28 50 17 14 30 270A28 21 18 15 90 -150"},
    {U't', 46, "M20 92L20 26A38 26 18 19 180 284;M5 63L40 63"},
    {U'u', 78, "M16 70L16 30A39 30 23 23 180 360;M62 70L62 0"},
    {U'v', 62, "M8 70L29 0;M54 70L33 0"},
    {U'w', 92, "M8 70L26 0;M44 70L28 0;M48 70L64 0;M84 70L66 0"},
    {U'x', 62, "M9 70L53 0;M53 70L9 0"},
    {U'y', 64, "M8 70L32 -1;M56 70L23 -28"},
    {U'z', 58, "M6 63L50 63;M6 7L52 7;M42 70L15 0"},
    {U'{', 44, "M40 102L26 102L26 58L14 45L26 32L26 -12L40 -12"},
    {U'|', 32, "M16 -20L16 110"},
    {U'}', 44, "M4 102L18 102L18 58L30 45L18 32L18 -12L4 -12"},
    {U'°', 44, "A22 84 13 14 0 360Z"},
    {U'·', 30, "D15 45"},
    {U'×', 72, "M16 65L56 25;M16 25L56 65"},
    {U'ß', 74, "M16 0L16 78A36 78 20 20 180 -60L34 54A44 30 24 23 90 -130"},
    {U'ı', 32, "M16 0L16 70"},
    {U'Γ', 62, "M16 0L16 100;M16 93L60 93"},
    {U'Δ', 88, "M6 7L82 7;M11 0L42 100;M77 0L46 100"},
    {U'Θ', 106, "A53 50 41 44 0 360Z;M36 50L70 50"},
    {U'Λ', 80, "M9 0L38 100;M71 0L42 100"},
    {U'Ξ', 74, "M8 93L66 93;M14 51L60 51;M8 7L66 7"},
    {U'Π', 90, "M16 0L16 100;M74 0L74 100;M16 93L74 93"},
    {U'Σ', 72, "M8 93L64 93;M8 7L66 7;M16 100L42 50;M42 50L16 0"},
    {U'Φ', 100, "A50 50 38 30 0 360Z;M50 0L50 100"},
    {U'Ψ', 96, "M14 100L14 64A48 64 34 30 180 360L82 100;M48 0L48 100"},
    {U'Ω', 106, "M8 7L37 7L37 17A53 54 41 39 245 -65L69 7L98 7"},
    {U'–', 62, "M4 38L58 38"},
    {U'—', 104, "M4 38L100 38"},
    {U'‘', 30, "M9 104L16 72"},
    {U'’', 30, "M16 104L9 72"},
    {U'−', 72, "M8 45L64 45"},
};

constexpr Glyph kMissing{0, 72, "M15 7L57 7L57 93L15 93Z"};

/// Greek capitals that are drawn like Latin ones.
constexpr struct {
  char32_t greek, latin;
} kAlike[] = {{U'Α', U'A'}, {U'Β', U'B'}, {U'Ε', U'E'}, {U'Ζ', U'Z'}, {U'Η', U'H'},
              {U'Ι', U'I'}, {U'Κ', U'K'}, {U'Μ', U'M'}, {U'Ν', U'N'}, {U'Ο', U'O'},
              {U'Ρ', U'P'}, {U'Τ', U'T'}, {U'Υ', U'Y'}, {U'Χ', U'X'}, {U'\u00A0', U' '}};

constexpr char32_t kGrave = 0x300, kAcute = 0x301, kCircumflex = 0x302, kTilde = 0x303, kDiaeresis = 0x308,
                   kRing = 0x30A, kCedilla = 0x327;

/// The accented letters of Latin-1: U+00C0 to U+00FF, a base letter and its mark, or nothing.
struct Accented {
  char32_t base = 0, mark = 0;
};
constexpr Accented kAccented[64] = {{U'A', kGrave},
                                    {U'A', kAcute},
                                    {U'A', kCircumflex},
                                    {U'A', kTilde},
                                    {U'A', kDiaeresis},
                                    {U'A', kRing},
                                    {},
                                    {U'C', kCedilla},
                                    {U'E', kGrave},
                                    {U'E', kAcute},
                                    {U'E', kCircumflex},
                                    {U'E', kDiaeresis},
                                    {U'I', kGrave},
                                    {U'I', kAcute},
                                    {U'I', kCircumflex},
                                    {U'I', kDiaeresis},
                                    {},
                                    {U'N', kTilde},
                                    {U'O', kGrave},
                                    {U'O', kAcute},
                                    {U'O', kCircumflex},
                                    {U'O', kTilde},
                                    {U'O', kDiaeresis},
                                    {},
                                    {},
                                    {U'U', kGrave},
                                    {U'U', kAcute},
                                    {U'U', kCircumflex},
                                    {U'U', kDiaeresis},
                                    {U'Y', kAcute},
                                    {},
                                    {},
                                    {U'a', kGrave},
                                    {U'a', kAcute},
                                    {U'a', kCircumflex},
                                    {U'a', kTilde},
                                    {U'a', kDiaeresis},
                                    {U'a', kRing},
                                    {},
                                    {U'c', kCedilla},
                                    {U'e', kGrave},
                                    {U'e', kAcute},
                                    {U'e', kCircumflex},
                                    {U'e', kDiaeresis},
                                    {U'ı', kGrave},
                                    {U'ı', kAcute},
                                    {U'ı', kCircumflex},
                                    {U'ı', kDiaeresis},
                                    {},
                                    {U'n', kTilde},
                                    {U'o', kGrave},
                                    {U'o', kAcute},
                                    {U'o', kCircumflex},
                                    {U'o', kTilde},
                                    {U'o', kDiaeresis},
                                    {},
                                    {},
                                    {U'u', kGrave},
                                    {U'u', kAcute},
                                    {U'u', kCircumflex},
                                    {U'u', kDiaeresis},
                                    {U'y', kAcute},
                                    {},
                                    {U'y', kDiaeresis}};

bool among(std::u32string_view set, const Glyph& g) {
  return g.character != 0 && set.find(g.character) != set.npos;
}

}  // namespace

const Glyph* findGlyph(char32_t character) {
  for (const auto& pair : kAlike)
    if (pair.greek == character) character = pair.latin;
  const auto at = std::ranges::lower_bound(kGlyphs, character, {}, &Glyph::character);
  return at != std::end(kGlyphs) && at->character == character ? at : nullptr;
}

std::string_view pathOfMark(char32_t mark) {
  switch (mark) {
  case kGrave: return "M-8 104L6 80";
  case kAcute: return "M8 104L-6 80";
  case kCircumflex: return "M-17 81L0 97L17 81";
  case kTilde: return "M-20 86L-7 95L7 86L20 95";
  case kDiaeresis: return "D-14 93;D14 93";
  case kRing: return "A0 93 10 10 0 360Z";
  case kCedilla: return "M2 4L2 -6L8 -14L-6 -26";
  default: return "";
  }
}

DrawnCharacter drawn(char32_t character) {
  if (character >= 0xC0 && character <= 0xFF)
    if (const Accented& a = kAccented[character - 0xC0]; a.base != 0)
      return {findGlyph(a.base), a.mark, a.base < U'a' && a.mark != kCedilla, false};
  if (const Glyph* glyph = findGlyph(character)) return {glyph, 0, false, false};
  return {&kMissing, 0, false, true};
}

double kerning(const Glyph& left, const Glyph& right) {
  constexpr std::u32string_view rising = U"AΛΔ", falling = U"VWY", roof = U"T", arm = U"FPΓ", low = U".,";
  if (among(rising, left) && (among(falling, right) || among(roof, right))) return -13;
  if ((among(falling, left) || among(roof, left) || among(arm, left)) && among(rising, right)) return -13;
  if (among(U"L", left) && (among(falling, right) || among(roof, right))) return -13;
  if ((among(falling, left) || among(roof, left) || among(arm, left)) && among(low, right)) return -13;
  if (among(U"TVYF", left) && among(U"acdegmnopqrsu", right)) return -10;
  return 0;
}

std::vector<char32_t> charactersOf(std::string_view utf8) {
  constexpr char32_t kReplacement = 0xFFFD;
  std::vector<char32_t> out;
  for (std::size_t i = 0; i < utf8.size();) {
    const auto first = static_cast<unsigned char>(utf8[i++]);
    const int more = first < 0x80       ? 0
                     : first >> 5 == 6  ? 1
                     : first >> 4 == 14 ? 2
                     : first >> 3 == 30 ? 3
                                        : -1;
    if (more < 0) {
      out.push_back(kReplacement);
      continue;
    }
    char32_t c = more == 0 ? first : first & (0x3FU >> more);
    int read = 0;
    for (; read < more && i < utf8.size() && (static_cast<unsigned char>(utf8[i]) & 0xC0) == 0x80; ++read)
      c = c << 6 | (static_cast<unsigned char>(utf8[i++]) & 0x3FU);
    out.push_back(read == more ? c : kReplacement);
  }
  return out;
}

std::vector<char32_t> missingFrom(std::string_view utf8) {
  std::vector<char32_t> missing;
  for (const char32_t c : charactersOf(utf8))
    if (c != U'\n' && drawn(c).missing && std::ranges::find(missing, c) == missing.end())
      missing.push_back(c);
  return missing;
}

}  // namespace stadion
