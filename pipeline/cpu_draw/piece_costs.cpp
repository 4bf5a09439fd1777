#include "pipeline/cpu_draw/piece_costs.h"

#include <algorithm>
#include <ctime>
#include <numeric>

namespace stadion {
namespace {

/// Objects that are drawn one after the other make one piece while it is no more than so large a part of all.
constexpr float kMostJoined = 32;

double threadMilliseconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return 1e3 * static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_nsec);
}

IsolatedDrawTime aloneIn(const PieceCosts::View& view, Span what, double ms) {
  IsolatedDrawTime alone;
  alone.frame = view.list.ticket.signature.frame;
  alone.wall = view.list.wall;
  alone.eye = static_cast<std::uint32_t>(view.list.views[view.number].eye);
  alone.what = what;
  alone.ms = std::max(ms, 0.0);
  return alone;
}

}  // namespace

/// Lists are sorted by mesh and level, so the triangles of the item before are often those of this one.
float PieceCosts::workOf(const DrawItem& item, const DrawItem* before) {
  constexpr float kOfTriangle = 8;  // as much as so many pixels
  if (!before || before->mesh != item.mesh || before->level != item.level) {
    triangles_ = 0;
    if (const auto mesh = meshes_.find(item.mesh))
      for (const CpuPart& part : mesh->partsAt(item.level)) triangles_ += part.triangles;
  }
  return item.pixels + kOfTriangle * static_cast<float>(triangles_);
}

void PieceCosts::findSeen(const View& view) {
  seen_.clear();
  work_.clear();
  const auto addAll = [&](const std::vector<DrawItem>& items) {
    for (const DrawItem& item : items)
      if (item.views >> view.number & 1) {
        work_.push_back(workOf(item, seen_.empty() ? nullptr : seen_.back()));
        seen_.push_back(&item);
      }
  };
  addAll(view.list.opaque);
  opaque_ = seen_.size();
  addAll(view.list.transparent);
  all_ = std::accumulate(work_.begin(), work_.end(), 0.0f);
}

void PieceCosts::findPieces(FrameProbe& probe) {
  const float most = all_ / kMostJoined;
  float joined = 0;
  pieces_.clear();
  wanted_.clear();
  for (std::size_t i = 0; i < seen_.size(); ++i) {
    if (pieces_.empty() || joined + work_[i] > most) pieces_.push_back({i, 0}), joined = 0;
    joined += work_[i];
    ++pieces_.back().count;
  }
  for (std::size_t p = 0; p < pieces_.size(); ++p) {
    owners_.clear();
    for (std::size_t i = 0; i < pieces_[p].count; ++i) owners_.push_back(seen_[pieces_[p].first + i]->owner);
    if (probe.wantsAlone(owners_)) wanted_.push_back(p);
  }
}

std::span<const NodeShare> PieceCosts::sharesOf(const Piece& piece) {
  shares_.clear();
  float sum = 0;
  for (std::size_t i = piece.first; i < piece.first + piece.count; ++i)
    shares_.push_back({seen_[i]->owner, work_[i]}), sum += work_[i];
  for (NodeShare& share : shares_)
    share.part = sum > 0 ? share.part / sum : 1.0f / static_cast<float>(shares_.size());
  return shares_;
}

void PieceCosts::setUp(const View& view, const Piece& piece) {
  setup_.begin(view.shading.setup->geometry(), view.shading.setup->samples());
  const ListMeshes meshes(meshes_, poses_, paints_, view.list);
  const auto add = [&](std::size_t i, Transparency which) {
    const DrawItem& item = *seen_[i];
    if (const auto mesh = meshes.find(item))
      setup_.add(mesh, item.level, item.model, which, meshes.paintOf(item));
  };
  for (std::size_t i = piece.first; i < piece.first + piece.count; ++i) add(i, Transparency::Opaque);
  for (std::size_t i = std::max(piece.first, opaque_); i < piece.first + piece.count; ++i)
    add(i, Transparency::Transparent);
  setup_.divide();
  for (std::size_t i = 0; i < setup_.placePieces(); ++i) setup_.place(i);
  for (std::size_t i = 0; i < setup_.setUpPieces(); ++i) setup_.setUp(i);
}

