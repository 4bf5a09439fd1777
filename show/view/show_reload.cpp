#include "show/view/show_reload.h"

#include "engine/base/run_stopped.h"
#include "show/player/show_check.h"

#include <utility>

namespace stadion {
namespace {

std::string whyOf(const std::exception_ptr& thrown) {
  try {
    std::rethrow_exception(thrown);
  } catch (const std::bad_alloc&) {
    return "out of memory";
  } catch (const std::exception& e) {
    return e.what();
  } catch (...) {
    return "an unknown exception";
  }
}

}  // namespace

ShowReload::ShowReload(ShowSurroundings around) : around_(std::move(around)) {
  thread_ = std::thread([this] {
    try {
      read();
    } catch (const RunStopped&) {
      // given up
    } catch (...) {
      thrown_ = std::current_exception();
    }
    done_ = true;
  });
}

ShowReload::~ShowReload() {
  if (!thread_.joinable()) return;  // what was taken plays on
  *around_.stopping = true;
  thread_.join();
}

void ShowReload::read() {
  const ShowOptions& show = around_.settings.show;
  around_.texts = ScriptTexts::read(show.script, show.roots(), *show.types);
  Diagnostics found = checkScripts(show.script, show.assetRoots, show.types, around_.texts);
  if (!found.hasErrors())
    found = checkShow(show.script, show.assetRoots, show.types, around_.stopping.get(), around_.texts);
  for (const Diagnostic& d : found.all())
    if (d.severity == Severity::Error) errors_.add(d);
  if (!errors_.hasErrors()) show_ = PlayingShow::open(around_, errors_);
}

std::unique_ptr<PlayingShow> ShowReload::take(Diagnostics& findings) {
  if (thread_.joinable()) thread_.join();
  if (thrown_) {
    show_.reset();
    findings.error({around_.settings.show.script, 0, 0}, "cannot be read again: " + whyOf(thrown_));
  }
  for (const Diagnostic& d : errors_.all()) findings.add(d);
  return std::move(show_);
}

}  // namespace stadion
