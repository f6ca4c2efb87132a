// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/drawing/dxf_writer.h"

#include <cctype>
#include <cmath>
#include <set>

#include "common/pi.h"
#include "pattern/drawing/line_styles.h"
#include "pattern/drawing/number_text.h"
#include "pattern/drawing/text_box.h"

namespace dcharts {

namespace {

constexpr double kTurnDegrees = 20;  // a corner that turns by more is a turn point, else a curve point
constexpr const char* kApplication = "DCHARTS";  // whose extended data a line has

// %% codes are DXF's way to write what is not ASCII.
std::string DxfText(const std::string& text) {
  std::string coded;
  for (unsigned char c : Latin1(text)) {
    if (c == 0xB0)
      coded += "%%d";
    else if (c == '%')
      coded += "%%%";
    else
      coded += c < 0x80 ? static_cast<char>(c) : '?';
  }
  return coded;
}

std::string BlockName(const Group& group) {
  std::string name;
  for (char c : group.id)
    name += c == '-' ? '_' : static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return name;
}

// By how much the outline turns at point i, degrees.
double TurnAt(const Line& line, std::size_t i) {
  const std::size_t n = line.points.size();
  const Point2 in = line.points[i] - line.points[(i + n - 1) % n],
               out = line.points[(i + 1) % n] - line.points[i];
  return std::abs(std::atan2(in.x() * out.y() - in.y() * out.x(), in.dot(out))) * 180 / kPi;
}

class DxfBuilder {
 public:
  explicit DxfBuilder(const Drawing& drawing) : drawing_(drawing) {}

  std::string Build() {
    std::string blocks, entities;
    for (const Group& group : drawing_.groups) {
      if (!group.is_piece) {
        entities += Entities(group);
        continue;
      }
      const std::string name = BlockName(group);
      blocks += Code(0, "BLOCK") + Code(8, Layer(1)) + Code(2, name) + Code(70, 0) + At(10, {0, 0}) +
                Code(3, name) + Entities(group) + Code(0, "ENDBLK") + Code(8, Layer(1));
      entities += Code(0, "INSERT") + Code(8, Layer(1)) + Code(2, name) + At(10, {0, 0});
    }
    return Header() + Tables() + Section("BLOCKS", blocks) + Section("ENTITIES", entities) + Code(0, "EOF");
  }

 private:
  static std::string Code(int code, const std::string& value) {
    return std::to_string(code) + "\n" + value + "\n";
  }
  static std::string Code(int code, int value) { return Code(code, std::to_string(value)); }
  static std::string Code(int code, double value) { return Code(code, NumberText(value, 6)); }

  static std::string At(int code, const Point2& p) {
    return Code(code, p.x()) + Code(code + 10, p.y()) + Code(code + 20, 0.0);
  }

  static std::string Section(const char* name, const std::string& content) {
    return Code(0, "SECTION") + Code(2, name) + content + Code(0, "ENDSEC");
  }

  std::string Layer(int number) {
    layers_.insert(number);
    return std::to_string(number);
  }

  std::string Header() const {
    return Section("HEADER", Code(9, "$ACADVER") + Code(1, "AC1009") + Code(9, "$INSUNITS") + Code(70, 4) +
                                 Code(9, "$EXTMIN") + At(10, {0, 0}) + Code(9, "$EXTMAX") +
                                 At(10, drawing_.size) + Code(9, "$LTSCALE") + Code(40, 1.0));
  }

  static std::string Table(const char* name, int count, const std::string& content) {
    return Code(0, "TABLE") + Code(2, name) + Code(70, count) + content + Code(0, "ENDTAB");
  }

  static std::string LineType(const std::string& name, const char* text, const std::vector<double>& dashes) {
    double length = 0;
    for (double dash : dashes) length += dash;
    std::string type = Code(0, "LTYPE") + Code(2, name) + Code(70, 64) + Code(3, text) + Code(72, 65) +
                       Code(73, static_cast<int>(dashes.size())) + Code(40, length);
    for (std::size_t i = 0; i < dashes.size(); ++i) type += Code(49, i % 2 == 0 ? dashes[i] : -dashes[i]);
    return type;
  }

