// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace dcharts {

/// Writes a file: first beside it, under another name, then renamed, so that there is the whole file or what
/// was there before. The path is UTF-8. Throws Error with a sentence that names the file.
void SaveFile(const std::string& path, const std::string& bytes);

}  // namespace dcharts
