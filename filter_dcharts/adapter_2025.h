// SPDX-License-Identifier: GPL-3.0-or-later
/// The plugin for MeshLab 2025.07 and pymeshlab 2025.7.
#pragma once

#include <QObject>

#include <common/plugins/interfaces/filter_plugin.h>

namespace dcharts {

class Plugin2025 : public QObject, public FilterPlugin {
  Q_OBJECT
  MESHLAB_PLUGIN_IID_EXPORTER(FILTER_PLUGIN_IID)
  Q_INTERFACES(FilterPlugin)

 public:
  Plugin2025();

  QString pluginName() const override;
  QString vendor() const override;
  QString filterName(ActionIDType id) const override;
  QString pythonFilterName(ActionIDType id) const override;
  QString filterInfo(ActionIDType id) const override;
  FilterClass getClass(const QAction* action) const override;
  FilterArity filterArity(const QAction* action) const override;
  int postCondition(const QAction* action) const override;
  RichParameterList initParameterList(const QAction* action, const MeshModel& model) override;
  RichParameterList initParameterList(const QAction* action, const MeshDocument& document) override;
  std::map<std::string, QVariant> applyFilter(const QAction* action, const RichParameterList& parameters,
                                              MeshDocument& document, unsigned int& post_condition_mask,
                                              vcg::CallBackPos* callback) override;
};

}  // namespace dcharts
