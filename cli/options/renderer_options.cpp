#include "cli/options/renderer_options.h"

#include "cli/options/command_options.h"
#include "engine/base/diagnostic.h"

namespace stadion {
namespace {

GlSubmission submissionOf(const std::string& word) {
  if (word == "auto") return {};
  const auto use = [&](const char* alone) {
    return word == alone || word == "both" ? GlUse::Always : GlUse::Never;
  };
  return {use("mapped"), use("indirect")};
}

}  // namespace

void RendererOptions::addTo(CLI::App& command, bool mayDrawNothing) {
  CommandOptions options(command);
  options.add("--renderer", renderer).notes(rendererGiven);
  options.add("--gl", gl, {.words = mayDrawNothing ? "auto|osmesa|egl|none" : "auto|osmesa|egl"})
      .notes(glGiven);
  options.add("--gl-submission", submission).notes(submissionGiven);
  options.add("--draw-threads", threads);
}

RendererSettings RendererOptions::settings(Diagnostics& findings) const {
  RendererSettings settings;
  settings.threads = threads;
  settings.submission = submissionOf(submission);
  if (rendererGiven && drawsNothing())
    findings.error({}, "--gl none draws nothing that --renderer could draw: leave one of them out");
  else if (renderer == "cpu" && glGiven && gl != "auto")
    findings.error({}, "--renderer cpu draws without OpenGL, which --gl chooses: leave one of them out");
  else if (submissionGiven && (renderer == "cpu" || drawsNothing()))
    findings.error({}, "--gl-submission is for OpenGL, which does not draw here: leave it out");
  const bool namesGl = gl == "osmesa" || gl == "egl";
  if (threads > 0 && (renderer == "gl" || namesGl || drawsNothing()))
    findings.error({}, "--draw-threads is for --renderer cpu; LP_NUM_THREADS is for OpenGL in software");
  if (namesGl) settings.gl = gl == "egl" ? GlProviderKind::Egl : GlProviderKind::OsMesa;
  settings.choice = drawsNothing()                ? RendererChoice::None
                    : renderer == "cpu"           ? RendererChoice::Cpu
                    : renderer == "gl" || namesGl ? RendererChoice::Gl
                                                  : RendererChoice::Auto;
  return settings;
}

std::vector<std::string> RendererOptions::words() const {
  std::vector<std::string> words;
  if (rendererGiven) words.insert(words.end(), {"--renderer", renderer});
  if (glGiven) words.insert(words.end(), {"--gl", gl});
  if (submissionGiven) words.insert(words.end(), {"--gl-submission", submission});
  if (threads > 0) words.insert(words.end(), {"--draw-threads", std::to_string(threads)});
  return words;
}

}  // namespace stadion
