#include "outputs.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <mutex>
#include <set>

#include "base/error.h"

namespace geovor {
namespace {

namespace fs = std::filesystem;

/// The folders of all StagedOutputs; guarded, because the thread that handles interrupts empties it.
std::mutex staging_mutex;
std::set<std::string> staging_folders;

/// The file that a path means: what a link points at, whether that is there or not, else the path itself.
std::string target_of(const std::string& path) {
  constexpr int kMostLinks = 40;  // as the kernel allows; a circle of links ends here and fails when it is written
  fs::path target = path;
  std::error_code failure;
  for (int i = 0; i < kMostLinks && fs::is_symlink(target, failure); ++i) {
    target = target.parent_path() / fs::read_symlink(target, failure);
  }
  return target.string();
}

fs::path folder_of(const std::string& path) {
  const fs::path parent = fs::path(target_of(path)).parent_path();
  return parent.empty() ? fs::path(".") : parent;
}

bool same_file(const std::string& a, const std::string& b) {
  const auto place = [](const std::string& path) {
    std::error_code failure;
    const fs::path absolute = fs::absolute(path, failure);
    const fs::path canonical = failure ? fs::path() : fs::weakly_canonical(absolute, failure);
    return failure ? fs::path() : canonical;
  };
  // A path that means no place (an empty one, one too long) is no file; whoever opens it says what is wrong.
  const fs::path place_of_a = place(a);
  return !place_of_a.empty() && place_of_a == place(b);
}

void check_place(const std::string& path) {
  std::error_code ignored;
  const fs::path folder = folder_of(path);
  if (!fs::is_directory(folder, ignored)) {
    throw Error(ErrorCode::Unwritable,
                fmt::format("{}: there is no folder '{}'; create it first", path, folder.string()));
  }
  if (fs::is_directory(path, ignored)) {
    throw Error(ErrorCode::Unwritable, fmt::format("{}: is a folder; name a file in it", path));
  }
  if (fs::exists(path, ignored) && !fs::is_regular_file(path, ignored)) {
    throw Error(ErrorCode::Unwritable, fmt::format("{}: is no ordinary file; name another", path));
  }
  if (access(folder.c_str(), W_OK | X_OK) != 0) {
    throw Error(ErrorCode::Unwritable, fmt::format("{}: the folder '{}' can't be written to ({}); choose another", path,
                                                   folder.string(), std::strerror(errno)));
  }
}

std::string join(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

}  // namespace

std::string ending(const std::string& path) {
  std::string text = fs::path(path).extension().string();
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

void check_endings(const std::vector<std::string>& paths, const std::vector<std::string>& known) {
  for (const std::string& path : paths) {
    if (std::find(known.begin(), known.end(), ending(path)) != known.end()) continue;
    throw Error(ErrorCode::Usage, fmt::format("{}: the ending '{}' names no format that can be written; use one of {}",
                                              path, ending(path), join(known)));
  }
}

void check_outputs(const std::vector<std::string>& paths, const std::string& input, const std::string& other_input,
                   const std::string& what_other) {
  for (std::size_t i = 0; i < paths.size(); ++i) {
    if (same_file(paths[i], input)) {
      throw Error(ErrorCode::Usage, fmt::format("{}: is the input itself; choose another output", paths[i]));
    }
    if (!other_input.empty() && same_file(paths[i], other_input)) {
      throw Error(ErrorCode::Usage, fmt::format("{}: is the {}; choose another output", paths[i], what_other));
    }
    for (std::size_t k = 0; k < i; ++k) {
      if (!same_file(paths[i], paths[k])) continue;
      throw Error(ErrorCode::Usage, fmt::format("{}: is given twice as an output; name it once", paths[i]));
    }
  }
  for (const std::string& path : paths) check_place(path);
}

StagedOutputs::~StagedOutputs() {
  const std::lock_guard lock(staging_mutex);
  for (const std::string& folder : folders_) {
    std::error_code ignored;
    fs::remove_all(folder, ignored);
    staging_folders.erase(folder);
  }
}

void StagedOutputs::add(const std::string& path, const std::function<void(const std::string&)>& write) {
  // Beside its place, because only within one file system is the later move a single step. A folder a file: two outputs
  // may have the same name.
  std::string folder = (folder_of(path) / ".geovor-XXXXXX").string();
  {
    const std::lock_guard lock(staging_mutex);
    if (mkdtemp(folder.data()) == nullptr) {
      throw Error(ErrorCode::Unwritable,
                  fmt::format("{}: can't be written ({}); choose another place", path, std::strerror(errno)));
    }
    folders_.push_back(folder);
    staging_folders.insert(folder);
  }
  const std::string staged = (fs::path(folder) / fs::path(path).filename()).string();
  try {
    write(staged);
  } catch (const Error& error) {
    // The writer names the staged place, which means nothing to the user.
    std::string message = error.what();
    if (const std::size_t at = message.find(staged); at != std::string::npos) message.replace(at, staged.size(), path);
    throw Error(error.code(), message);
  }
  files_.push_back({staged, target_of(path)});
}

void StagedOutputs::commit() {
  const std::lock_guard lock(staging_mutex);
  for (const File& file : files_) {
    std::error_code failure;
    fs::rename(file.staged, file.path, failure);
    if (failure) {
      throw Error(ErrorCode::Unwritable,
                  fmt::format("{}: can't be written ({}); choose another place", file.path, failure.message()));
    }
  }
}

void remove_staged_outputs() {
  const std::lock_guard lock(staging_mutex);
  for (const std::string& folder : staging_folders) {
    std::error_code ignored;
    fs::remove_all(folder, ignored);
  }
}

}  // namespace geovor