  std::string Tables() const {
    std::string types = LineType("CONTINUOUS", "Solid line", {});
    types += LineType("DASHED", "__ __ __", StyleOf(Mark::kStitch).dashes);
    types += LineType("DASHDOT", "__ . __ .", StyleOf(Mark::kMountain).dashes);
    types += LineType("DOT", ". . . .", StyleOf(Mark::kOpening).dashes);
    std::string layers;
    const auto layer = [](const std::string& name, int color) {
      return Code(0, "LAYER") + Code(2, name) + Code(70, 0) + Code(62, color) + Code(6, "CONTINUOUS");
    };
    layers += layer("0", 7);
    for (int number : layers_) layers += layer(std::to_string(number), 1 + number % 7);
    const std::string style = Code(0, "STYLE") + Code(2, "STANDARD") + Code(70, 0) + Code(40, 0.0) +
                              Code(41, 1.0) + Code(50, 0.0) + Code(71, 0) + Code(42, 2.5) + Code(3, "txt") +
                              Code(4, "");
    const std::string application = Code(0, "APPID") + Code(2, kApplication) + Code(70, 0);
    return Section("TABLES", Table("LTYPE", 4, types) +
                                 Table("LAYER", static_cast<int>(layers_.size()) + 1, layers) +
                                 Table("STYLE", 1, style) + Table("APPID", 1, application));
  }

  std::string Entities(const Group& group) {
    std::string entities;
    for (Mark mark : AllMarks())
      for (const Line& line : group.lines)
        if (line.mark == mark) entities += Entity(line);
    for (const Text& text : group.texts) entities += Entity(text);
    return entities;
  }

  // What a line belongs to, as extended data: names, each followed by a number.
  static std::string ExtendedData(const Line& line) {
    constexpr int kName = 1000, kReal = 1040, kLong = 1071;
    std::string data;
    if (line.seam >= 0)
      data +=
          Code(kName, "seam") + Code(kLong, line.seam + 1) + Code(kName, "side") + Code(kLong, line.side + 1);
    if (line.match > 0) data += Code(kName, "match") + Code(kLong, line.match);
    if (line.angle != 0) data += Code(kName, "angle") + Code(kReal, line.angle);
    return data.empty() ? data : Code(1001, kApplication) + data;
  }

  std::string Entity(const Line& line) {
    const LineStyle& style = StyleOf(line.mark);
    const std::string layer = Layer(style.astm_layer);
    std::string entity = Code(0, "POLYLINE") + Code(8, layer) + Code(6, style.line_type) + Code(66, 1) +
                         At(10, {0, 0}) + Code(70, line.closed ? 1 : 0) + ExtendedData(line);
    for (const Point2& p : line.points) entity += Code(0, "VERTEX") + Code(8, layer) + At(10, p);
    entity += Code(0, "SEQEND") + Code(8, layer);
    if (line.mark == Mark::kCut && line.closed) {
      for (std::size_t i = 0; i < line.points.size(); ++i) {
        const int kind = TurnAt(line, i) > kTurnDegrees ? kAstmTurnPoints : kAstmCurvePoints;
        entity += Code(0, "POINT") + Code(8, Layer(kind)) + At(10, line.points[i]);
      }
    }
    return entity;
  }

  // Between two points, so that every font takes the room that was kept for it.
  std::string Entity(const Text& text) {
    const std::string layer = Layer(kAstmText);
    const Point2 start = BaselineStart(text);
    const Box box = BoxOf(text);
    const Point2 end = start + 2 * box.half.x() * box.AxisX();
    return Code(0, "TEXT") + Code(8, layer) + At(10, start) + Code(40, kCapHeight * text.size) +
           Code(1, DxfText(text.astm.empty() ? text.text : text.astm)) + Code(50, text.angle * 180 / kPi) +
           Code(72, 5) + At(11, end);
  }

  const Drawing& drawing_;
  std::set<int> layers_;
};

}  // namespace

std::string DxfFile(const Drawing& drawing) { return DxfBuilder(drawing).Build(); }

}  // namespace dcharts
