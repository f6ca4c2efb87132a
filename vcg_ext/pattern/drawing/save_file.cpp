// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/drawing/save_file.h"

#include <filesystem>
#include <fstream>

#include "common/errors.h"

namespace dcharts {

void SaveFile(const std::string& path, const std::string& bytes) {
  namespace fs = std::filesystem;
  const fs::path target = fs::u8path(path);
  const Error refused("The pattern could not be written to '" + path +
                      "'. Check that its folder exists, that it can be written to, and that there is space.");
  std::error_code error;
  if (fs::is_directory(target, error)) throw refused;
  fs::path aside = target;
  aside += ".part";
  {
    std::ofstream file(aside, std::ios::binary | std::ios::trunc);
    file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    file.close();
    if (file) {
      fs::rename(aside, target, error);
      if (!error) return;
    }
  }
  fs::remove(aside, error);
  throw refused;
}

}  // namespace dcharts
