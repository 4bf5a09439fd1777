#include "pipeline/load/loader.h"

#include "engine/asset/simplify.h"
#include "engine/asset/sound_file.h"
#include "engine/base/run_stopped.h"
#include "engine/build/lint.h"
#include "engine/build/model_options.h"
#include "engine/core/state_hash.h"
#include "engine/script/script.h"

#include <filesystem>
#include <new>
#include <stdexcept>
#include <utility>

namespace stadion {
namespace {

constexpr std::size_t kDeepestNesting = 16;

/// The levels of a figure would have to be simplified in all its poses. Surroundings have no triangles.
double levelsOf(const Declaration& d) {
  return d.is(Trait::Figure) || d.is(Trait::Surroundings) ? 0 : d.number("levels");
}

}  // namespace

Loader::Loader(LoaderParts parts) : parts_(std::move(parts)), thread_([this] { work(); }) {}

Loader::~Loader() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
    changed_.notify_all();
  }
  thread_.join();
}

void Loader::request(std::uint32_t number, const std::string& file, NodeRef owner, const Affine& X_WO) {
  std::map<std::uint32_t, Prepared> one;
  one[number];
  const std::lock_guard lock(mutex_);
  jobs_.push_back({number, file, owner, X_WO, one.extract(number)});
  changed_.notify_all();
}

bool Loader::takesEffect(std::uint32_t number, Nanoseconds now) {
  if (now == 0) return true;  // the show begins when all files are loaded
  const auto decided = decided_.find(number);
  bool waits = decided != decided_.end() && now < decided->second;
  if (live_ && decided == decided_.end()) {
    const std::lock_guard lock(mutex_);
    waits = !done_.contains(number);
  }
  // A load that was skipped in a frame stays out of it, even if it finishes during that frame.
  const auto passedOver = awaited_.find(number);
  waits = waits || (passedOver != awaited_.end() && passedOver->second == now);
  if (waits)
    awaited_[number] = now;
  else if (awaited_.erase(number) > 0 && late_)
    late_(number, now);
  return !waits;
}

std::vector<std::uint32_t> Loader::overdue() const {
  std::vector<std::uint32_t> numbers;
  for (const auto& [number, passedOver] : awaited_) numbers.push_back(number);
  return numbers;
}

std::unique_ptr<LoadedScene> Loader::take(std::uint32_t number) {
  std::unique_lock lock(mutex_);
  const bool waits = waitsTold_ && !done_.contains(number);
  if (waits) waitsTold_(true);
  // A signal handler can set a flag, but cannot wake a thread, so the flag is checked now and then.
  while (!changed_.wait_for(lock, std::chrono::milliseconds(20), [&] { return done_.contains(number); }))
    if (stopped()) throw RunStopped();
  if (waits) waitsTold_(false);
  Prepared prepared = std::move(done_.extract(number).mapped());
  if (prepared.thrown) std::rethrow_exception(prepared.thrown);
  return std::move(prepared.load);
}

void Loader::dispose(std::unique_ptr<LoadedScene> load, std::uint64_t lastFrame) {
  for (const MeshId mesh : load->meshes) parts_.meshes.release(mesh, lastFrame);
  const std::lock_guard lock(mutex_);
  waiting_.push_back({std::move(load), lastFrame});
}

void Loader::report(const Diagnostic& finding) {
  Diagnostics one;
  one.add(finding);
  parts_.report(one);
}

void Loader::shown(std::uint64_t frame) {
  const std::lock_guard lock(mutex_);
  if (thrown_) std::rethrow_exception(std::exchange(thrown_, nullptr));
  bool any = false;
  for (; !waiting_.empty() && waiting_.front().lastFrame <= frame; waiting_.pop_front(), any = true)
    garbage_.push_back(std::move(waiting_.front().load));
  if (any) changed_.notify_all();
}

void Loader::work() {
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [&] { return ending_ || !jobs_.empty() || !garbage_.empty(); });
    if (ending_) return;
    if (!jobs_.empty()) {
      Job job = std::move(jobs_.front());
      jobs_.pop_front();
      lock.unlock();
      Prepared prepared = prepareSafely(job);
      lock.lock();
      job.place.mapped() = std::move(prepared);
      done_.insert(std::move(job.place));
      changed_.notify_all();
    } else {
      auto load = std::move(garbage_.front());
      garbage_.pop_front();
      lock.unlock();
      std::exception_ptr thrown;
      try {
        destroy(std::move(load));
      } catch (...) {
        thrown = std::current_exception();
      }
      lock.lock();
      if (thrown) thrown_ = thrown;
    }
  }
}

