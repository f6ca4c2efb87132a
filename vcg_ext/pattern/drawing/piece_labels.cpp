// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/drawing/piece_labels.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "common/pi.h"
#include "pattern/drawing/number_text.h"
#include "pattern/segments.h"
#include "planar/polygon.h"

namespace dcharts {

namespace {

constexpr double kClear = 0.4;         // mm that stay free around a label
constexpr double kLargestName = 9;     // mm, font size of the piece's name
constexpr double kSmallestText = 1.4;  // mm: what can still be read
constexpr int kDirections = 36;        // of a leader line
constexpr double kReach = 120;         // mm, length of the longest leader line

// A label of one or more lines of text, one below the other.
struct Label {
  std::vector<Text> lines;  // sizes are relative to the first one's
  double size = 3;
  double angle = 0;

  Box BoxAt(const Point2& center, double scale) const {
    double width = 0, height = 0;
    for (const Text& line : lines) {
      width = std::max(width, TextWidth(line.text) * line.size);
      height += kLineHeight * line.size;
    }
    return {center, Point2(width, height) * (size * scale / 2), angle};
  }

  std::vector<Text> TextsAt(const Point2& center, double scale) const {
    const Box box = BoxAt(center, scale);
    std::vector<Text> texts;
    double y = box.half.y();
    for (Text line : lines) {
      line.size *= size * scale;
      y -= kLineHeight * line.size / 2;
      line.at = center + y * box.AxisY();
      y -= kLineHeight * line.size / 2;
      line.angle = angle;
      texts.push_back(std::move(line));
    }
    return texts;
  }

  static constexpr double kLineHeight = 1.05;
};

// So that the text is not upside down.
double Upright(double angle) {
  while (angle > kPi / 2) angle -= kPi;
  while (angle <= -kPi / 2) angle += kPi;
  return angle;
}

class Labeller {
 public:
  Labeller(const Pattern& pattern, const PlacedPiece& placed, const std::vector<PlacedPiece>& others,
           LabelSpace& space, Group& group)
      : pattern_(pattern),
        piece_(*placed.piece),
        placed_(placed),
        others_(others),
        space_(space),
        group_(group),
        home_(placed.placement(piece_.label_at)) {}

  std::vector<std::string> Run() {
    AddName();
    if (pattern_.material == PatternMaterial::kFabric) AddGrain();
    for (const SideRun& run : placed_.sides) AddMatchNumbers(run);
    for (const SideRun& run : placed_.sides) AddSeam(run);
    for (const Fold& fold : piece_.folds) AddFold(fold);
    return std::move(unplaced_);
  }

 private:
  bool IsFreeInPiece(const Box& box) const {
    return IsInside(placed_.net, box.center) && space_.IsFree(box.Grown(kClear));
  }

  bool IsFreeOutside(const Box& box) const {
    if (!space_.IsFree(box.Grown(kClear))) return false;
    return std::none_of(others_.begin(), others_.end(), [&](const PlacedPiece& other) {
      const Point2& p = box.center;
      return (p.array() >= other.low.array()).all() && (p.array() <= other.high.array()).all() &&
             IsInside(other.cut, p);
    });
  }

  void Put(const Label& label, const Point2& center, double scale) {
    for (const Text& text : label.TextsAt(center, scale)) group_.texts.push_back(text);
    space_.AddBox(label.BoxAt(center, scale));
  }

  bool PutIfFree(const Label& label, const Point2& center, double scale) {
    if (!IsFreeInPiece(label.BoxAt(center, scale))) return false;
    Put(label, center, scale);
    return true;
  }

  // Puts the label somewhere around one of the targets, with a line to it: within the piece, else outside.
  void PutWithLeader(Label label, const std::vector<Point2>& targets) {
    label.angle = 0;
    for (bool inside : {true, false})
      for (double scale : Scales(label, 0.8))
        for (const Point2& target : targets) {
          const std::optional<Box> box = LeadTo(label.BoxAt({0, 0}, scale), target, inside);
          if (!box) continue;
          Put(label, box->center, scale);
          return;
        }
    unplaced_.push_back(label.lines[0].text);
  }

  // The box at the nearest free place around `target`, and a line drawn between them.
  std::optional<Box> LeadTo(Box box, const Point2& target, bool inside) {
    for (double reach = 3; reach < kReach; reach *= 1.25)
      for (int k = 0; k < kDirections; ++k) {
        const double angle = 2 * kPi * k / kDirections;
        box.center = target + reach * Point2(std::cos(angle), std::sin(angle));
        if ((inside ? IsFreeInPiece(box) : IsFreeOutside(box)) && PutLeader(box, target, inside)) return box;
      }
    return std::nullopt;
  }

