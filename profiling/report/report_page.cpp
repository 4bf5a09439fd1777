#include "engine/plain_text/markup_text.h"
#include "profiling/report/page_parts.h"
#include "profiling/report/report_data.h"

namespace stadion {
namespace {

/// Escapes it so that no text in it ends the enclosing script element.
std::string embedded(const std::string& text) {
  std::string out;
  out.reserve(text.size());
  for (const char c : text)
    if (c == '<')
      out += "\\u003c";
    else
      out += c;
  return out;
}

}  // namespace

std::string reportPage(const ReportData& data) {
  std::string page = "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n";
  // The page never loads anything, whatever names are in the data.
  page += "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src "
          "'unsafe-inline'; script-src 'unsafe-inline'\">\n"
          "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n";
  page += "<title>" + markupText(data.head.show) + ": where its frames go</title>\n<style>";
  page += report::kStyle;
  page += "</style></head>\n<body>\n";
  page += report::kBody;
  page +=
      "<script id=\"data\" type=\"application/json\">" + embedded(reportJson(data)) + "</script>\n<script>\n";
  page += "\"use strict\";\n";
  for (const char* script : {report::kBaseScript, report::kPlotScript, report::kTimelineScript,
                             report::kFlameScript, report::kTableScript, report::kMainScript})
    page += script;
  page += "</script>\n</body></html>\n";
  return page;
}

}  // namespace stadion
