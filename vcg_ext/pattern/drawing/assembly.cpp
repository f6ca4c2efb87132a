// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/drawing/assembly.h"

#include <algorithm>
#include <cmath>

#include "common/pi.h"
#include "pattern/drawing/label_space.h"
#include "pattern/drawing/model_view.h"
#include "pattern/drawing/number_text.h"
#include "pattern/drawing/seam_table.h"
#include "pattern/drawing/sheet_marks.h"
#include "pattern/drawing/text_box.h"

namespace dcharts {

namespace {

constexpr double kGap = 4;    // mm between pictures
constexpr int kPixels = 700;  // side of a picture
constexpr int kMostViews = 4;
constexpr double kNumberSize = 3.2;      // mm, of a piece's number in a picture
constexpr double kSmallestNumber = 1.8;  // mm

// From where the model is looked at: the first shows most, each further one adds most.
struct Views {
  std::vector<ModelView> views;
  std::vector<std::vector<int>> numbered;  // the pieces that are numbered in each
};

Views ChooseViews(const Pattern& pattern, const SurfaceData& mesh) {
  constexpr int kTrialPixels = 160;
  constexpr double kSeen = 3;  // pixels of such a small picture
  const int count = static_cast<int>(pattern.pieces.size()), up = GuessUp(mesh);
  std::vector<std::pair<double, double>> directions;
  std::vector<ModelView> trials;
  for (double elevation : {20.0, -35.0, 65.0})
    for (int k = 0; k < 8; ++k) {
      directions.emplace_back(30 + 45 * k, elevation);
      trials.push_back(
          ViewModel(mesh, pattern.piece_of_face, count, up, 30 + 45 * k, elevation, kTrialPixels));
    }
  std::vector<double> best(count, 0);
  Views chosen;
  for (int round = 0; round < kMostViews; ++round) {
    std::size_t winner = 0;
    double most = 0;
    for (std::size_t i = 0; i < trials.size(); ++i) {
      double gain = 0;
      for (int p = 0; p < count; ++p) gain += std::max(0.0, trials[i].spots[p].radius - best[p]);
      if (gain > most + 1e-9) {
        most = gain;
        winner = i;
      }
    }
    // Two pictures always, from in front and behind; more only for pieces that were not seen.
    const bool all_seen = std::all_of(best.begin(), best.end(), [&](double r) { return r >= kSeen; });
    if (most == 0 || (round >= 2 && all_seen)) break;
    for (int p = 0; p < count; ++p) best[p] = std::max(best[p], trials[winner].spots[p].radius);
    const auto [azimuth, elevation] = directions[winner];
    chosen.views.push_back(ViewModel(mesh, pattern.piece_of_face, count, up, azimuth, elevation, kPixels));
  }
  // A number stands in every picture that has room for it, or else where there is most.
  chosen.numbered.resize(chosen.views.size());
  for (int p = 0; p < count; ++p) {
    std::size_t widest = 0;
    for (std::size_t v = 0; v < chosen.views.size(); ++v) {
      if (chosen.views[v].spots[p].radius > chosen.views[widest].spots[p].radius) widest = v;
      if (chosen.views[v].spots[p].radius > 16) chosen.numbered[v].push_back(p);
    }
    if (chosen.views.empty()) continue;
    std::vector<int>& last = chosen.numbered[widest];
    if (chosen.views[widest].spots[p].radius > 0 && (last.empty() || last.back() != p)) last.push_back(p);
  }
  return chosen;
}

// A picture at its place, with the pieces' numbers in it, or beside the model with a leader line.
class NumberedPicture {
 public:
  NumberedPicture(ModelView view, const Point2& at, double side, const Point2& page, Group& group)
      : view_(std::move(view)), space_({0, 0}, page), group_(group), pixel_(side / kPixels) {
    view_.picture.at = at;
    view_.picture.size = {side, side};
  }

  void Number(const std::vector<int>& pieces) {
    for (int p : pieces) NumberInside(p);
    for (int p : waiting_) NumberBeside(p);
    group_.pictures.push_back(std::move(view_.picture));
  }

 private:
  Point2 OnPage(const Point2& pixel) const {
    return view_.picture.at + pixel_ * Point2(pixel.x(), kPixels - pixel.y());
  }

  void NumberInside(int p) {
    const ModelView::Spot& spot = view_.spots[p];
    Text text{std::to_string(p + 1), OnPage(spot.at), kNumberSize};
    // The largest text in the square that is free around the spot.
    const double room = (spot.radius - 2) * pixel_;
    const Box box = BoxOf(text);
    text.size *= std::min(1.0, room / std::max(box.half.x(), box.half.y()));
    if (text.size < kSmallestNumber) {
      waiting_.push_back(p);
      space_.AddBox({text.at, {0.5, 0.5}, 0});  // no leader of another piece ends here
    } else {
      Put(text);
    }
  }

