// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "host_api.h"

namespace harness {

/// Runs the filter on the test mesh and on the same without its deleted elements: quality, colour and
/// texcoords must be equal. Says in words what differs.
std::string DifferenceByDeleted(Plugin& plugin, QAction* filter);

}  // namespace harness
