// The files of samples/cad, found by listing the folder, so that a new sample is tested without being named anywhere.
#pragma once

#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <vector>

#include "brep/model.h"

namespace geovor::testing {

/// Names ("wave.step") in alphabetical order. Empty where the folder is missing: SamplesFolder.IsNotEmpty fails then.
std::vector<std::string> sample_files();

std::string sample_path(const std::string& name);

/// The model of a sample, read once a process.
const CadModel& sample(const std::string& name);

/// For INSTANTIATE_TEST_SUITE_P: "wave.step" -> "wave_step".
std::string test_name(const ::testing::TestParamInfo<std::string>& info);

}  // namespace geovor::testing
