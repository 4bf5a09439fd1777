#!/usr/bin/env python3
"""Writes tables.cpp: which characters cannot be seen, which look like others, how accents are composed.

Names, categories and decompositions are those of the Unicode Character Database, as Python's unicodedata has it.
Default-ignorable characters are those of its DerivedCoreProperties.txt, names of control characters those of its
NameAliases.txt, and look-alikes a choice from the confusables.txt of Unicode Technical Standard 39: letters of
Cyrillic, Greek, Armenian, Cherokee and Latin that fonts draw alike or nearly so.

    python3 engine/unicode/tables.py > engine/unicode/tables.cpp
"""
import unicodedata as u

IGNORABLE = [(0xAD, 0xAD), (0x34F, 0x34F), (0x61C, 0x61C), (0x115F, 0x1160), (0x17B4, 0x17B5), (0x180B, 0x180F),
             (0x200B, 0x200F), (0x202A, 0x202E), (0x2060, 0x206F), (0x3164, 0x3164), (0xFE00, 0xFE0F),
             (0xFEFF, 0xFEFF), (0xFFA0, 0xFFA0), (0xFFF0, 0xFFF8), (0x1BCA0, 0x1BCA3), (0x1D173, 0x1D17A),
             (0xE0000, 0xE0FFF)]
# Format characters that are seen: signs that enclose or precede numbers.
SEEN = {*range(0x600, 0x606), 0x6DD, 0x70F, 0x890, 0x891, 0x8E2, 0x110BD, 0x110CD}
BLANK_THOUGH_NO_SPACE = {0x2800, 0x16FE4, 0x1D159}
CONTROLS = {**dict(enumerate(
    "NULL|START OF HEADING|START OF TEXT|END OF TEXT|END OF TRANSMISSION|ENQUIRY|ACKNOWLEDGE|ALERT|BACKSPACE|"
    "CHARACTER TABULATION|LINE FEED|LINE TABULATION|FORM FEED|CARRIAGE RETURN|SHIFT OUT|SHIFT IN|DATA LINK ESCAPE|"
    "DEVICE CONTROL ONE|DEVICE CONTROL TWO|DEVICE CONTROL THREE|DEVICE CONTROL FOUR|NEGATIVE ACKNOWLEDGE|"
    "SYNCHRONOUS IDLE|END OF TRANSMISSION BLOCK|CANCEL|END OF MEDIUM|SUBSTITUTE|ESCAPE|INFORMATION SEPARATOR FOUR|"
    "INFORMATION SEPARATOR THREE|INFORMATION SEPARATOR TWO|INFORMATION SEPARATOR ONE".split("|"))),
    0x7F: "DELETE", 0x85: "NEXT LINE"}

ALIKE = {
    "A": "ΑАᎪ", "B": "ΒВᏴ", "C": "СϹᏟⅭ", "D": "ᎠⅮ", "E": "ΕЕᎬ", "F": "Ϝᖴ", "G": "ԌᏀ", "H": "ΗНᎻ", "I": "ΙІӀӏl1|Ⅰɪǀℓ",
    "J": "ЈͿᎫ", "K": "ΚКᏦK", "L": "ԼᏞⅬ", "M": "ΜМᎷⅯ", "N": "Ν", "O": "ΟОՕ0", "P": "ΡРᏢ", "Q": "Ԛ", "R": "Ꭱ",
    "S": "ЅՏᏚ", "T": "ΤТᎢ", "U": "Ս", "V": "ѴᏙⅤ", "W": "ԜᏔ", "X": "ΧХⅩ", "Y": "ΥУҮ", "Z": "ΖᏃ",
    "a": "αаɑ", "c": "сϲᴄⅽ", "d": "ԁⅾ", "e": "еҽ", "g": "ɡց", "h": "һհ", "i": "іιıⅰᎥ", "j": "јϳ", "k": "κкᴋ",
    "m": "м", "n": "ηոп", "o": "οоօσᴏ", "p": "ρрϱ", "q": "ԛզ", "r": "гᴦ", "s": "ѕꜱ", "t": "тτ", "u": "υսᴜʋ",
    "v": "νѵⅴᴠ", "w": "ԝωᴡ", "x": "хⅹ×", "y": "уγүყ", "z": "ᴢ", "3": "ЗӠƷ", "6": "б", "b": "Ььƅ",
    "-": "‐‑‒–—―−﹘﹣", "'": "’‘ʼ′`´ʹ", "_": "﹍﹎﹏", ".": "․", ":": "：ː∶",
    "μ": "µ", "β": "ß", "ф": "φ",
}


