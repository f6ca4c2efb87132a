// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "host_api.h"

namespace harness {

/// Adds a layer to the document: a torus (so that handles are cut) and an open, bulged tube beside it, 384
/// faces, of which three are deleted, as are two more vertices: they are still in the host's vectors. The
/// layer has a matrix. Face quality, face colour, wedge texcoords, texture index, selection, vertex colour
/// and quality and one attribute per vertex and face have arbitrary values, so that any change of them shows.
MeshModel* AddTestMesh(MeshDocument& document);

}  // namespace harness
