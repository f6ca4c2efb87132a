// SPDX-License-Identifier: GPL-3.0-or-later
/// The plugin for MeshLab 2020.09 and its meshlabserver.
#pragma once

#include <QObject>

#include <common/interfaces.h>

namespace dcharts {

class Plugin2020 : public QObject, public MeshFilterInterface {
  Q_OBJECT
  MESHLAB_PLUGIN_IID_EXPORTER(MESH_FILTER_INTERFACE_IID)
  Q_INTERFACES(MeshFilterInterface)

 public:
  Plugin2020();

  QString pluginName() const override;
  QString filterName(FilterIDType id) const override;
  QString filterInfo(FilterIDType id) const override;
  FilterClass getClass(QAction* action) override;
  FILTER_ARITY filterArity(QAction* action) const override;
  int postCondition(QAction* action) const override;
  void initParameterSet(QAction* action, MeshModel& model, RichParameterList& list) override;
  void initParameterSet(QAction* action, MeshDocument& document, RichParameterList& list) override;
  bool applyFilter(QAction* action, MeshDocument& document, const RichParameterList& parameters,
                   vcg::CallBackPos* callback) override;
};

}  // namespace dcharts
