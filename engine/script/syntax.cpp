#include "engine/script/syntax.h"

#include "engine/unicode/characters.h"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>
#include <tao/pegtl.hpp>

namespace stadion {

namespace {

namespace pegtl = tao::pegtl;
constexpr std::size_t kLongestWordShown = 40;

using Input = pegtl::memory_input<pegtl::tracking_mode::lazy, pegtl::eol::lf_crlf, const char*>;

// --- grammar: each rule decides by its first character, so nothing is read twice
// -------------------------------

struct Comment : pegtl::seq<pegtl::one<'#'>, pegtl::star<pegtl::not_one<'\n', '\r'>>> {};
struct Gap : pegtl::star<pegtl::sor<pegtl::plus<pegtl::one<' ', '\t', '\n', '\r', '\v', '\f'>>, Comment>> {};

struct WordStart : pegtl::ranges<'a', 'z', 'A', 'Z', '_', '_'> {};
struct Word : pegtl::seq<WordStart, pegtl::star<pegtl::sor<WordStart, pegtl::ranges<'0', '9', '-', '-'>>>> {};
struct TypeWord : Word {};
struct AttributeWord : Word {};

// Straight, and typographic: left, right, low, reversed, double prime.
struct Quote : pegtl::utf8::one<0x22, 0x201C, 0x201D, 0x201E, 0x201F, 0x2033> {};
struct Plain : pegtl::plus<pegtl::not_one<'"', '\n', '\r', '\xE2'>> {};
struct QuotedText
    : pegtl::star<pegtl::sor<
          Plain, pegtl::seq<pegtl::not_at<pegtl::sor<Quote, pegtl::one<'\n', '\r'>>>, pegtl::any>>> {};
struct ClosingQuote : Quote {};
struct OpeningQuote : Quote {};
struct QuotedValue : pegtl::seq<OpeningQuote, QuotedText, pegtl::must<ClosingQuote>> {};

struct BareByte
    : pegtl::sor<
          pegtl::not_one<' ', '\t', '\n', '\r', '\v', '\f', ',', '(', ')', '=', '#', '"', '\'', '\xE2'>,
          pegtl::seq<pegtl::not_at<Quote>, pegtl::one<'\xE2'>>> {};
struct BareText : pegtl::plus<BareByte> {};

struct Value : pegtl::sor<QuotedValue, BareText> {};
struct Equals : pegtl::one<'='> {};
struct Attribute : pegtl::seq<AttributeWord, Gap, pegtl::must<Equals>, Gap, pegtl::must<Value>> {};
struct Separator : pegtl::sor<pegtl::one<','>, pegtl::at<pegtl::one<')'>>> {};
struct Entry : pegtl::seq<Attribute, Gap, pegtl::must<Separator>, Gap> {};
struct Open : pegtl::one<'('> {};
struct Close : pegtl::one<')'> {};
struct Declaration
    : pegtl::seq<pegtl::must<TypeWord>, Gap, pegtl::must<Open>, Gap, pegtl::star<Entry>, pegtl::must<Close>> {
};

struct Beginning : pegtl::seq<pegtl::star<pegtl::blank>, Word, pegtl::star<pegtl::blank>, Open> {};

// --- what is noted while reading
// -------------------------------------------------------------------------------

constexpr std::uint32_t kUnset = ~std::uint32_t{0};

struct Reading {
  const char* begin;
  const char* end;
  RawDeclaration declaration;
  const char* quote = nullptr;  // where the quoted value begins that is being read

