#include "io/atomic_file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>

#include "base/error.h"

namespace geovor {
namespace {

namespace fs = std::filesystem;

/// Left-overs of killed runs beside a file before we give up on finding a free name.
constexpr int kMostNames = 1000;

bool is_special(const fs::path& path) {
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

fs::path follow_links(const fs::path& path) {
  std::error_code failure;
  const fs::path real = fs::canonical(path, failure);  // fails where nothing is there yet: then the path is the place
  return failure ? path : real;
}

}  // namespace

AtomicFile::AtomicFile(const std::string& path) : path_(path), target_(follow_links(path).string()) {
  std::error_code ignored;
  if (fs::is_directory(target_, ignored)) fail("it is a folder");
  if (is_special(target_)) {
    place_ = target_;
    return;
  }
  const fs::path target(target_);
  for (int i = 0; i < kMostNames; ++i) {
    // Beside its place, because a move is one step only within a file system; hidden, because it is nobody's business.
    const fs::path beside = target.parent_path() / ("." + target.filename().string() + ".part" + std::to_string(i));
    errno = 0;
    if (std::FILE* file = std::fopen(beside.c_str(), "wbx")) {  // x: fails where the name is taken
      std::fclose(file);
      place_ = beside.string();
      pending_ = true;
      return;
    }
    if (errno != EEXIST) fail(std::strerror(errno));
  }
  fail("too many unfinished files beside it");
}

AtomicFile::~AtomicFile() {
  std::error_code ignored;
  if (pending_) fs::remove(place_, ignored);
}

void AtomicFile::write(const std::function<void(const Drain&)>& produce) {
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  errno = 0;
  std::unique_ptr<std::FILE, Close> file(std::fopen(place_.c_str(), "wb"));
  if (!file) fail(std::strerror(errno));
  produce([&](std::string_view bytes) {
    if (std::fwrite(bytes.data(), 1, bytes.size(), file.get()) != bytes.size()) fail(std::strerror(errno));
  });
  // A full disk may show only when the last buffer goes out: each step is looked at.
  if (std::fflush(file.get()) != 0) fail(std::strerror(errno));
  if (std::fclose(file.release()) != 0) fail(std::strerror(errno));
}

void AtomicFile::write(std::string_view bytes) {
  write([bytes](const Drain& drain) { drain(bytes); });
}

void AtomicFile::commit() {
  if (!pending_) return;
  std::error_code failure;
  fs::rename(place_, target_, failure);
  if (failure) fail(failure.message());
  pending_ = false;
}

void AtomicFile::fail(const std::string& reason) const {
  throw Error(ErrorCode::Unwritable, path_ + ": can't be written (" + reason + "); choose another place");
}

void write_file(const std::string& path, std::string_view bytes) {
  AtomicFile file(path);
  file.write(bytes);
  file.commit();
}

}  // namespace geovor
