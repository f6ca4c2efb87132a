// SPDX-License-Identifier: GPL-3.0-or-later
#include "host_api.h"

#include <stdexcept>

namespace harness {

Plugin::Plugin(const QString& file) : loader_(file) {
  QObject* instance = loader_.instance();
  if (instance == nullptr) throw std::runtime_error(loader_.errorString().toStdString());
  filters_ = qobject_cast<FilterInterface*>(instance);
  if (filters_ == nullptr) throw std::runtime_error("the file is not a filter plugin of this MeshLab");
}

std::vector<QAction*> Plugin::Filters() const {
  std::vector<QAction*> filters;
  for (QAction* action : filters_->actions()) filters.push_back(action);
  return filters;
}

#ifdef HARNESS_API_2020

RichParameterList Plugin::Parameters(QAction* filter, const MeshDocument& document) const {
  RichParameterList parameters;
  filters_->initParameterSet(filter, const_cast<MeshDocument&>(document), parameters);
  return parameters;
}

Outcome Plugin::Apply(QAction* filter, const RichParameterList& parameters, MeshDocument& document,
                      vcg::CallBackPos* callback) {
  if (filters_->applyFilter(filter, document, parameters, callback)) return {true, ""};
  return {false, filters_->errorMsg().toStdString()};
}

#else

RichParameterList Plugin::Parameters(QAction* filter, const MeshDocument& document) const {
  return filters_->initParameterList(filter, document);
}

Outcome Plugin::Apply(QAction* filter, const RichParameterList& parameters, MeshDocument& document,
                      vcg::CallBackPos* callback) {
  unsigned int post_condition = 0;
  try {
    filters_->applyFilter(filter, parameters, document, post_condition, callback);
    return {true, ""};
  } catch (const MLException& error) {
    return {false, error.what()};
  }
}

#endif

}  // namespace harness
