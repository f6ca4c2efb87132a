// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "host_api.h"

namespace harness {

/// Runs a filter that has `seam_layer`, with that, on a layer without quality, colour, texcoords and seams,
/// which it must add. Each time another allocation after the last callback fails: the document must be as it
/// was. Says in words what is wrong.
std::string ChangeWithoutMemory(Plugin& plugin, QAction* filter);

}  // namespace harness