  void Put(const Text& text) {
    space_.AddBox(BoxOf(text));
    group_.texts.push_back(text);
  }

  bool IsEmpty(const Box& box) const {
    const Point2 low = (box.center - box.half - view_.picture.at) / pixel_,
                 high = (box.center + box.half - view_.picture.at) / pixel_;
    if (low.minCoeff() < 0 || high.maxCoeff() >= kPixels) return false;
    for (int y = static_cast<int>(low.y()); y <= high.y(); ++y)
      for (int x = static_cast<int>(low.x()); x <= high.x(); ++x)
        if (!view_.empty[static_cast<std::size_t>(kPixels - 1 - y) * kPixels + x]) return false;
    return true;
  }

  void NumberBeside(int p) {
    constexpr double kClearOfTarget = 0.75;  // mm: just out of the box that was kept for it
    const Point2 target = OnPage(view_.spots[p].at);
    Text text{std::to_string(p + 1), {0, 0}, kSmallestNumber + 0.6};
    for (double reach = 3; reach < kPixels * pixel_; reach *= 1.15)
      for (int k = 0; k < 32; ++k) {
        const double angle = 2 * kPi * k / 32;
        const Point2 way(std::cos(angle), std::sin(angle));
        text.at = target + reach * way;
        const Box box = BoxOf(text).Grown(0.4);
        if (!IsEmpty(box) || !space_.IsFree(box)) continue;
        const Point2 from = target + kClearOfTarget * way, to = text.at - (box.half.norm() + 0.2) * way;
        if ((to - from).dot(way) <= 0 || !space_.IsFree(from, to, -1)) continue;
        group_.lines.push_back({Mark::kLeader, {target, to}});
        space_.AddLine({from, to}, false, -1);
        Put(text);
        return;
      }
  }

  ModelView view_;
  LabelSpace space_;
  Group& group_;
  double pixel_;  // mm
  std::vector<int> waiting_;
};

std::vector<std::string> Facts(const Pattern& pattern) {
  int cuts = 0;
  std::size_t points = 0;
  for (const Piece& piece : pattern.pieces) {
    if (piece.drawn) cuts += piece.copies + piece.mirror_copies;
    for (const OutlineLoop& loop : piece.loops) points += loop.size();
  }
  const bool fabric = pattern.material == PatternMaterial::kFabric;
  std::string first = std::string(fabric ? "Fabric" : "Paper") + ": " + std::to_string(cuts) + " pieces, " +
                      std::to_string(pattern.seams.size()) + " seams, " +
                      NumberText(pattern.total_seam_length / 10, 1) + " cm to " + (fabric ? "sew" : "glue");
  if (fabric) first += "; seam allowance " + NumberText(pattern.allowance, 1) + " mm, included";
  return {first + ".", "Outlines have " + std::to_string(points) + " points. Largest ease: " +
                           NumberText(100 * pattern.largest_ease, 2) + " % of a seam's length."};
}

}  // namespace

std::vector<Drawing> AssemblyPages(const Draft& draft, const Point2& page_size, double margin) {
  const Pattern& pattern = draft.pattern;
  const double width = page_size.x() - 2 * margin;
  std::vector<Drawing> pages(1);
  Drawing& first = pages[0];
  first.title = draft.title;
  first.size = page_size;
  first.groups.push_back({"assembly", "Assembly"});
  Group& group = first.groups[0];

  double y = page_size.y() - margin - 6;
  AddText(group, {margin, y}, draft.title, SizeToFit(draft.title, 6, width));
  std::vector<std::string> sentences = Facts(pattern);
  sentences.insert(sentences.end(), pattern.warnings.begin(), pattern.warnings.end());
  y -= 3;
  for (const std::string& sentence : sentences) {
    y -= 4.2;
    AddText(group, {margin, y}, sentence, SizeToFit(sentence, 3, width));
  }
  y -= 10;
  AddScaleBar(group, {margin, y}, 100);
  y -= 8;
  AddLegend(group, {margin, y}, pattern.material);
  y -= kGap;

  Views views = ChooseViews(pattern, draft.mesh);
  const double side = std::min((width - kGap) / 2, 0.3 * page_size.y());
  for (std::size_t v = 0; v < views.views.size(); ++v) {
    if (v % 2 == 0) y -= side + (v > 0 ? kGap : 0);
    NumberedPicture(std::move(views.views[v]), {margin + (v % 2) * (side + kGap), y}, side, page_size, group)
        .Number(views.numbered[v]);
  }
  AddSeamTable(pattern, margin, y - kGap, pages);
  return pages;
}

}  // namespace dcharts