  std::uint32_t offset(const char* p) const { return static_cast<std::uint32_t>(p - begin); }
  TextSpan span(const char* from, const char* to) const {
    return {offset(from), static_cast<std::uint32_t>(to - from)};
  }
};

template <class Rule>
struct Action : pegtl::nothing<Rule> {};

template <>
struct Action<TypeWord> {
  template <class In>
  static void apply(const In& in, Reading& r) {
    r.declaration.type = r.span(in.begin(), in.end());
  }
};

template <>
struct Action<AttributeWord> {
  template <class In>
  static void apply(const In& in, Reading& r) {
    r.declaration.attributes.push_back({r.span(in.begin(), in.end()), {kUnset, 0}});
  }
};

template <>
struct Action<OpeningQuote> {
  template <class In>
  static void apply(const In& in, Reading& r) {
    r.quote = in.begin();
  }
};

template <>
struct Action<ClosingQuote> {
  template <class In>
  static void apply(const In&, Reading& r) {
    r.quote = nullptr;
  }
};

template <>
struct Action<QuotedText> {
  template <class In>
  static void apply(const In& in, Reading& r) {
    const char* from = in.begin();
    const char* to = in.end();
    while (from < to && (*from == ' ' || *from == '\t')) ++from;
    while (from < to && (to[-1] == ' ' || to[-1] == '\t')) --to;
    r.declaration.attributes.back().value = r.span(from, to);
  }
};

template <>
struct Action<BareText> : Action<QuotedText> {};

// --- errors
// ----------------------------------------------------------------------------------------------------

struct SyntaxError {
  const char* where;
  std::string message;
  bool spoilsLast = false;  // the attribute before it is part of the mistake
};

std::string_view wordAt(std::string_view rest) {
  const auto inWord = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  };
  std::size_t length = 0;
  while (length < rest.size() && length < kLongestWordShown && inWord(rest[length])) ++length;
  return rest.substr(0, length);
}

/// What `rest` begins with, in words.
std::string describe(std::string_view rest) {
  if (rest.empty()) return "the end of the file";
  if (rest[0] == '\n' || rest[0] == '\r') return "the end of the line";
  if (rest[0] == '"') return "a quote";
  const std::string_view word = wordAt(rest);
  if (!word.empty()) return fmt::format("\"{}\"", word);
  std::size_t bytes = 0;
  const char32_t code = unicode::firstCharacter(rest, bytes);
  if (code > 0x20 && code < 0x7F) return fmt::format("\"{}\"", rest[0]);
  return fmt::format("the character {}{}", unicode::nameOf(code),
                     unicode::isHidden(code) ? ", which cannot be seen" : "");
}

std::string textOf(const Reading& r, TextSpan span) {
  return {r.begin + span.offset, std::min(span.length, 64U)};
}

/// Whether a name and "=" stand here, that is, the next attribute.
bool attributeFollows(std::string_view rest) {
  const std::string_view word = wordAt(rest);
  const std::size_t after = rest.find_first_not_of(" \t\r\n", word.size());
  return !word.empty() && after != rest.npos && rest[after] == '=';
}

/// Whether a word and "(" stand here, that is, the next declaration.
bool declarationFollows(std::string_view rest) {
  const std::string_view word = wordAt(rest);
  const std::size_t after = rest.find_first_not_of(" \t", word.size());
  return !word.empty() && after != rest.npos && rest[after] == '(';
}

std::string notClosed(const Reading& r, std::string_view next) {
  return fmt::format("\"{}\" begins here, but \"{}\" is not closed: \")\" is missing", next,
                     textOf(r, r.declaration.type));
}

SyntaxError neverClosed(const Reading& r) {
  return {r.begin + r.declaration.type.offset,
          fmt::format("\"{}\" is not closed: \")\" is missing before the end of the file",
                      textOf(r, r.declaration.type))};
}

template <class Rule>
SyntaxError explain(const char* at, const Reading& r);

template <>
SyntaxError explain<TypeWord>(const char* at, const Reading& r) {
  return {at, fmt::format("a node type is expected here, not {}", describe({at, r.end}))};
}

template <>
SyntaxError explain<Open>(const char* at, const Reading& r) {
  const char* const typeEnd = r.begin + r.declaration.type.offset + r.declaration.type.length;
  if (std::find(typeEnd, at, '\n') != at) at = typeEnd;  // the mistake is in the line of the word
  return {at, fmt::format("\"(\" is expected after \"{}\", not {}", textOf(r, r.declaration.type),
                          describe({at, r.end}))};
}

template <>
SyntaxError explain<Equals>(const char* at, const Reading& r) {
  const TextSpan name = r.declaration.attributes.back().name;
  if (at < r.end && *at == '(') return {r.begin + name.offset, notClosed(r, textOf(r, name))};
  return {at, fmt::format("\"=\" is expected after \"{}\", not {}", textOf(r, name), describe({at, r.end}))};
}

template <>
SyntaxError explain<Value>(const char* at, const Reading& r) {
  const std::string name = textOf(r, r.declaration.attributes.back().name);
  if (at < r.end && *at == '\'') return {at, "a value is quoted with double quotes, not single ones"};
  if (at < r.end && *at == '(')
    return {at, fmt::format("numbers are written in quotes: {}=\"1, 2, 3\"", name)};
  return {at, fmt::format("\"{}\" has no value: one is expected here, not {}", name, describe({at, r.end}))};
}

template <>
SyntaxError explain<ClosingQuote>(const char*, const Reading& r) {
  return {r.quote, "this quote is not closed in its line"};
}

template <>
SyntaxError explain<Separator>(const char* at, const Reading& r) {
  const std::string_view rest(at, r.end);
  if (rest.empty()) return neverClosed(r);
  if (attributeFollows(rest)) return {at, fmt::format("\",\" is missing before {}", describe(rest))};
  if (declarationFollows(rest)) return {at, notClosed(r, wordAt(rest))};
  return {at,
          fmt::format("\",\" or \")\" is expected here, not {}; a value with blanks or commas needs quotes",
                      describe(rest)),
          true};
}

template <>
SyntaxError explain<Close>(const char* at, const Reading& r) {
  const std::string_view rest(at, r.end);
  if (rest.empty()) return neverClosed(r);
  const bool number = (*at >= '0' && *at <= '9') || *at == '-' || *at == '.' || *at == '+';
  return {at,
          fmt::format("an attribute or \")\" is expected here, not {}{}", describe(rest),
                      number ? "; a value with commas needs quotes" : ""),
          number};
}

template <class Rule>
struct Control : pegtl::normal<Rule> {
  template <class In>
  [[noreturn]] static void raise(const In& in, Reading& r) {
    throw explain<Rule>(in.current(), r);
  }
};

/// The beginning of the next line after `after`, in or behind the line of `from`, that looks like a
/// declaration; `end` if there is none.
const char* resynchronise(const SourceText& source, const char* after, const char* from) {
  const std::string_view text = source.text();
  const auto offset = static_cast<std::uint32_t>(from - text.data());
  std::size_t line = source.lineStart(offset);
  const auto last = static_cast<std::size_t>(after - text.data());
  while (line < text.size()) {
    Input in(text.data() + line, text.data() + text.size(), "");
    if (line > last && pegtl::parse<Beginning>(in)) return text.data() + line;
    const std::size_t end = text.find_first_of("\r\n", line);
    if (end == text.npos) break;
    line = end + 1;
  }
  return text.data() + text.size();
}

}  // namespace