void PieceCosts::drawBand(const View& view, std::size_t band, bool surfacesOnly) {
  PictureShading shading = view.shading;
  rgba_.resize(shading.rgba.size());
  shading.setup = &setup_;
  shading.rgba = rgba_;
  shading.surfacesOnly = surfacesOnly;
  bands_.draw(shading, band);
}

void PieceCosts::measureEmpty(const View& view) {
  double at = threadMilliseconds();
  setUp(view, {0, 0});
  emptySetUpMs_ = threadMilliseconds() - at;
  emptyRowMs_ = rowOf(view, true);
}

double PieceCosts::emptyOf(const View& view, std::span<const std::size_t> bands) const {
  return std::accumulate(bands.begin(), bands.end(), emptySetUpMs_, [&](double sum, std::size_t band) {
    return sum + emptyRowMs_ * (view.shading.end(band) - view.shading.low(band));
  });
}

/// The cost of a row without objects. Expects that nothing is set up. All rows cost about the same, so some bands are
/// drawn, others each time: recording must cost little.
double PieceCosts::rowOf(const View& view, bool surfacesOnly) {
  constexpr std::size_t kEvery = 8;
  const std::size_t bands = setup_.bands();
  int rows = 0;
  const double began = threadMilliseconds();
  for (std::size_t band = turn_++ % std::min(kEvery, bands); band < bands; band += kEvery) {
    drawBand(view, band, surfacesOnly);
    rows += view.shading.end(band) - view.shading.low(band);
  }
  return (threadMilliseconds() - began) / std::max(rows, 1);
}

double PieceCosts::skyOf(const View& view) {
  return rowOf(view, false) * view.shading.setup->geometry().height;
}

/// Draws only bands that the piece touches.
double PieceCosts::costOf(const View& view, const Piece& piece) {
  const double began = threadMilliseconds();
  setUp(view, piece);
  touched_.clear();
  for (std::size_t band = 0; band < setup_.bands(); ++band) {
    bool touches = false;
    for (const Transparency which : {Transparency::Opaque, Transparency::Transparent})
      setup_.forEach(which, band,
                     [&](const TriangleRecord*, std::span<const std::uint32_t>, bool) { touches = true; });
    if (touches) touched_.push_back(band);
  }
  for (const std::size_t band : touched_) drawBand(view, band, true);
  return threadMilliseconds() - began - emptyOf(view, touched_);
}

void PieceCosts::sampleSome(const View& view, FrameProbe& probe) {
  findSeen(view);
  findPieces(probe);
  measureEmpty(view);
  probe.drewAlone(aloneIn(view, Span::Sky, skyOf(view)), {});
  if (wanted_.empty()) return;
  const auto eye = static_cast<std::uint32_t>(view.list.views[view.number].eye);
  const std::size_t at = probe.nextBatch(view.list.wall, eye, wanted_.size());
  const std::size_t end = std::min(at + kBatchesAFrame, wanted_.size());
  for (std::size_t i = at; i < end; ++i) {
    const Piece& piece = pieces_[wanted_[i]];
    const IsolatedDrawTime alone = aloneIn(view, Span::Draw, costOf(view, piece));
    probe.drewAlone(alone, sharesOf(piece));
  }
}

void PieceCosts::sampleWhole(const View& view, FrameProbe& probe) {
  findSeen(view);
  const double began = threadMilliseconds();
  setUp(view, {0, seen_.size()});
  for (std::size_t band = 0; band < setup_.bands(); ++band) drawBand(view, band, false);
  const bool left = view.list.views[view.number].eye == Eye::Left;
  probe.drewAlone(aloneIn(view, left ? Span::LeftEye : Span::RightEye, threadMilliseconds() - began), {});
}

void PieceCosts::reportLargest(const DrawList& list, FrameProbe& probe) {
  constexpr float kMuch = 0.25f;  // of all
  NodeRef owner;
  float most = 0, all = 0;
  const DrawItem* before = nullptr;
  for (const std::vector<DrawItem>* items : {&list.opaque, &list.transparent})
    for (const DrawItem& item : *items) {
      const float work = workOf(item, before);
      before = &item;
      all += work;
      if (work > most) most = work, owner = item.owner;
    }
  if (most < kMuch * all) owner = {};
  if (most > 0) probe.counted(Count::Largest, static_cast<std::uint64_t>(most), owner);
}

}  // namespace stadion