// An exception here must end the run, not the process. App throws it again and handles it.
Loader::Prepared Loader::prepareSafely(const Job& job) {
  const auto because = [&](const char* why) {
    try {
      return std::make_exception_ptr(std::runtime_error("loading " + job.file + ": " + why));
    } catch (...) {
      return std::current_exception();  // not even enough memory for a message
    }
  };
  try {
    return {prepare(job), nullptr};
  } catch (const RunStopped&) {
    return {nullptr, std::current_exception()};
  } catch (const std::bad_alloc&) {
    return {nullptr, because("out of memory")};
  } catch (const std::exception& e) {
    return {nullptr, because(e.what())};
  } catch (...) {
    return {nullptr, because("an unknown exception")};
  }
}

std::vector<std::uint32_t> Loader::around(std::uint32_t outer) const {
  std::vector<std::uint32_t> numbers;
  for (auto at = around_.find(outer); at != around_.end(); at = around_.find(at->second.outer))
    numbers.push_back(at->first);
  return numbers;
}

// The show's own file may be anywhere; every other file must be below the show's roots.
Result<SourceText> Loader::read(const Job& job) {
  const ScriptTexts* texts = parts_.texts.get();
  if (!job.owner.valid()) {
    Result<SourceText> show = texts ? texts->show() : SourceText::read(job.file);
    if (texts) parts_.texts = texts->withoutShow();
    return show;
  }
  auto source = texts ? texts->part(job.file, parts_.roots) : ScriptTexts::readPart(job.file, parts_.roots);
  if (texts) parts_.texts = texts->without(job.file);
  if (!source && source.error().where.file.empty()) return askedForBy(job, source.error());
  return source;
}

// Reported at the place where the scene node names its file.
Diagnostic Loader::askedForBy(const Job& job, Diagnostic d) const {
  const auto outer = around_.find(job.owner.load);
  if (outer == around_.end()) return d;
  const Declaration scene = (*outer->second.document)[job.owner.position];
  d.where = scene.where("file");
  d.excerpt = scene.excerpt("file");
  return d;
}

std::unique_ptr<LoadedScene> Loader::prepare(const Job& job) {
  Diagnostics findings;
  std::unique_ptr<LoadedScene> load;
  if (auto source = read(job)) {
    StateHash script;
    script.add(source.value().text());
    Document document = parseScript(std::move(source.value()), parts_.types, findings);
    load = build(job, std::make_unique<Document>(std::move(document)), findings);
    if (load) load->script = script.value();
  } else {
    findings.add(source.error());
  }
  if (!findings.all().empty()) parts_.report(sorted(findings));
  return load;
}

std::unique_ptr<LoadedScene> Loader::build(const Job& job, std::unique_ptr<Document> document,
                                           Diagnostics& findings) {
  const std::vector<std::uint32_t> numbers = around(job.owner.load);
  for (const std::uint32_t n : numbers) {
    std::error_code unknown;
    if (!std::filesystem::equivalent(around_.at(n).document->file(), document->file(), unknown)) continue;
    findings.warning({document->file(), 0, 0},
                     "this sub-scene is loaded by itself, without end; it stays out");
    return nullptr;
  }
  if (numbers.size() > kDeepestNesting) {
    findings.warning({document->file(), 0, 0}, "sub-scenes are nested more than " +
                                                   std::to_string(kDeepestNesting) +
                                                   " deep; does this file load itself? It stays out");
    return nullptr;
  }
  RelatedDocuments surroundings;
  for (const std::uint32_t n : numbers) surroundings.enclosing.push_back(around_.at(n).document.get());
  resolveNames(*document, surroundings, findings);
  if (findings.hasErrors()) return nullptr;
  lintLatencies(*document, parts_.step, findings);
  lintTrackers(*document, parts_.trackers, parts_.log, findings);

  Imports imports;
  const BuildInput input{*document,
                         job.number,
                         job.owner,
                         job.X_WO,
                         numbers,
                         parts_.services,
                         [&](const Declaration& d) { return imports.of(d, *this, findings); },
                         parts_.meshes,
                         [&](const Declaration& d) { return soundLength(d, findings); }};
  Built built = buildLoad(input, findings);
  std::unique_ptr<LoadedScene> load = std::move(built.load);
  load->meshes = std::move(imports.counted);
  if (findings.hasErrors()) {
    // No frame has shown them, so they may be freed at once.
    for (const MeshId mesh : load->meshes) parts_.meshes.release(mesh, 0);
    return nullptr;
  }
  {
    const std::lock_guard lock(mutex_);
    fading_.insert(fading_.end(), built.fading.begin(), built.fading.end());
  }
  if (!built.staticRecords.empty()) {
    load->chunk = parts_.arena.add(built.staticRecords);
    load->chunkRecords = parts_.arena.find(load->chunk, 0).records;
  }
  for (const Declaration d : *document)
    if (d.is(Trait::Encloses)) {
      around_[job.number] = {job.owner.load, std::move(document)};
      break;
    }
  return load;
}

