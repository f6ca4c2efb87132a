// SPDX-License-Identifier: GPL-3.0-or-later
/// A file is written whole or not at all, to exactly the name that was given, and nothing is left beside it.
#include "pattern/drawing/save_file.h"

#include <filesystem>
#include <fstream>
#include <map>
#include <random>
#include <sstream>
#include <string>

#ifndef _WIN32
#include <cerrno>
#include <climits>
#include <csignal>

#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>
#endif

#include <gtest/gtest.h>

#include "common/errors.h"

#ifndef _WIN32
namespace {
bool g_disk_is_full = false;
}

// In place of the C library's: a disk can turn out to be full only when what was written comes to it.
extern "C" int fsync(int) {
  errno = ENOSPC;
  return g_disk_is_full ? -1 : 0;
}
#endif

namespace dcharts {
namespace {

namespace fs = std::filesystem;

class Saving : public ::testing::Test {
 protected:
  Saving() {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~Saving() override { fs::remove_all(folder_); }

  std::string At(const std::string& name) const { return (folder_ / fs::u8path(name)).u8string(); }

  void Put(const std::string& name, const std::string& content) const {
    std::ofstream(fs::u8path(At(name)), std::ios::binary) << content;
  }

  // What is in the folder, by name; a folder's content is "folder".
  std::map<std::string, std::string> All() const {
    std::map<std::string, std::string> all;
    for (const auto& entry : fs::directory_iterator(folder_)) {
      std::stringstream content;
      if (entry.is_regular_file()) content << std::ifstream(entry.path(), std::ios::binary).rdbuf();
      all[entry.path().filename().u8string()] = entry.is_directory() ? "folder" : content.str();
    }
    return all;
  }

  // The sentence that refuses it; the folder must be what it was.
  std::string Refusal(const std::string& path, const std::string& bytes = "text") const {
    const auto before = All();
    std::string sentence;
    try {
      SaveFile(path, bytes);
    } catch (const Error& error) {
      sentence = error.what();
    }
    EXPECT_EQ(All(), before);
    EXPECT_EQ(sentence.empty() ? ' ' : sentence.back(), '.') << sentence;
    return sentence;
  }

  // A folder of this process: the tests may run twice at a time.
  const fs::path folder_ =
      fs::temp_directory_path() / ("dcharts_save_" + std::to_string(std::random_device()()));
};

using Files = std::map<std::string, std::string>;

TEST_F(Saving, ANewFileAndAnotherInItsPlace) {
  const std::string first(100000, 'a');
  SaveFile(At("a.svg"), first);
  EXPECT_EQ(All(), (Files{{"a.svg", first}}));
  SaveFile(At("a.svg"), "second");
  EXPECT_EQ(All(), (Files{{"a.svg", "second"}}));
}

TEST_F(Saving, FilesOfOthersStay) {
  const Files others = {{"a.svg.part", "the user's"}, {".dcharts-0.part", "of another process"}};
  for (const auto& [name, content] : others) Put(name, content);
  SaveFile(At("a.svg"), "text");
  Files expected = others;
  expected["a.svg"] = "text";
  EXPECT_EQ(All(), expected);
}

TEST_F(Saving, NamesAreTakenAsTheyAre) {
  Files expected;
  for (const char* name :
       {"-o.svg", "a b.svg", "$(touch x).svg", "`touch x`.svg", "a;touch x.svg", "%s%n.svg", "'\".svg",
        "Schnittmuster \xC3\xA4\xE2\x82\xAC\xF0\x9F\xA7\xB8.svg", "a.svg.PDF"}) {
    SaveFile(At(name), name);
    expected[name] = name;
  }
  EXPECT_EQ(All(), expected);
}

TEST_F(Saving, NamesThatNoFileCanHave) {
  Put("a", "old");
  EXPECT_NE(Refusal(At("a") + std::string("\0.svg", 5)).find("character"), std::string::npos);
  EXPECT_NE(Refusal(At("none/a.svg")).find("does not exist"), std::string::npos);
  EXPECT_NE(Refusal(At("a/b.svg")).find("does not exist"), std::string::npos);
  const std::string long_name = std::string(300, 'n') + ".svg";
  EXPECT_NE(Refusal(At(long_name)).find(At(long_name)), std::string::npos);
  fs::create_directory(fs::u8path(At("b.svg")));
  EXPECT_NE(Refusal(At("b.svg")).find("is a folder"), std::string::npos);
}

TEST_F(Saving, AWriteProtectedFileStays) {
  Put("a.svg", "old");
  fs::permissions(fs::u8path(At("a.svg")), fs::perms::owner_read);
  EXPECT_NE(Refusal(At("a.svg")).find("write-protected"), std::string::npos);
  fs::permissions(fs::u8path(At("a.svg")), fs::perms::owner_all);
}

#ifndef _WIN32

TEST_F(Saving, LongestNames) {
  const std::string name = std::string(NAME_MAX - 4, 'n') + ".svg";
  SaveFile(At(name), "text");
  EXPECT_EQ(All(), (Files{{name, "text"}}));
}

TEST_F(Saving, PermissionsStay) {
  Put("a.svg", "old");
  fs::permissions(fs::u8path(At("a.svg")), fs::perms::owner_read | fs::perms::owner_write);
  SaveFile(At("a.svg"), "new");
  EXPECT_EQ(fs::status(fs::u8path(At("a.svg"))).permissions(),
            fs::perms::owner_read | fs::perms::owner_write);
}

TEST_F(Saving, ALinkIsReplacedAndWhatItPointsToStays) {
  Put("other", "old");
  fs::create_symlink(At("other"), fs::u8path(At("a.svg")));
  SaveFile(At("a.svg"), "new");
  EXPECT_EQ(All(), (Files{{"other", "old"}, {"a.svg", "new"}}));
  EXPECT_FALSE(fs::is_symlink(fs::u8path(At("a.svg"))));
}

TEST_F(Saving, APipeIsRefused) {
  ASSERT_EQ(mkfifo(At("a.svg").c_str(), 0600), 0);
  EXPECT_NE(Refusal(At("a.svg")).find("not an ordinary file"), std::string::npos);
}

// As on a full disk, writing ends in the midst of the file.
TEST_F(Saving, AFileThatDoesNotFitLeavesTheOldOne) {
  Put("a.svg", "old");
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit small = before;
  small.rlim_cur = 50000;
  setrlimit(RLIMIT_FSIZE, &small);
  const std::string sentence = Refusal(At("a.svg"), std::string(100000, 'n'));
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_NE(sentence.find("space"), std::string::npos) << sentence;
  EXPECT_EQ(All(), (Files{{"a.svg", "old"}}));
}

TEST_F(Saving, AFileThatDoesNotReachTheDiskLeavesTheOldOne) {
  Put("a.svg", "old");
  g_disk_is_full = true;
  const std::string sentence = Refusal(At("a.svg"));
  g_disk_is_full = false;
  EXPECT_NE(sentence.find("space"), std::string::npos) << sentence;
}

#endif

}  // namespace
}  // namespace dcharts
