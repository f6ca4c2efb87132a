// SPDX-License-Identifier: GPL-3.0-or-later
#include "adapter_2025.h"

#include <common/parameters/rich_parameters.h>

#include "host_filter.h"

namespace dcharts {

namespace {

struct Host {
  static void UpdateBox(MeshModel& layer) { layer.updateBoxAndNormals(); }
  static QImage Texture(const MeshModel& model, const std::string& name) {
    const auto texture = model.getTextures().find(name);
    return texture != model.getTextures().end() ? texture->second : QImage();
  }
  static void RemoveLayer(MeshDocument& document, MeshModel& layer) {
    document.delMesh(static_cast<unsigned int>(layer.id()));
  }
};

const FilterSpec& SpecOf(MeshLabPlugin::ActionIDType id) { return GetFilter(static_cast<FilterId>(id)); }

}  // namespace

Plugin2025::Plugin2025() {
  for (const FilterSpec& filter : AllFilters()) {
    const auto id = static_cast<ActionIDType>(filter.id);
    typeList.push_back(id);
    actionList.push_back(new QAction(filterName(id), this));
  }
}

QString Plugin2025::pluginName() const { return "FilterDCharts"; }

QString Plugin2025::vendor() const { return "D-Charts"; }

QString Plugin2025::filterName(ActionIDType id) const { return SpecOf(id).name; }

QString Plugin2025::pythonFilterName(ActionIDType id) const { return SpecOf(id).python_name; }

QString Plugin2025::filterInfo(ActionIDType id) const { return QString::fromStdString(HelpText(SpecOf(id))); }

FilterPlugin::FilterClass Plugin2025::getClass(const QAction* action) const {
  return ClassOf<FilterPlugin>(SpecOf(ID(action)));
}

// Not SINGLE_MESH, which gives a filter a preview: leaving a preview restores colours, but neither quality
// nor texture coordinates.
FilterPlugin::FilterArity Plugin2025::filterArity(const QAction*) const { return FIXED; }

int Plugin2025::postCondition(const QAction* action) const {
  return PostConditionMask<MeshModel>(SpecOf(ID(action)));
}

RichParameterList Plugin2025::initParameterList(const QAction* action, const MeshModel&) {
  RichParameterList list;
  AddParams(SpecOf(ID(action)), list);
  return list;
}

// The inherited one takes the current mesh, which need not exist.
RichParameterList Plugin2025::initParameterList(const QAction* action, const MeshDocument&) {
  RichParameterList list;
  AddParams(SpecOf(ID(action)), list);
  return list;
}

std::map<std::string, QVariant> Plugin2025::applyFilter(const QAction* action,
                                                        const RichParameterList& parameters,
                                                        MeshDocument& document,
                                                        unsigned int& post_condition_mask,
                                                        vcg::CallBackPos* callback) {
  const FilterSpec& filter = SpecOf(ID(action));
  const auto progress = [callback](int percent, const char* text) {
    return callback == nullptr || callback(percent, text);
  };
  const auto write_log = [this](const std::string& line) { log(line); };
  std::map<std::string, QVariant> figures;
  const auto tell = [&](const Report& report) {
    for (const auto& [name, value] : Figures(report))
      figures[name] = std::visit([](auto number) { return QVariant(number); }, value);
  };
  try {
    RunOnDocument<Host>(filter, parameters, document, progress, write_log, tell);
    post_condition_mask = static_cast<unsigned int>(PostConditionMask<MeshModel>(filter));
    return figures;
  } catch (const Error& error) {
    throw MLException(QString::fromUtf8(error.what()));
  }
}

}  // namespace dcharts
