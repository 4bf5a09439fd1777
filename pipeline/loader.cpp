#include "pipeline/loader.h"

#include "engine/script/script.h"

#include <algorithm>

namespace stadion {

Loader::Loader(LoaderParts parts) : parts_(std::move(parts)), worker_([this] { work(); }) {}

Loader::~Loader() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
    changed_.notify_all();
  }
  worker_.join();
}

void Loader::request(std::uint32_t number, const std::string& file, NodeRef owner, const Affine& X_WO) {
  const std::lock_guard lock(mutex_);
  jobs_.push_back({number, file, owner, X_WO});
  changed_.notify_all();
}

std::unique_ptr<Load> Loader::take(std::uint32_t number) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return done_.contains(number); });
  auto load = std::move(done_[number]);
  done_.erase(number);
  return load;
}

void Loader::dispose(std::unique_ptr<Load> load, std::uint64_t lastFrame) {
  for (const MeshId mesh : load->meshes) parts_.meshes.release(mesh, lastFrame);
  const std::lock_guard lock(mutex_);
  waiting_.push_back({std::move(load), lastFrame});
}

void Loader::shown(std::uint64_t frame) {
  const std::lock_guard lock(mutex_);
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
      const Job job = std::move(jobs_.front());
      jobs_.pop_front();
      lock.unlock();
      auto load = prepare(job);
      lock.lock();
      done_[job.number] = std::move(load);
      changed_.notify_all();
    } else {
      auto load = std::move(garbage_.front());
      garbage_.pop_front();
      lock.unlock();
      destroy(std::move(load));
      lock.lock();
    }
  }
}

std::vector<std::uint32_t> Loader::around(std::uint32_t outer) const {
  std::vector<std::uint32_t> numbers;
  for (auto at = around_.find(outer); at != around_.end(); at = around_.find(at->second.outer))
    numbers.push_back(at->first);
  return numbers;
}

std::unique_ptr<Load> Loader::prepare(const Job& job) {
  Diagnostics findings;
  std::unique_ptr<Load> load;
  std::unique_ptr<Document> document = readScript(job.file, parts_.roots, findings);
  if (document) {
    const std::vector<std::uint32_t> surroundings = around(job.owner.load);
    std::vector<const Document*> files;
    for (const std::uint32_t n : surroundings) files.push_back(around_.at(n).document.get());
    resolveNames(*document, files, findings);
    if (!findings.hasErrors()) {
      const BuildInput input{*document,
                             job.number,
                             job.owner,
                             job.X_WO,
                             surroundings,
                             parts_.factories,
                             [&](const Declaration& d) { return importMesh(d, findings); },
                             parts_.meshes};
      Built built = buildLoad(input, findings);
      load = std::move(built.load);
      if (!built.staticRecords.empty()) {
        load->chunk = parts_.arena.add(built.staticRecords);
        load->chunkRecords = parts_.arena.find(load->chunk, 0).records;
      }
    }
    const bool hasScenes = std::any_of(document->begin(), document->end(),
                                       [](const Declaration& d) { return d.kind() == NodeKind::Scene; });
    if (load && hasScenes) around_[job.number] = {job.owner.load, std::move(document)};
  }
  if (!findings.all().empty()) parts_.report(findings);
  if (load && findings.hasErrors()) {
    // Nothing of it has been seen by anybody: it may go at once.
    for (const MeshId mesh : load->meshes) parts_.meshes.release(mesh, 0);
    destroy(std::move(load));
  }
  return load;
}

MeshId Loader::importMesh(const Declaration& d, Diagnostics& findings) {
  ImportOptions options;
  options.unit = d.optionalNumber(Attr::Unit);
  options.up = d.optionalChoice<UpAxis>(Attr::Up);
  const std::string file(d.text(Attr::File));
  Diagnostics notes;
  auto mesh = parts_.importer.load(file, options, d.where(Attr::File), &notes);
  findings.append(notes);
  if (mesh) return parts_.meshes.add(std::move(mesh.value()));
  Diagnostic missing = mesh.error();
  missing.severity = Severity::Warning;
  missing.message += "; a stand-in is shown in its place";
  findings.add(missing);
  return parts_.meshes.add(standIn(file));
}

void Loader::destroy(std::unique_ptr<Load> load) {
  around_.erase(load->number);
  if (load->chunk != kNoChunk) parts_.arena.free(load->chunk);
}

}  // namespace stadion