void parseSyntax(const SourceText& source, const std::function<void(const RawDeclaration&)>& take,
                 const std::function<bool(std::uint32_t offset, std::string message)>& complain) {
  const std::string_view text = source.text();
  const char* const end = text.data() + text.size();
  Reading r{text.data(), end, {}, nullptr};
  const char* at = text.data();
  while (at < end) {
    Input in(at, end, "");
    pegtl::parse<Gap>(in);
    at = in.current();
    if (at == end) return;

    r.declaration.type = {r.offset(at), 0};
    r.declaration.attributes.clear();
    r.quote = nullptr;
    try {
      pegtl::parse<Declaration, Action, Control>(in, r);
      r.declaration.complete = true;
      take(r.declaration);
      at = in.current();
    } catch (const SyntaxError& error) {
      auto& attributes = r.declaration.attributes;
      const bool halfRead =
          !attributes.empty() && (attributes.back().value.offset == kUnset || r.quote != nullptr);
      if (halfRead || (error.spoilsLast && !attributes.empty())) attributes.pop_back();
      r.declaration.complete = false;
      if (r.declaration.type.length > 0) take(r.declaration);
      if (!complain(r.offset(error.where), error.message)) return;
      at = resynchronise(source, at, error.where);
    }
  }
}

}  // namespace stadion
