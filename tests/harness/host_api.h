// SPDX-License-Identifier: GPL-3.0-or-later
/// The two plugin APIs behind one face: load a plugin file, list its filters, run one with a callback.
/// Compiled with HARNESS_API_2020 for MeshLab 2020.09, without it for 2025.07.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <QAction>
#include <QPluginLoader>

#ifdef HARNESS_API_2020
#include "common/interfaces.h"
#include "common/meshmodel.h"
#else
#include "common/mlexception.h"
#include "common/parameters/rich_parameters.h"
#include "common/plugins/interfaces/filter_plugin.h"
#endif

namespace harness {

#ifdef HARNESS_API_2020
using FilterInterface = MeshFilterInterface;
#else
using FilterInterface = FilterPlugin;
#endif

/// How a filter ended. `message` is what the host would show the user.
struct Outcome {
  bool finished = false;
  std::string message;
};

/// A plugin file loaded as the host loads it. The constructor throws std::runtime_error with the loader's
/// words.
class Plugin {
 public:
  explicit Plugin(const QString& file);

  std::vector<QAction*> Filters() const;

  /// The filter's parameters with their defaults for this document.
  RichParameterList Parameters(QAction* filter, const MeshDocument& document) const;

  /// Runs the filter. An exception that the host does not know is passed on: it would end the host.
  Outcome Apply(QAction* filter, const RichParameterList& parameters, MeshDocument& document,
                vcg::CallBackPos* callback);

 private:
  QPluginLoader loader_;
  FilterInterface* filters_ = nullptr;
};

}  // namespace harness