  bool PutLeader(const Box& box, const Point2& target, bool inside) {
    const Point2 way = target - box.center;
    const double length = way.norm();
    const Point2 unit = way / length;
    const Point2 x = box.AxisX(), y = box.AxisY();
    const double leave = std::min(box.half.x() / std::max(1e-9, std::abs(unit.dot(x))),
                                  box.half.y() / std::max(1e-9, std::abs(unit.dot(y)))) +
                         kClear / 2;
    const double end = length - (inside ? kClear : 0);
    if (end <= leave + kClear) return false;
    const Point2 from = box.center + leave * unit, to = box.center + end * unit;
    if (!space_.IsFree(from, to, inside ? -1 : piece_.id)) return false;
    group_.lines.push_back({Mark::kLeader, {from, to}});
    space_.AddLine({from, to}, false, -1);
    return true;
  }

  // Font sizes to try, as factors of the label's own.
  static std::vector<double> Scales(const Label& label, double step) {
    std::vector<double> scales;
    for (double scale = 1; label.size * scale > kSmallestText; scale *= step) scales.push_back(scale);
    scales.push_back(std::min(1.0, kSmallestText / label.size));
    return scales;
  }

  void AddName() {
    const std::string number = std::to_string(piece_.id + 1);
    const char* side = pattern_.material == PatternMaterial::kFabric ? "right side" : "outside";
    const std::string quantity = std::to_string(piece_.copies) + "," + std::to_string(piece_.mirror_copies);
    Label label;
    label.lines = {{piece_.name, {}, 1, 0, "Piece Name: " + piece_.name},
                   {QuantityText(piece_), {}, 0.6, 0, "Quantity: " + quantity},
                   {side, {}, 0.6, 0, "Annotation: " + std::string(side)}};
    label.size = std::clamp(piece_.label_radius * 0.36, 2.4, kLargestName);
    for (double scale : Scales(label, 0.85))
      for (double away : {0.0, 0.25, 0.5})
        for (int k = 0; k < (away > 0 ? 8 : 1); ++k) {
          const double angle = kPi / 4 * k;
          const Point2 center = home_ + away * piece_.label_radius * Point2(std::cos(angle), std::sin(angle));
          if (PutIfFree(label, center, scale)) return;
        }
    PutWithLeader(label, {home_});
  }

  // The longest arrow that has room, near the name.
  void AddGrain() {
    const Point2 along = placed_.Turned(piece_.grain), across(-along.y(), along.x());
    constexpr double kHalfWidth = 1.2, kShortest = 3;
    const double angle = std::atan2(along.y(), along.x());
    for (double length = std::clamp(1.5 * piece_.label_radius, kShortest, 90.0);; length *= 0.85) {
      const double tried = std::max(length, kShortest);
      for (int i = 0; i < 60; ++i)
        for (double shift : {0.0, 0.3, -0.3, 0.6, -0.6}) {
          const double step = ((i + 1) / 2) * (i % 2 == 0 ? 0.1 : -0.1) * std::max(5.0, piece_.label_radius);
          const Point2 center = home_ + step * across + shift * piece_.label_radius * along;
          const Box box{center, {tried / 2, kHalfWidth}, angle};
          if (!IsFreeInPiece(box)) continue;
          PutGrain(center, along, across, tried);
          space_.AddBox(box);
          return;
        }
      if (tried == kShortest) break;
    }
    constexpr double kOutside = 8;
    constexpr std::size_t kTargets = 8;
    const Polyline& outline = placed_.net[0];
    for (std::size_t k = 0; k < kTargets; ++k) {
      const Point2& target = outline[k * outline.size() / kTargets];
      if (const auto box = LeadTo({target, {kOutside / 2, kHalfWidth}, angle}, target, false)) {
        PutGrain(box->center, along, across, kOutside);
        space_.AddBox(*box);
        return;
      }
    }
    unplaced_.push_back("grain arrow");
  }

  void PutGrain(const Point2& center, const Point2& along, const Point2& across, double length) {
    const Point2 a = center - length / 2 * along, b = center + length / 2 * along;
    const double head = std::min(2.5, length / 3), wide = std::min(1.0, length / 6);
    group_.lines.push_back({Mark::kGrain, {a, b}});
    for (int end : {0, 1}) {
      const Point2 tip = end == 0 ? a : b, back = (end == 0 ? 1 : -1) * head * along;
      group_.lines.push_back({Mark::kGrain, {tip + back + wide * across, tip, tip + back - wide * across}});
    }
  }

  void AddMatchNumbers(const SideRun& run) {
    for (const MatchPoint& point : pattern_.seams[run.seam].match_points) {
      const Point2 at = placed_.placement(point.at[run.side]);
      const Point2 inward = -placed_.Turned(point.outward[run.side]);
      Label label{{{std::to_string(point.number), {}, 1}}, 2.4};
      if (!PutBeside(label, at, inward)) PutWithLeader(label, {at + 1.2 * inward});
    }
  }

  // Just inside the outline, straight or a little to the side of the point.
  bool PutBeside(const Label& label, const Point2& at, const Point2& inward) {
    const Point2 along(-inward.y(), inward.x());
    for (double scale : Scales(label, 0.85)) {
      const Box box = label.BoxAt(at, scale);
      const double reach = std::abs(inward.x()) * box.half.x() + std::abs(inward.y()) * box.half.y();
      for (double away : {1.6, 2.4, 3.4})
        for (double aside : {0.0, 1.0, -1.0, 2.0, -2.0, 3.0, -3.0})
          if (PutIfFree(label, at + (reach + away) * inward + aside * label.size * 0.6 * along, scale))
            return true;
    }
    return false;
  }

