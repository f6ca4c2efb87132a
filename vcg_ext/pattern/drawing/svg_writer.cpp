// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/drawing/svg_writer.h"

#include <cmath>

#include "common/pi.h"
#include "pattern/drawing/line_styles.h"
#include "pattern/drawing/number_text.h"
#include "pattern/drawing/png.h"
#include "pattern/drawing/text_box.h"

namespace dcharts {

namespace {

std::string Escape(const std::string& text) {
  std::string escaped;
  for (char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

std::string Base64(const std::vector<std::uint8_t>& bytes) {
  static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t left = bytes.size() - i;
    const unsigned three =
        (bytes[i] << 16) | ((left > 1 ? bytes[i + 1] : 0u) << 8) | (left > 2 ? bytes[i + 2] : 0u);
    text += digits[three >> 18];
    text += digits[(three >> 12) & 63];
    text += left > 1 ? digits[(three >> 6) & 63] : '=';
    text += left > 2 ? digits[three & 63] : '=';
  }
  return text;
}

// Builds the file's text; SVG's y points downwards.
class SvgText {
 public:
  explicit SvgText(const Drawing& drawing) : drawing_(drawing) {}

  std::string Build() {
    const std::string width = Number(drawing_.size.x()), height = Number(drawing_.size.y());
    out_ =
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
        "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" "
        "xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\" version=\"1.1\" width=\"" +
        width + "mm\" height=\"" + height + "mm\" viewBox=\"0 0 " + width + " " + height + "\">\n<title>" +
        Escape(drawing_.title) + "</title>\n";
    for (const Group& group : drawing_.groups) AddGroup(group);
    return out_ + "</svg>\n";
  }

 private:
  static std::string Number(double value) { return NumberText(value, 4); }

  std::string Pair(const Point2& p) const { return Number(p.x()) + "," + Number(drawing_.size.y() - p.y()); }

  std::string Path(const Line& line) const {
    std::string path = "M";
    for (std::size_t i = 0; i < line.points.size(); ++i) path += (i == 0 ? "" : " ") + Pair(line.points[i]);
    return path + (line.closed ? " Z" : "");
  }

  void OpenLayer(const Group& group, const std::string& layer, const std::string& attributes) {
    out_ += "<g id=\"" + group.id + "-" + layer + "\" class=\"" + layer +
            "\" inkscape:groupmode=\"layer\" inkscape:label=\"" + layer + "\"" + attributes + ">\n";
  }

  void AddGroup(const Group& group) {
    out_ += "<g id=\"" + group.id + "\" class=\"" + (group.is_piece ? "piece" : "sheet") +
            "\" inkscape:groupmode=\"layer\" inkscape:label=\"" + Escape(group.name) + "\">\n";
    if (!group.pictures.empty()) {
      OpenLayer(group, "texture", "");
      for (std::size_t i = 0; i < group.pictures.size(); ++i)
        AddPicture(group.pictures[i], group.id + "-clip-" + std::to_string(i + 1));
      out_ += "</g>\n";
    }
    AddLines(group);
    if (!group.texts.empty()) {
      OpenLayer(group, "text",
                " font-family=\"Helvetica, Arial, 'Liberation Sans', sans-serif\" text-anchor=\"middle\" "
                "fill=\"#000000\"");
      for (const Text& text : group.texts) AddText(text);
      out_ += "</g>\n";
    }
    out_ += "</g>\n";
  }

  void AddLines(const Group& group) {
    std::string open;
    for (Mark mark : AllMarks()) {
      const LineStyle& style = StyleOf(mark);
      for (const Line& line : group.lines) {
        if (line.mark != mark) continue;
        // The leaders of labels are told from the labels by their name: both are of the layer "text".
        const std::string layer = mark == Mark::kLeader ? "leader" : style.layer;
        if (layer != open) {
          if (!open.empty()) out_ += "</g>\n";
          OpenLayer(group, layer, " fill=\"none\" stroke-linejoin=\"round\"");
          open = layer;
        }
        AddLine(line, style);
      }
    }
    if (!open.empty()) out_ += "</g>\n";
  }

  void AddLine(const Line& line, const LineStyle& style) {
    static const char hex[] = "0123456789abcdef";
    std::string color = "#";
    for (int c : style.color) color += {hex[c / 16], hex[c % 16]};
    out_ += "<path d=\"" + Path(line) + "\" stroke=\"" + color + "\" stroke-width=\"" + Number(style.width) +
            "\"";
    if (!style.dashes.empty()) {
      out_ += " stroke-dasharray=\"";
      for (std::size_t i = 0; i < style.dashes.size(); ++i)
        out_ += (i == 0 ? "" : ",") + Number(style.dashes[i]);
      out_ += "\"";
    }
    if (line.seam >= 0)
      out_ += " data-seam=\"" + std::to_string(line.seam + 1) + "\" data-side=\"" +
              std::to_string(line.side + 1) + "\"";
    if (line.match > 0) out_ += " data-match=\"" + std::to_string(line.match) + "\"";
    if (line.angle != 0) out_ += " data-angle=\"" + Number(line.angle) + "\"";
    out_ += "/>\n";
  }

  void AddText(const Text& text) {
    const Box box = BoxOf(text);
    const Point2 middle = BaselineStart(text) + box.half.x() * box.AxisX();
    // With its length given, every font takes the room that was kept for it.
    out_ += "<text transform=\"translate(" + Pair(middle) + ")";
    if (text.angle != 0) out_ += " rotate(" + Number(-text.angle * 180 / kPi) + ")";
    out_ += "\" font-size=\"" + Number(text.size) + "\" textLength=\"" +
            Number(TextWidth(text.text) * text.size) + "\" lengthAdjust=\"spacingAndGlyphs\">" +
            Escape(text.text) + "</text>\n";
  }

  void AddPicture(const Picture& picture, const std::string& clip) {
    if (!picture.clip.empty()) {
      std::string path;
      for (const Polyline& loop : picture.clip) path += Path({Mark::kCut, loop, true}) + " ";
      out_ += "<clipPath id=\"" + clip + "\"><path clip-rule=\"evenodd\" d=\"" + path + "\"/></clipPath>\n";
    }
    const Point2 corner = picture.at + Point2(0, picture.size.y());
    out_ += "<image x=\"" + Number(corner.x()) + "\" y=\"" + Number(drawing_.size.y() - corner.y()) +
            "\" width=\"" + Number(picture.size.x()) + "\" height=\"" + Number(picture.size.y()) +
            "\" preserveAspectRatio=\"none\"" +
            (picture.clip.empty() ? "" : " clip-path=\"url(#" + clip + ")\"") +
            " xlink:href=\"data:image/png;base64," + Base64(PngFile(picture)) + "\"/>\n";
  }

  const Drawing& drawing_;
  std::string out_;
};

}  // namespace

std::string SvgFile(const Drawing& drawing) { return SvgText(drawing).Build(); }

}  // namespace dcharts
