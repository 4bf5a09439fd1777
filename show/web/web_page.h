#pragma once
/// The files of the operator's page: one document, its style and its script. They are a part of the program, load
/// nothing from elsewhere, and hold no secret.
///
/// The page asks for the state once a second (short polling) rather than keeping a stream open. So a connection lives
/// for milliseconds, any proxy passes it on, and fifty operators need no fifty threads.
///
/// Threads  constants.

#include <string_view>

namespace stadion {

struct WebPageFile {
  std::string_view path;
  const char* type;
  std::string_view (*text)();
};

/// Returns the file with that path; null: there is none.
const WebPageFile* webPageFile(std::string_view path);

namespace web_page {

std::string_view document();
std::string_view style();
std::string_view script();

}  // namespace web_page

}  // namespace stadion
