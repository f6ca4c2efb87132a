// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>

#include "host_api.h"

namespace harness {

/// The bytes of everything a user can see of a document, by what they are ("layer 0: face quality").
using Snapshot = std::map<std::string, std::string>;

Snapshot TakeSnapshot(MeshDocument& document);

/// Names of the parts in which two snapshots differ, joined by commas; empty when they are equal.
std::string Difference(const Snapshot& before, const Snapshot& after);

}  // namespace harness
