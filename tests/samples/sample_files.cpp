#include "samples/sample_files.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>

#include "occ_adapter/read_cad.h"

namespace geovor::testing {

std::vector<std::string> sample_files() {
  std::vector<std::string> names;
  std::error_code missing;
  for (const auto& entry : std::filesystem::directory_iterator(GEOVOR_SAMPLES_DIR, missing))
    names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

std::string sample_path(const std::string& name) { return std::string(GEOVOR_SAMPLES_DIR) + "/" + name; }

const CadModel& sample(const std::string& name) {
  static std::map<std::string, CadModel> read;
  const auto found = read.find(name);
  return found != read.end() ? found->second : read.emplace(name, read_cad(sample_path(name))).first->second;
}

std::string test_name(const ::testing::TestParamInfo<std::string>& info) {
  std::string name = info.param;
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return !std::isalnum(c); }, '_');
  return name;
}

}  // namespace geovor::testing
