#include "pipeline/operator/operator_state.h"
#include "show/web/request_reader.h"
#include "show/web/web_command.h"
#include "tests/fuzz/targets.h"

#include <cmath>
#include <string>

namespace stadion::fuzz {
namespace {

bool isSameRequest(const WebRequest& a, const WebRequest& b) {
  return a.method == b.method && a.path == b.path && a.host == b.host && a.token == b.token &&
         a.body == b.body;
}

}  // namespace

/// One request, at once and in two pieces.
void web(Bytes bytes) {
  const std::string_view text = asText(bytes);
  RequestReader whole, parts;
  whole.take(text);
  const std::size_t cut = text.size() / 2;
  if (parts.take(text.substr(0, cut)) == RequestReader::Progress::Reads) parts.take(text.substr(cut));
  if (whole.progress() == RequestReader::Progress::Refused)
    require(whole.status() >= 400 && !whole.why().empty(), "a refusal has its reason");
  if (whole.progress() != RequestReader::Progress::Complete) return;
  const WebRequest& r = whole.request();
  require(parts.progress() == RequestReader::Progress::Complete && isSameRequest(r, parts.request()),
          "pieces do not matter");
  require(r.path.starts_with('/') && r.path.find("..") == std::string::npos, "no path leads elsewhere");
  require(r.path.size() <= RequestReader::kMostPath && r.body.size() <= RequestReader::kMostBody,
          "sizes are limited");
  const std::string head = r.path + r.host + r.token + r.origin;
  require(head.find_first_of(std::string("\r\n\0", 3)) == std::string::npos, "no header adds another one");
  const WebCommand read = readWebCommand(r.body);
  require(read.command.has_value() != !read.complaint.empty(), "a command or a reason");
  OperatorState show;
  if (read.command) show.apply(*read.command);
  require(show.volume >= 0 && show.volume <= 1 && std::isfinite(show.eyeSeparation()),
          "figures are in their ranges");
}

}  // namespace stadion::fuzz
