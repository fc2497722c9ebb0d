// The files that a command writes: checked before the work starts, written beside their place, and put there together.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace geovor {

/// The ending of a path in lower case, with its dot: ".stl"; empty where there is none.
std::string ending(const std::string& path);

/// Throws Error(Usage) where a path is given twice or is the input itself (or another input, which the message calls
/// `what_other`; empty: none), and Error(Unwritable) where the folder doesn't exist or can't be written to.
void check_outputs(const std::vector<std::string>& paths, const std::string& input, const std::string& other_input = {},
                   const std::string& what_other = {});
/// Throws Error(Usage) where an ending is none of `known`.
void check_endings(const std::vector<std::string>& paths, const std::vector<std::string>& known);

/// Files on their way: each is written into a hidden folder beside its place and moved there by commit(), so that none
/// is ever half written. What was not committed is removed with the object, or when the program is interrupted.
class StagedOutputs {
 public:
  StagedOutputs() = default;
  StagedOutputs(const StagedOutputs&) = delete;
  StagedOutputs& operator=(const StagedOutputs&) = delete;
  ~StagedOutputs();

  /// Calls write(place) with the place where the file for `path` is to be written. Throws Error(Unwritable).
  void add(const std::string& path, const std::function<void(const std::string& place)>& write);

  /// Moves all files to their paths. Throws Error(Unwritable).
  void commit();

 private:
  struct File {
    std::string staged, path;
  };
  std::vector<File> files_;
  std::vector<std::string> folders_;
};

/// Removes the files of every StagedOutputs that is not committed; for a program that is about to end.
void remove_staged_outputs();

}  // namespace geovor
