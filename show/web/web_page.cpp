#include "show/web/web_page.h"

#include <algorithm>
#include <array>

namespace stadion {
namespace {

constexpr std::array<WebPageFile, 3> kPageFiles{
    {{"/", "text/html; charset=utf-8", web_page::document},
     {"/page.css", "text/css; charset=utf-8", web_page::style},
     {"/page.js", "text/javascript; charset=utf-8", web_page::script}}};

}  // namespace

const WebPageFile* webPageFile(std::string_view path) {
  const auto* found = std::ranges::find(kPageFiles, path, &WebPageFile::path);
  return found == kPageFiles.end() ? nullptr : found;
}

}  // namespace stadion
