#pragma once
/// Adds findings about one source text, with positions and excerpts, up to a number that a reader can use.

#include "engine/base/diagnostic.h"
#include "engine/script/source_text.h"

namespace stadion {

class FindingCollector {
public:
  static constexpr std::size_t kMost = 100;  ///< limit of the number of errors, and of warnings

  /// Expects that both outlive the collector.
  FindingCollector(const SourceText& source, Diagnostics& findings) : source_(source), findings_(findings) {}

  void error(std::uint32_t offset, std::string message) {
    report(Severity::Error, errors_, offset, std::move(message));
  }
  void warning(std::uint32_t offset, std::string message) {
    report(Severity::Warning, warnings_, offset, std::move(message));
  }
  bool full() const { return errors_ >= kMost; }  ///< further errors are dropped

private:
  void report(Severity severity, std::size_t& count, std::uint32_t offset, std::string message) {
    if (count < kMost)
      findings_.add({severity, source_.position(offset), std::move(message), source_.excerpt(offset)});
    else if (count == kMost)
      findings_.note({source_.file(), 0, 0}, "there is more; the rest is not shown");
    ++count;
  }

  const SourceText& source_;
  Diagnostics& findings_;
  std::size_t errors_ = 0;
  std::size_t warnings_ = 0;
};

}  // namespace stadion
