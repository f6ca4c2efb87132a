// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace dcharts {

/// Throws Error with a sentence when a file of that name can't be written, as far as that can be seen without
/// trying: a folder that does not exist, a folder or a device of that name, a file that is write-protected, a
/// character that no name can have. The path is UTF-8.
void CheckCanBeSaved(const std::string& path);

/// Writes a file: first beside it, under a name that nobody else has, then renamed, so that there is the
/// whole file or what was there before, and nothing else. A symbolic link of that name is replaced, not
/// followed. The path is UTF-8. Throws Error with a sentence that names the file and the reason.
void SaveFile(const std::string& path, const std::string& bytes);

}  // namespace dcharts
