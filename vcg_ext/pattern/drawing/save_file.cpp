// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/drawing/save_file.h"

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <system_error>

#ifdef _WIN32
#include <io.h>
#else
#include <unistd.h>
#endif

#include "common/errors.h"

namespace dcharts {

namespace {

namespace fs = std::filesystem;

// Not opened when there is such a file already.
std::FILE* OpenNew(const fs::path& path) {
#ifdef _WIN32
  return _wfopen(path.c_str(), L"wbx");
#else
  return std::fopen(path.c_str(), "wbx");
#endif
}

// Whether the bytes are on the disk, not only on their way: that they don't fit may turn out as late as here.
bool Flush(std::FILE* file) {
  if (std::fflush(file) != 0) return false;
#ifdef _WIN32
  return _commit(_fileno(file)) == 0;
#else
  return fsync(fileno(file)) == 0 || errno == EINVAL;  // a file system that has no such thing
#endif
}

// A new file beside the target. It is removed again unless it has become the target.
class AsideFile {
 public:
  // The short name fits wherever the target's does.
  explicit AsideFile(const fs::path& target) {
    constexpr int kMostNames = 10000;
    for (int n = 0; n < kMostNames && file_ == nullptr; ++n) {
      path_ = target.parent_path() / (".dcharts-" + std::to_string(n) + ".part");
      errno = 0;
      file_ = OpenNew(path_);
      if (file_ == nullptr && errno != EEXIST) break;
    }
    is_there_ = file_ != nullptr;
  }
  AsideFile(const AsideFile&) = delete;
  AsideFile& operator=(const AsideFile&) = delete;
  ~AsideFile() {
    if (file_ != nullptr) std::fclose(file_);
    std::error_code ignored;
    if (is_there_) fs::remove(path_, ignored);
  }

  // Both return the error.
  std::error_code Write(const std::string& bytes) {
    if (file_ == nullptr) return Last();
    const bool written = std::fwrite(bytes.data(), 1, bytes.size(), file_) == bytes.size() && Flush(file_);
    std::error_code error = written ? std::error_code() : Last();
    if (std::fclose(file_) != 0 && !error) error = Last();
    file_ = nullptr;
    return error;
  }
  std::error_code Become(const fs::path& target) {
    std::error_code error, ignored;
    const fs::file_status old = fs::symlink_status(target, ignored);
    if (fs::is_regular_file(old)) fs::permissions(path_, old.permissions(), ignored);
    fs::rename(path_, target, error);
    if (!error) is_there_ = false;
    return error;
  }

 private:
  static std::error_code Last() { return {errno != 0 ? errno : EIO, std::generic_category()}; }

  fs::path path_;
  std::FILE* file_ = nullptr;
  bool is_there_ = false;
};

}  // namespace

void CheckCanBeSaved(const std::string& path) {
  if (path.find('\0') != std::string::npos)
    throw Error("output_file holds a character that no file name can have.");
  const fs::path target = fs::u8path(path), folder = target.parent_path();
  std::error_code ignored;
  if (!folder.empty() && !fs::is_directory(folder, ignored))
    throw Error("output_file is in a folder that does not exist: '" + folder.u8string() + "'.");
  if (fs::is_directory(target, ignored))
    throw Error("'" + path + "' is a folder. Choose another name for output_file.");
  const fs::file_status old = fs::symlink_status(target, ignored);
  if (!fs::exists(old) || fs::is_symlink(old)) return;
  if (!fs::is_regular_file(old))
    throw Error("'" + path + "' is not an ordinary file. Choose another name for output_file.");
  constexpr auto kAnyoneWrites = fs::perms::owner_write | fs::perms::group_write | fs::perms::others_write;
  if ((old.permissions() & kAnyoneWrites) == fs::perms::none)
    throw Error("The file '" + path + "' is write-protected. Choose another name for output_file.");
}

void SaveFile(const std::string& path, const std::string& bytes) {
  CheckCanBeSaved(path);
  const fs::path target = fs::u8path(path);
  AsideFile aside(target);
  std::error_code error = aside.Write(bytes);
  if (!error) error = aside.Become(target);
  if (error)
    throw Error("The pattern could not be written to '" + path + "': " + error.message() +
                ". Check that its folder can be written to, and that there is space.");
}

}  // namespace dcharts
