// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "pattern/drawing/drawing.h"

namespace dcharts {

/// What is on a sheet besides pieces. All are added to a group, at a point given as their lower left corner.

/// A bar of this length (mm, a multiple of 10) to check the print scale, with a text beside it; 2 mm high.
void AddScaleBar(Group& group, const Point2& at, double length);

/// Samples of the kinds of line that the material has, side by side; 4 mm high. Returns its width.
double AddLegend(Group& group, const Point2& at, PatternMaterial material);

/// A line of text that starts at a point of its baseline.
void AddText(Group& group, const Point2& start, const std::string& text, double size);

/// The group somewhere else on its sheet.
Group Moved(Group group, const Point2& by);

}  // namespace dcharts