def hidden(c):
    ch = chr(c)
    if any(a <= c <= b for a, b in IGNORABLE) or c in BLANK_THOUGH_NO_SPACE:
        return True
    if c == 0x20 or 0xD800 <= c < 0xE000:
        return False
    return (u.category(ch) in ("Cc", "Zs", "Zl", "Zp") or (u.category(ch) == "Cf" and c not in SEEN)
            or c & 0xFFFE == 0xFFFE or 0xFDD0 <= c <= 0xFDEF)


def ranges(members):
    out = []
    for c in members:
        if out and out[-1][1] == c - 1:
            out[-1][1] = c
        else:
            out.append([c, c])
    return out


def rows(items, width=112):
    line = " "
    for item in items:
        if len(line) + len(item) + 2 > width:
            print(line)
            line = " "
        line += " " + item + ","
    print(line)


def table(head, items, width=112):
    print(head + "{")
    rows(items, width)
    print("};\n")


def main():
    every = [c for c in range(0x110000) if not 0xD800 <= c < 0xE000]
    blanks = [c for c in every if hidden(c) and (u.category(chr(c)) == "Zs" or c in BLANK_THOUGH_NO_SPACE)]
    nothing = [c for c in every if hidden(c) and c not in blanks]
    # Of letters and marks that are written in one piece or in several; Hangul is composed by rule, and the
    # compatibility ideographs are not letters that people type.
    composed = []
    for c in every:
        whole = u.normalize("NFD", chr(c))
        if whole == chr(c) or 0xAC00 <= c < 0xD7A4 or 0xF900 <= c < 0xFB00 or c >= 0x2F800:
            continue
        parts = [ord(p) for p in whole]
        composed.append((c, parts))
    alike = sorted({(ord(x), ord(to)) for to, all_ in ALIKE.items() for x in all_ if x != to})
    viramas = [c for c in every if u.combining(chr(c)) == 9]
    marks = [c for c in every if u.category(chr(c)) in ("Mn", "Me")]
    wide = [c for c in every if u.east_asian_width(chr(c)) in ("W", "F")]
    names = {}
    for c in blanks + nothing:
        names[c] = CONTROLS.get(c) or u.name(chr(c), "")
    for c, to in alike:
        names[c], names[to] = u.name(chr(c)), u.name(chr(to))
    for c in range(0x300, 0x370):
        names[c] = u.name(chr(c), "")
    skip = lambda c: 0xFE00 <= c <= 0xFE0F or c >= 0xE0000 or not names[c]

    print("// Made by tables.py from the Unicode Character Database, version " + u.unidata_version + ".\n")
    print('#include "engine/unicode/tables.h"\n\nnamespace stadion::unicode {\n')
    print("// clang-format off")
    pair = lambda r: f"{{0x{r[0]:X}, 0x{r[1]:X}}}"
    for name, members in (("kBlanks", blanks), ("kNothing", nothing), ("kViramas", viramas), ("kMarks", marks),
                          ("kWide", wide)):
        table(f"constexpr Range {name}_[] = ", [pair(r) for r in ranges(members)])
    table("constexpr Alike kAlike_[] = ", [pair(p) for p in alike])
    table("constexpr Composition kComposed_[] = ",
          ["{0x%X, {%s}}" % (c, ", ".join(f"0x{p:X}" for p in parts)) for c, parts in composed])
    table("constexpr CharacterName kNames_[] = ", ['{0x%X, "%s"}' % (c, names[c]) for c in sorted(names) if not skip(c)], 200)
    print("// clang-format on")
    for kind, name in (("Range", "kBlanks"), ("Range", "kNothing"), ("Range", "kViramas"), ("Range", "kMarks"),
                       ("Range", "kWide"), ("Alike", "kAlike"), ("Composition", "kComposed"), ("CharacterName", "kNames")):
        print(f"const std::span<const {kind}> {name} = {name}_;")
    print("\n}  // namespace stadion::unicode")


main()