  void AddSeam(const SideRun& run) {
    const Seam& seam = pattern_.seams[run.seam];
    Label label{{{SeamText(pattern_, seam, run.side), {}, 1}}, 3};
    const double length = LengthOf(run.points);
    for (double scale : Scales(label, 0.85)) {
      const double height = label.BoxAt({0, 0}, scale).half.y();
      for (double away : {1.0, 2.5, 4.5, 7.0})
        for (double t : {0.5, 0.42, 0.58, 0.34, 0.66, 0.26, 0.74, 0.18, 0.82}) {
          const auto [at, along] = AtLength(run.points, t * length);
          label.angle = Upright(std::atan2(along.y(), along.x()));
          if (PutIfFree(label, at + (height + away) * Point2(-along.y(), along.x()), scale)) return;
        }
    }
    // Not to the middle, where a match point may be.
    std::vector<Point2> targets;
    for (double t : {0.4, 0.62, 0.22, 0.8, 0.1, 0.9}) {
      const auto [at, along] = AtLength(run.points, t * length);
      targets.push_back(at + 0.2 * Point2(-along.y(), along.x()));
    }
    PutWithLeader(label, targets);
  }

  void AddFold(const Fold& fold) {
    const Polyline line = placed_.Placed(fold.line);
    const std::string text = NumberText(fold.angle_degrees, 0) + "\xC2\xB0";
    const double length = LengthOf(line);
    if (IsAsOneNear(fold, AtLength(line, length / 2).first)) return;
    labelled_folds_.push_back({fold.mountain, fold.angle_degrees, line});
    Label label{{{text, {}, 1}}, 2.2};
    for (double scale : Scales(label, 0.85)) {
      const double height = label.BoxAt({0, 0}, scale).half.y();
      for (double away : {0.8, 2.0})
        for (double t : {0.5, 0.35, 0.65, 0.2, 0.8})
          for (double side : {1.0, -1.0}) {
            const auto [at, along] = AtLength(line, t * length);
            label.angle = Upright(std::atan2(along.y(), along.x()));
            if (PutIfFree(label, at + side * (height + away) * Point2(-along.y(), along.x()), scale)) return;
          }
    }
    // A thicket of leaders would hide what the short folds of a round part are.
    constexpr double kWorthALeader = 12;  // mm
    if (length >= kWorthALeader)
      PutWithLeader(label, {AtLength(line, length / 2).first, AtLength(line, length / 3).first});
  }

  // A round part has many folds of about one angle side by side: a number here and there says it.
  bool IsAsOneNear(const Fold& fold, const Point2& middle) const {
    constexpr double kNear = 15, kAlike = 3;  // mm; degrees: nobody folds better
    return std::any_of(labelled_folds_.begin(), labelled_folds_.end(), [&](const LabelledFold& other) {
      if (other.mountain != fold.mountain || std::abs(other.degrees - fold.angle_degrees) > kAlike)
        return false;
      for (std::size_t k = 0; k + 1 < other.line.size(); ++k)
        if (DistanceToSegment(middle, other.line[k], other.line[k + 1]) < kNear) return true;
      return false;
    });
  }

  struct LabelledFold {
    bool mountain = true;
    double degrees = 0;
    Polyline line;
  };

  const Pattern& pattern_;
  const Piece& piece_;
  const PlacedPiece& placed_;
  const std::vector<PlacedPiece>& others_;
  LabelSpace& space_;
  Group& group_;
  Point2 home_;
  std::vector<LabelledFold> labelled_folds_{};
  std::vector<std::string> unplaced_{};
};

}  // namespace

std::string QuantityText(const Piece& piece) {
  std::string text = "cut " + std::to_string(piece.copies);
  if (piece.mirror_copies > 0) text += " + " + std::to_string(piece.mirror_copies) + " mirrored";
  return text;
}

std::string SeamText(const Pattern& pattern, const Seam& seam, int side) {
  const std::string name = "S" + std::to_string(seam.id + 1);
  if (seam.is_dart) return name + " dart";
  if (seam.IsBorder()) return name + " edge";
  std::string text = name + ": " + std::to_string(pattern.pieces[seam.sides[side].piece].id + 1) + " to ";
  bool first = true;
  for (int s = 0; s < static_cast<int>(seam.sides.size()); ++s) {
    if (s == side) continue;
    text += (first ? "" : ", ") + std::to_string(seam.sides[s].piece + 1);
    first = false;
  }
  return text + (seam.opening ? ", opening" : "");
}

std::vector<std::string> AddPieceLabels(const Pattern& pattern, const PlacedPiece& placed,
                                        const std::vector<PlacedPiece>& others, LabelSpace& space,
                                        Group& group) {
  return Labeller(pattern, placed, others, space, group).Run();
}

}  // namespace dcharts
