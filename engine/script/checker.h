#pragma once
/// Turns raw declarations into typed ones, as the node types demand, and says what is wrong with them.

#include "engine/script/document_writer.h"
#include "engine/script/finding_collector.h"

namespace stadion {

class Checker {
public:
  /// Expects that both outlive the checker.
  Checker(Document& document, FindingCollector& report);

  void take(const RawDeclaration& raw);
  void finish();  ///< after the last declaration

private:
  using Seen = RegisteredType::AttributeSet;  ///< by position in the type

  void takeUnknown(const RawDeclaration& raw);
  void takeAttribute(const RegisteredType& type, const RawAttribute& raw, Seen& seen);
  void reportUnknown(const RegisteredType& type, const RawAttribute& raw);
  bool reportHidden(const AttributeSpec& spec, TextSpan value);
  void takeValue(const RegisteredType& type, const AttributeSpec& spec, TextSpan value);
  void takeNumbers(const AttributeSpec& spec, TextSpan value);
  void takeFlag(const AttributeSpec& spec, TextSpan value);
  void takeChoice(const AttributeSpec& spec, TextSpan value);
  void takeChoices(const RegisteredType& type, const AttributeSpec& spec, TextSpan value);
  void takeDistances(const AttributeSpec& spec, TextSpan value, const NumberList& numbers);
  void takeWord(const AttributeSpec& spec, TextSpan value);
  void takeWords(const AttributeSpec& spec, TextSpan value);
  void takeCoefficients(const AttributeSpec& spec, TextSpan value);
  void takeFile(const AttributeSpec& spec, TextSpan value);
  void takeMessage(const RegisteredType& type, TextSpan value);
  void reportCount(const AttributeSpec& spec, TextSpan value, std::size_t count);
  bool numbersInRange(const AttributeSpec& spec, TextSpan value, const NumberList& numbers);
  bool momentsArePossible(const AttributeSpec& spec, TextSpan value, const NumberList& numbers);
  void checkRequired(const RegisteredType& type, TextSpan where, const Seen& seen);
  const NodeRegistry& types() const { return document_.types(); }
  std::string_view text(TextSpan span) const { return document_.source().slice(span.offset, span.length); }

  Document& document_;
  DocumentWriter writer_;
  FindingCollector& report_;
  std::size_t priority_, onOverrun_;  ///< positions among the common attributes
};

}  // namespace stadion
