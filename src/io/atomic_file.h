// Files that are complete or absent.
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace geovor {

/// A file on its way: it is written beside its place, and commit() puts it there in one step. Without commit() nothing
/// remains and an older file at `path` is untouched. A link is followed; what is no ordinary file (a pipe, /dev/stdout)
/// can't be replaced and is written to directly.
class AtomicFile {
 public:
  /// Reserves the name beside `path`. Throws Error(Unwritable).
  explicit AtomicFile(const std::string& path);
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  ~AtomicFile();

  /// Where to write, for a writer that wants a path of its own.
  const std::string& place() const { return place_; }

  /// Takes the next bytes of a file.
  using Drain = std::function<void(std::string_view bytes)>;

  /// Replaces the content of place(), by what `produce` hands to its drain, piece by piece. Throws Error(Unwritable).
  void write(const std::function<void(const Drain&)>& produce);
  void write(std::string_view bytes);

  /// Moves place() to the path. Throws Error(Unwritable).
  void commit();

 private:
  [[noreturn]] void fail(const std::string& reason) const;

  std::string path_;    ///< as the user gave it, for messages
  std::string target_;  ///< with links followed
  std::string place_;
  bool pending_ = false;
};

/// The whole life of an AtomicFile. Throws Error(Unwritable): "PATH: can't be written (why); ...".
void write_file(const std::string& path, std::string_view bytes);

}  // namespace geovor
