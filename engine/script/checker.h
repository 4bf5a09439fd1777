#pragma once
/// Turns raw declarations into typed ones, as the schema demands, and says what is wrong with them.

#include "engine/script/document_writer.h"
#include "engine/script/reporter.h"

#include <bitset>

namespace stadion {

class Checker {
public:
  /// Expects that both outlive the checker.
  Checker(Document& document, Reporter& report);

  void take(const RawDeclaration& raw);
  void finish();  ///< after the last declaration

private:
  using Seen = std::bitset<kAttrCount>;

  void takeUnknown(const RawDeclaration& raw);
  void takeAttribute(NodeKind kind, const RawAttribute& raw, Seen& seen);
  void reportUnknown(NodeKind kind, const RawAttribute& raw);
  bool reportHidden(const AttributeSpec& spec, TextSpan value);
  void takeValue(NodeKind kind, const AttributeSpec& spec, TextSpan value);
  void takeNumbers(const AttributeSpec& spec, TextSpan value);
  void takeFlag(const AttributeSpec& spec, TextSpan value);
  void takeChoice(const AttributeSpec& spec, TextSpan value);
  void takeChoices(NodeKind kind, const AttributeSpec& spec, TextSpan value);
  void takeDistances(const AttributeSpec& spec, TextSpan value, const NumberList& numbers);
  void takeWord(const AttributeSpec& spec, TextSpan value);
  void takeWords(const AttributeSpec& spec, TextSpan value);
  void takeCoefficients(const AttributeSpec& spec, TextSpan value);
  void checkFlight(const RawDeclaration& raw, std::uint32_t node);
  void takeFile(const AttributeSpec& spec, TextSpan value);
  void takeMessage(NodeKind kind, TextSpan value);
  void reportCount(const AttributeSpec& spec, TextSpan value, std::size_t count);
  bool numbersInRange(const AttributeSpec& spec, TextSpan value, const NumberList& numbers);
  bool momentsArePossible(const AttributeSpec& spec, TextSpan value, const NumberList& numbers);
  void checkRequired(NodeKind kind, TextSpan type, const Seen& seen);
  void checkVolume(NodeKind kind, const RawDeclaration& raw, const Seen& seen);
  void checkKeyTimes(const RawDeclaration& raw, std::uint32_t node);
  std::string_view text(TextSpan span) const { return document_.source().slice(span.offset, span.length); }

  Document& document_;
  DocumentWriter writer_;
  Reporter& report_;
};

}  // namespace stadion
