#include "io/atomic_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>

#include "base/error.h"

namespace geovor {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

/// An empty folder, gone after the test.
class Folder {
 public:
  Folder() {
    std::string name = (fs::temp_directory_path() / "geovor-test-XXXXXX").string();
    path_ = mkdtemp(name.data());
  }
  ~Folder() { fs::remove_all(path_); }
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }
  int entries() const { return static_cast<int>(std::distance(fs::directory_iterator(path_), {})); }

 private:
  fs::path path_;
};

std::string content(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

ErrorCode code_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("; "));
    return error.code();
  }
  ADD_FAILURE() << "no Error";
  return ErrorCode::Internal;
}

/// No file may grow beyond this while the object lives: a disk that is full.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) {
    std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit now{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &now);
  }
  ~FullDisk() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, SIG_DFL);
  }

 private:
  rlimit before_;
};

TEST(AtomicFile, HoldsTheBytesAndNothingRemainsBesideIt) {
  const Folder folder;
  const std::string bytes("a\0b\r\n", 5);
  write_file(folder / "x.stl", bytes);
  EXPECT_EQ(content(folder / "x.stl"), bytes);
  write_file(folder / "x.stl", "second");
  EXPECT_EQ(content(folder / "x.stl"), "second");
  EXPECT_EQ(folder.entries(), 1);
}

TEST(AtomicFile, KeepsTheOldFileWithoutCommit) {
  const Folder folder;
  write_file(folder / "x", "old");
  {
    AtomicFile file(folder / "x");
    file.write("new");
    EXPECT_EQ(content(folder / "x"), "old");
    EXPECT_EQ(content(file.place()), "new");
  }
  EXPECT_EQ(content(folder / "x"), "old");
  EXPECT_EQ(folder.entries(), 1);
}

TEST(AtomicFile, LeavesNothingOnAFullDisk) {
  const Folder folder;
  {
    const FullDisk disk(4096);
    EXPECT_EQ(code_of([&] { write_file(folder / "x", std::string(100000, 'x')); }), ErrorCode::Unwritable);
  }
  EXPECT_EQ(folder.entries(), 0);
  EXPECT_EQ(code_of([&] { write_file("/dev/full", "x"); }), ErrorCode::Unwritable);
}

TEST(AtomicFile, LeavesNothingWhereItMayNotWrite) {
  const Folder folder;
  EXPECT_EQ(code_of([&] { write_file(folder / "absent/x", "x"); }), ErrorCode::Unwritable);
  EXPECT_EQ(code_of([&] { write_file("/proc/x", "x"); }), ErrorCode::Unwritable);
  fs::create_directory(folder / "d");
  EXPECT_EQ(code_of([&] { write_file(folder / "d", "x"); }), ErrorCode::Unwritable);
  EXPECT_EQ(folder.entries(), 1);
}

TEST(AtomicFile, FollowsLinksAndWritesToDevices) {
  const Folder folder;
  write_file(folder / "target", "old");
  fs::create_symlink("target", folder / "link");
  write_file(folder / "link", "new");
  EXPECT_TRUE(fs::is_symlink(folder / "link"));
  EXPECT_EQ(content(folder / "target"), "new");
  EXPECT_NO_THROW(write_file("/dev/null", "x"));
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST(AtomicFile, IsNotStoppedByLeftOvers) {
  const Folder folder;
  AtomicFile first(folder / "x");
  AtomicFile second(folder / "x");
  EXPECT_NE(first.place(), second.place());
}

}  // namespace
}  // namespace geovor
