// SPDX-License-Identifier: GPL-3.0-or-later
/// What the adapters have in common: parameters, progress, and one run of a filter on a host's document.
/// Templates over the host's types, whose headers come first.
#pragma once

#include <string>
#include <type_traits>
#include <variant>

#include <QString>

#include "mesh_exchange.h"
#include "runner.h"

namespace dcharts {

/// Adds one parameter; the hosts that can then keep an advanced one folded away.
template <class Rich, class List, class... Args>
void AddParam(List& list, bool advanced, const Args&... args) {
  if constexpr (std::is_constructible_v<Rich, const Args&..., bool>)
    list.addParam(Rich(args..., advanced));
  else
    list.addParam(Rich(args...));
}

/// Adds the filter's parameters with their defaults to the host's list.
template <class List>
void AddParams(const FilterSpec& filter, List& list) {
  const Params defaults;
  for (const ParamSpec* spec : filter.params) {
    const QString name(spec->name), label(spec->label), tooltip(QString::fromStdString(TooltipText(*spec)));
    const bool advanced = IsAdvanced(filter, *spec);
    if (const auto* field = std::get_if<bool Params::*>(&spec->field))
      AddParam<RichBool>(list, advanced, name, defaults.**field, label, tooltip);
    else if (const auto* count = std::get_if<int Params::*>(&spec->field))
      AddParam<RichInt>(list, advanced, name, defaults.**count, label, tooltip);
    else if (const auto* number = std::get_if<double Params::*>(&spec->field))
      AddParam<RichFloat>(list, advanced, name, static_cast<float>(defaults.**number), label, tooltip);
    else if (IsFile(*spec))
      AddParam<RichFileSave>(list, advanced, name, QString(), QString("SVG, PDF, DXF (*.svg *.pdf *.dxf)"),
                             label, tooltip);
    else if (IsEnum(*spec)) {
      QStringList choices;
      for (const char* choice : spec->choices) choices << QString(choice);
      AddParam<RichEnum>(list, advanced, name, static_cast<int>(ValueOf(*spec, defaults)), choices, label,
                         tooltip);
    }
  }
}

/// The values the user gave, everything else at its default.
template <class List>
Params ReadParams(const FilterSpec& filter, const List& list) {
  Params params;
  for (const ParamSpec* spec : filter.params) {
    const QString name(spec->name);
    if (const auto* field = std::get_if<bool Params::*>(&spec->field))
      params.** field = list.getBool(name);
    else if (const auto* count = std::get_if<int Params::*>(&spec->field))
      params.** count = list.getInt(name);
    else if (const auto* number = std::get_if<double Params::*>(&spec->field))
      params.** number = FromHostFloat(static_cast<float>(list.getFloat(name)));
    else if (const auto* file = std::get_if<std::string Params::*>(&spec->field))
      params.** file = list.getSaveFileName(name).toStdString();
    else if (IsEnum(*spec))
      SetValue(*spec, list.getEnum(name), params);
  }
  return params;
}

/// The bits of the host's mask for what the filter may write. Nothing about connectivity: that would make the
/// GUI switch the face colour off.
template <class Model>
int PostConditionMask(const FilterSpec& filter) {
  int mask = Model::MM_NONE;
  if (filter.writes & kWritesQuality) mask |= Model::MM_FACEQUALITY;
  if (filter.writes & kWritesColor) mask |= Model::MM_FACECOLOR;
  if (filter.writes & kWritesTexcoords) mask |= Model::MM_WEDGTEXCOORD;
  return mask;
}

/// The menus that list the filter, as bits of the plugin interface's FilterClass.
template <class Plugin>
typename Plugin::FilterClass ClassOf(const FilterSpec& filter) {
  int bits = 0;
  if (filter.menus & kMenuTexture) bits |= Plugin::Texture;
  if (filter.menus & kMenuFaceColoring) bits |= Plugin::FaceColoring;
  if (filter.menus & kMenuMeasure) bits |= Plugin::Measure;
  return static_cast<typename Plugin::FilterClass>(bits);
}

/// Adds a layer, which does not become the current one, and fills it; when that fails, takes it away again.
template <class Host, class Document, class Fill>
void AddLayer(Document& document, const char* name, Fill fill) {
  auto* layer = document.addNewMesh(QString(), QString(name), false);
  try {
    fill(*layer);
    Host::UpdateBox(*layer);
  } catch (...) {
    Host::RemoveLayer(document, *layer);
    throw;
  }
}

/// Runs the filter on the document's current mesh and writes the result at the end; a new layer does not
/// become the current one. Host::UpdateBox(model) finishes a new layer, Host::RemoveLayer(document, model)
/// removes it, Host::Texture(model, name) is a texture's image. The report is logged, and given to
/// `tell`, before anything is written, since that may need memory that is not there. Throws Error and
/// Cancelled, nothing else; then the document is unchanged.
template <class Host, class Document, class List, class Tell>
void RunOnDocument(const FilterSpec& filter, const List& list, Document& document,
                   const Progress::Callback& callback, const Progress::Logger& log, const Tell& tell) {
  WithSentences([&] {
    Progress progress(callback, log);
    auto* model = document.mm();
    SurfaceData surface;
    const Params params = ReadParams(filter, list);
    if (model != nullptr) {
      surface = ReadSurface(model->cm);
      if (HasMatrix(model->cm)) log("The layer's matrix is applied: lengths are those that are seen.");
      if (params.print_texture) ReadColors<Host>(*model, surface);
    }
    const SurfaceChange change = RunFilter(filter, model != nullptr ? &surface : nullptr, params, progress);
    for (const std::string& line : LogLines(change.report)) log(line);
    tell(change.report);

    SurfaceWriter writer(*model, change);
    if (!change.seam_lines.empty())
      AddLayer<Host>(document, "D-Charts seams",
                     [&](auto& layer) { FillSeamLayer(change.seam_lines, layer.cm); });
    if (!change.pieces.faces.empty())
      AddLayer<Host>(document, "D-Charts pattern",
                     [&](auto& layer) { FillPieceLayer(change.pieces, layer); });
    writer.Commit();
  });
}

}  // namespace dcharts
