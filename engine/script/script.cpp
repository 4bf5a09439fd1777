#include "engine/script/script.h"

#include "engine/script/checker.h"

#include <algorithm>
#include <tuple>

namespace stadion {

Document parseScript(SourceText source, const NodeRegistry& types, Diagnostics& findings) {
  Document document = DocumentWriter::empty(std::move(source), types);
  FindingCollector report(document.source(), findings);
  Checker checker(document, report);
  parseSyntax(
      document.source(), [&](const RawDeclaration& raw) { checker.take(raw); },
      [&](std::uint32_t offset, std::string message) {
        DocumentWriter(document).setIncomplete();
        report.error(offset, std::move(message));
        return !report.full();
      });
  checker.finish();
  return document;
}

Document checkScript(SourceText source, const NodeRegistry& types, Diagnostics& findings) {
  Diagnostics found;
  Document document = parseScript(std::move(source), types, found);
  resolveNames(document, {}, found);
  findings.append(sorted(found));
  return document;
}

Diagnostics sorted(const Diagnostics& findings) {
  std::vector<std::string> files;
  std::vector<std::tuple<std::size_t, std::uint32_t, std::uint32_t, std::size_t>> order;
  for (std::size_t i = 0; i < findings.all().size(); ++i) {
    const SourcePosition& where = findings.all()[i].where;
    const auto file = std::find(files.begin(), files.end(), where.file);
    const auto rank = static_cast<std::size_t>(file - files.begin());
    if (file == files.end()) files.push_back(where.file);
    const std::uint32_t line =
        where.line == 0 ? ~std::uint32_t{0} : where.line;  // about the file: at its end
    order.emplace_back(rank, line, where.column, i);
  }
  std::sort(order.begin(), order.end());
  Diagnostics result;
  for (const auto& entry : order) result.add(findings.all()[std::get<3>(entry)]);
  return result;
}

}  // namespace stadion
