#include "bench/looks/looks_measurement.h"

#include "bench/looks/disparity.h"
#include "bench/looks/perceptual_programs.h"
#include "bench/looks/picture_errors.h"
#include "bench/looks/side_by_side.h"
#include "engine/maths/median.h"

#include <fmt/format.h>

#include <algorithm>

namespace stadion::bench {
namespace {

constexpr int kJustSeen = 8;  ///< difference of a channel, of 255

void addErrors(const std::vector<Picture>& views, const std::vector<Picture>& references, LooksRow& row) {
  PictureErrors errors;
  for (std::size_t v = 0; v < views.size(); ++v) errors.add(views[v], references[v]);
  row.mean = errors.mean();
  row.p99 = errors.quantile(0.99);
  row.most = errors.most();
  row.within8 = errors.within(kJustSeen);
  if (views.size() < 2) return;
  const DisparityErrors apart = disparityErrors({views[0], views[1]}, {references[0], references[1]});
  if (apart.blocks > 0) row.disparity = apart.mean;
}

/// Writes the left eye's picture, and asks the programs how far it is from the reference.
std::optional<Diagnostic> addDistances(const LooksFiles& files, const std::string& reference,
                                       const Picture& picture, LooksRow& row) {
  const std::string path = files.pathOf(row.scene + "-" + row.wall + "-" + row.rung + ".png");
  if (path.empty()) return {};
  if (auto wrong = writePng(path, picture)) return wrong;
  if (!files.perceptual) return {};
  row.butteraugli = butteraugliOf({reference, path});
  row.ssimulacra = ssimulacraOf({reference, path});
  return {};
}

std::string labelOf(const LooksRow& row) {
  return fmt::format("{}: {:.1f} ms, error {:.2f}", row.rung, row.ms, row.mean);
}

DrawList leftEyeOf(const DrawList& list) {
  DrawList left = list;
  left.viewCount = 1;
  return left;
}

}  // namespace

Result<std::vector<DrawnViews>> LooksMeasurement::drawRounds(const DrawList& list, std::size_t rounds,
                                                             std::vector<LooksRow>& rows) {
  std::vector<DrawnViews> drawn(rungs_.size());
  std::vector<std::vector<double>> times(rungs_.size());
  for (std::size_t round = 0; round <= rounds; ++round)  // the first one warms up
    for (std::size_t r = 0; r < rungs_.size(); ++r) {
      auto views = pictures_.draw(list, rungs_[r]);
      if (!views) return views.error();
      drawn[r] = std::move(views.value());
      if (round > 0) times[r].push_back(drawn[r].ms);
    }
  for (std::size_t r = 0; r < rungs_.size(); ++r) {
    rows[r].ms = median(times[r]);
    rows[r].leastMs = *std::ranges::min_element(times[r]);
  }
  return drawn;
}

Result<std::vector<LooksRow>> LooksMeasurement::measure(const std::string& scene, const std::string& wall,
                                                        const DrawList& list, std::size_t rounds,
                                                        const LooksFiles& files) {
  std::vector<LooksRow> rows;
  for (const NamedRung& rung : rungs_) rows.push_back({scene, wall, std::string(rung.name)});
  const auto drawn = drawRounds(list, rounds, rows);
  if (!drawn) return drawn.error();
  const auto references = pictures_.reference(list);
  if (!references) return references.error();
  const std::string reference = files.pathOf(scene + "-" + wall + "-reference.png");
  if (!reference.empty())
    if (const auto wrong = writePng(reference, references.value().front())) return *wrong;
  std::vector<LabelledPicture> beside{{"64 samples", references.value().front()}};
  for (std::size_t r = 0; r < rungs_.size(); ++r) {
    const std::vector<Picture>& views = drawn.value()[r].views;
    addErrors(views, references.value(), rows[r]);
    if (const auto wrong = addDistances(files, reference, views.front(), rows[r])) return *wrong;
    beside.push_back({labelOf(rows[r]), views.front()});
  }
  const std::string sheet = files.pathOf(scene + "-" + wall + "-side-by-side.png");
  if (!sheet.empty())
    if (const auto wrong = writePng(sheet, sideBySide(beside))) return *wrong;
  return rows;
}

std::optional<Diagnostic> LooksMeasurement::measureFlicker(const std::vector<DrawList>& lists,
                                                           std::vector<LooksRow>& rows) {
  std::vector<double> sums(rungs_.size());
  std::vector<Picture> before(rungs_.size());
  Picture referenceBefore;
  for (const DrawList& list : lists) {
    const DrawList left = leftEyeOf(list);
    auto references = pictures_.reference(left);
    if (!references) return references.error();
    Picture& reference = references.value().front();
    for (std::size_t r = 0; r < rungs_.size(); ++r) {
      auto drawn = pictures_.draw(left, rungs_[r]);
      if (!drawn) return drawn.error();
      Picture& picture = drawn.value().views.front();
      if (!before[r].empty()) sums[r] += flicker({before[r], picture}, {referenceBefore, reference});
      before[r] = std::move(picture);
    }
    referenceBefore = std::move(reference);
  }
  for (std::size_t r = 0; r < rungs_.size() && lists.size() > 1; ++r)
    rows[r].flicker = sums[r] / static_cast<double>(lists.size() - 1);
  return {};
}

}  // namespace stadion::bench