std::vector<MeshId> Loader::fadingMeshes() {
  const std::lock_guard lock(mutex_);
  return fading_;
}

// A hundred thousand objects with the same file cause one import, and one message about it.
MeshId Loader::Imports::of(const Declaration& d, Loader& loader, Diagnostics& findings) {
  const ImportOptions options = importOptionsOf(d);
  const Key key(d.text("file"), options.unit.value_or(0), options.up ? static_cast<int>(*options.up) : -1,
                levelsOf(d), d.is(Trait::Figure), textOf(options.nodes));
  const auto [at, isNew] = known.try_emplace(key, kNoMesh);
  if (isNew) at->second = loader.importMesh(d, options, findings);
  if (isNew && at->second != kNoMesh) counted.push_back(at->second);
  return at->second;
}

/// Returns the key under which the model is kept between shows, if models are kept.
std::optional<ImportedMeshes::Key> Loader::keyOf(const std::string& file, const ImportOptions& options,
                                                 std::uint32_t levels) const {
  if (!parts_.kept) return {};
  const auto found = parts_.roots.open(file);
  auto key = found ? ImportedMeshes::Key::of(found.value().file.get(), options) : std::nullopt;
  if (key) key->levels = levels;
  return key;
}

MeshId Loader::importMesh(const Declaration& d, const ImportOptions& options, Diagnostics& findings) {
  const std::string file(d.text("file"));
  const auto levels = static_cast<std::uint32_t>(levelsOf(d));
  const auto key = keyOf(file, options, levels);
  if (const MeshId known = key ? parts_.kept->find(*key) : kNoMesh; known != kNoMesh) return known;
  Diagnostics notes;
  if (stopped()) throw RunStopped();
  const Attr blamed = blamedFor(d);
  auto mesh = parts_.importer.load(file, options, d.where(blamed), &notes);
  if (stopped()) throw RunStopped();
  if (options.nodes.part.empty()) findings.append(notes);  // once for the file
  if (mesh) {
    if (levels > 0) addLevels(*mesh.value(), levels);
    const MeshId id = parts_.meshes.add(std::move(mesh.value()));
    if (key) parts_.kept->keep(*key, id);
    return id;
  }
  Diagnostic missing = mesh.error();
  missing.excerpt = d.excerpt(blamed);
  missing.severity = Severity::Warning;
  const bool lights = options.form == ModelForm::Environment;
  missing.message += lights ? "; the show's sky lights in its place" : "; a stand-in is shown in its place";
  findings.add(missing);
  if (lights) return kNoMesh;
  return parts_.meshes.add(standIn(file));
}

Nanoseconds Loader::soundLength(const Declaration& d, Diagnostics& findings) {
  const auto read = [&]() -> Result<SoundInfo> {
    auto found = parts_.roots.open(std::string(d.text("file")));
    if (!found) return found.error();
    return readSoundInfo(found.value().file.get(), found.value().path);
  };
  const auto info = read();
  if (info) return info.value().length();
  Diagnostic missing = info.error();
  missing.where = d.where("file");
  missing.excerpt = d.excerpt("file");
  missing.severity = Severity::Warning;
  missing.message += "; a second of silence stands in for it";
  findings.add(missing);
  return kSilentStandIn;
}

void Loader::destroy(std::unique_ptr<LoadedScene> load) {
  around_.erase(load->number);
  if (load->chunk != kNoChunk) parts_.arena.free(load->chunk);
}

}  // namespace stadion
