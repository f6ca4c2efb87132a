// SPDX-License-Identifier: GPL-3.0-or-later
#include "adapter_2020.h"

#include <QDir>
#include <QFileInfo>

using RichFileSave = RichSaveFile;  // as MeshLab 2025.07 calls it

#include "host_filter.h"

namespace dcharts {

namespace {

struct Host {
  static void UpdateBox(MeshModel& layer) { layer.UpdateBoxAndNormals(); }
  static QImage Texture(const MeshModel& model, const std::string& name) {
    // MeshLab has made the folder of the mesh the place where its textures are.
    return QImage(QFileInfo(model.fullName()).dir().filePath(QString::fromStdString(name)));
  }
  static void RemoveLayer(MeshDocument& document, MeshModel& layer) { document.delMesh(&layer); }
};

const FilterSpec& SpecOf(MeshCommonInterface::FilterIDType id) {
  return GetFilter(static_cast<FilterId>(id));
}

}  // namespace

Plugin2020::Plugin2020() {
  for (const FilterSpec& filter : AllFilters()) {
    const auto id = static_cast<FilterIDType>(filter.id);
    typeList.push_back(id);
    actionList.push_back(new QAction(filterName(id), this));
  }
}

QString Plugin2020::pluginName() const { return "FilterDCharts"; }

QString Plugin2020::filterName(FilterIDType id) const { return SpecOf(id).name; }

QString Plugin2020::filterInfo(FilterIDType id) const { return QString::fromStdString(HelpText(SpecOf(id))); }

MeshFilterInterface::FilterClass Plugin2020::getClass(QAction* action) {
  return ClassOf<MeshFilterInterface>(SpecOf(ID(action)));
}

// Not SINGLE_MESH, which gives a filter a preview: leaving a preview restores colours, but neither quality
// nor texture coordinates. It also adds a colour component to the mesh of a colouring filter that failed.
MeshFilterInterface::FILTER_ARITY Plugin2020::filterArity(QAction*) const { return FIXED; }

int Plugin2020::postCondition(QAction* action) const {
  return PostConditionMask<MeshModel>(SpecOf(ID(action)));
}

void Plugin2020::initParameterSet(QAction* action, MeshModel&, RichParameterList& list) {
  AddParams(SpecOf(ID(action)), list);
}

// The inherited one takes the current mesh, which need not exist.
void Plugin2020::initParameterSet(QAction* action, MeshDocument&, RichParameterList& list) {
  AddParams(SpecOf(ID(action)), list);
}

bool Plugin2020::applyFilter(QAction* action, MeshDocument& document, const RichParameterList& parameters,
                             vcg::CallBackPos* callback) {
  const auto progress = [callback](int percent, const char* text) {
    return callback == nullptr || callback(percent, text);
  };
  const auto write_log = [this](const std::string& line) { Log(line); };
  const auto no_figures = [](const Report&) {};
  try {
    RunOnDocument<Host>(SpecOf(ID(action)), parameters, document, progress, write_log, no_figures);
    return true;
  } catch (const Error& error) {
    errorMessage = QString::fromUtf8(error.what());
    Log(std::string(error.what()));  // meshlabserver does not print errorMessage
    return false;
  }
}

}  // namespace dcharts
