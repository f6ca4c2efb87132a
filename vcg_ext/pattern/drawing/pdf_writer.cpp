// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/drawing/pdf_writer.h"

#include <algorithm>
#include <cmath>

#include <hpdf.h>

#include "common/errors.h"
#include "pattern/drawing/line_styles.h"
#include "pattern/drawing/text_box.h"

namespace dcharts {

namespace {

constexpr double kPointsPerMm = 72 / 25.4;

// libharu keeps the first error and does nothing after it, so one look at the end is enough.
void Check(HPDF_Doc document) {
  const HPDF_STATUS error = HPDF_GetError(document);
  if (error != HPDF_OK)
    throw Error("The PDF could not be made: libharu has error " + std::to_string(error) + ", detail " +
                std::to_string(HPDF_GetErrorDetail(document)) + ".");
}

// libharu 2.3 takes dashes as whole points, 2.4 as any number.
template <class Dash, class Phase>
void SetDashes(HPDF_STATUS (*set)(HPDF_Page, const Dash*, HPDF_UINT, Phase), HPDF_Page page,
               const std::vector<double>& dashes) {
  std::vector<Dash> points;
  for (double dash : dashes)
    points.push_back(static_cast<Dash>(std::max(1L, std::lround(dash * kPointsPerMm))));
  set(page, points.empty() ? nullptr : points.data(), static_cast<HPDF_UINT>(points.size()), 0);
}

class PdfDocument {
 public:
  explicit PdfDocument(const std::string& title) : document_(HPDF_New(nullptr, nullptr)) {
    if (document_ == nullptr) throw std::bad_alloc();
    HPDF_SetCompressionMode(document_, HPDF_COMP_ALL);
    HPDF_SetInfoAttr(document_, HPDF_INFO_TITLE, Latin1(title).c_str());
    HPDF_SetInfoAttr(document_, HPDF_INFO_CREATOR, "D-Charts for MeshLab");
    font_ = HPDF_GetFont(document_, "Helvetica", "WinAnsiEncoding");
    Check(document_);
  }
  PdfDocument(const PdfDocument&) = delete;
  PdfDocument& operator=(const PdfDocument&) = delete;
  ~PdfDocument() { HPDF_Free(document_); }

  void Add(const Page& page) {
    page_ = HPDF_AddPage(document_);
    HPDF_Page_SetWidth(page_, static_cast<HPDF_REAL>(page.size.x() * kPointsPerMm));
    HPDF_Page_SetHeight(page_, static_cast<HPDF_REAL>(page.size.y() * kPointsPerMm));
    HPDF_Page_SetLineJoin(page_, HPDF_ROUND_JOIN);
    for (const PageView& view : page.views) {
      HPDF_Page_GSave(page_);
      const Point2 size = view.high - view.low;
      offset_ = {0, 0};
      if (size.x() > 0 && size.y() > 0) {
        Outline({view.low, {view.high.x(), view.low.y()}, view.high, {view.low.x(), view.high.y()}}, true);
        HPDF_Page_Clip(page_);
        HPDF_Page_EndPath(page_);
      }
      offset_ = view.offset;
      for (const Group& group : view.drawing->groups) Draw(group);
      HPDF_Page_GRestore(page_);
    }
    Check(document_);
  }

  std::string File() {
    HPDF_SaveToStream(document_);
    std::string file(HPDF_GetStreamSize(document_), '\0');
    HPDF_ResetStream(document_);
    auto size = static_cast<HPDF_UINT32>(file.size());
    HPDF_ReadFromStream(document_, reinterpret_cast<HPDF_BYTE*>(&file[0]), &size);
    Check(document_);
    file.resize(size);
    return file;
  }

 private:
  static HPDF_REAL Points(double mm) { return static_cast<HPDF_REAL>(mm * kPointsPerMm); }
  HPDF_REAL X(const Point2& p) const { return Points(p.x() + offset_.x()); }
  HPDF_REAL Y(const Point2& p) const { return Points(p.y() + offset_.y()); }

  void Outline(const Polyline& points, bool closed) {
    HPDF_Page_MoveTo(page_, X(points[0]), Y(points[0]));
    for (std::size_t i = 1; i < points.size(); ++i) HPDF_Page_LineTo(page_, X(points[i]), Y(points[i]));
    if (closed) HPDF_Page_ClosePath(page_);
  }

  void Draw(const Group& group) {
    for (const Picture& picture : group.pictures) Draw(picture);
    for (Mark mark : AllMarks()) {
      const LineStyle& style = StyleOf(mark);
      bool styled = false;
      for (const Line& line : group.lines) {
        if (line.mark != mark || line.points.empty()) continue;
        if (!styled) {
          SetDashes(HPDF_Page_SetDash, page_, style.dashes);
          HPDF_Page_SetLineWidth(page_, Points(style.width));
          HPDF_Page_SetRGBStroke(page_, style.color[0] / 255.f, style.color[1] / 255.f,
                                 style.color[2] / 255.f);
          styled = true;
        }
        Outline(line.points, line.closed);
        HPDF_Page_Stroke(page_);
      }
    }
    for (const Text& text : group.texts) Draw(text);
  }

  void Draw(const Text& text) {
    const Point2 start = BaselineStart(text);
    const auto c = static_cast<HPDF_REAL>(std::cos(text.angle));
    const auto s = static_cast<HPDF_REAL>(std::sin(text.angle));
    HPDF_Page_BeginText(page_);
    HPDF_Page_SetFontAndSize(page_, font_, Points(text.size));
    HPDF_Page_SetTextMatrix(page_, c, s, -s, c, X(start), Y(start));
    HPDF_Page_ShowText(page_, Latin1(text.text).c_str());
    HPDF_Page_EndText(page_);
  }

  void Draw(const Picture& picture) {
    const HPDF_Image image =
        HPDF_LoadRawImageFromMem(document_, picture.rgb.data(), static_cast<HPDF_UINT>(picture.width),
                                 static_cast<HPDF_UINT>(picture.height), HPDF_CS_DEVICE_RGB, 8);
    HPDF_Page_GSave(page_);
    if (!picture.clip.empty()) {
      for (const Polyline& loop : picture.clip) Outline(loop, true);
      HPDF_Page_Eoclip(page_);
      HPDF_Page_EndPath(page_);
    }
    HPDF_Page_DrawImage(page_, image, X(picture.at), Y(picture.at), Points(picture.size.x()),
                        Points(picture.size.y()));
    HPDF_Page_GRestore(page_);
  }

  HPDF_Doc document_;
  HPDF_Font font_ = nullptr;
  HPDF_Page page_ = nullptr;
  Point2 offset_{0, 0};
};

}  // namespace

std::string PdfFile(const std::string& title, const std::vector<Page>& pages) {
  for (const Page& page : pages)
    if (std::max(page.size.x(), page.size.y()) > kLargestPage)
      throw Error("A page of a PDF is at most 5 metres long. Choose a page such as A0, or a smaller size.");
  PdfDocument document(title);
  for (const Page& page : pages) document.Add(page);
  return document.File();
}

}  // namespace dcharts
