#include "sizes_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <numbers>

#include "base/error.h"

namespace geovor {
namespace {

CadModel model_of(const std::vector<std::string>& names) {
  CadModel model;
  for (const std::string& name : names) {
    CadFace face;
    face.number = static_cast<int>(model.faces.size()) + 1;
    face.name = name;
    model.faces.push_back(face);
  }
  return model;
}

class SizesFile : public ::testing::Test {
 protected:
  std::vector<FaceRule> read(const std::string& text) {
    std::ofstream(path_, std::ios::binary) << text;
    return read_sizes_file(path_, model_);
  }
  std::string refusal(const std::string& text) {
    try {
      read(text);
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), ErrorCode::Usage);
      return e.what();
    }
    return "";
  }
  void TearDown() override { std::filesystem::remove(path_); }

  const CadModel model_ = model_of({"bore", "", "rim, upper", "bore", "", "say \"hi\" #1"});
  const std::string path_ =
      ::testing::TempDir() + ::testing::UnitTest::GetInstance()->current_test_info()->name() + "_sizes.csv";
};

TEST_F(SizesFile, NamesFacesByNumberRangeAndName) {
  const auto rules = read("face,size\n2,0.5\nFace5,1\nbore,0.25\n\"rim, upper\",2\n\"say \"\"hi\"\" #1\",3\n");
  ASSERT_EQ(rules.size(), 6u);
  const std::vector<std::pair<int, double>> expected = {{2, 0.5}, {5, 1.0}, {1, 0.25}, {4, 0.25}, {3, 2.0}, {6, 3.0}};
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(rules[i].face, expected[i].first);
    EXPECT_EQ(rules[i].size, expected[i].second);
    EXPECT_FALSE(rules[i].angle);
  }
  EXPECT_EQ(read("\"face\",\"size\"\n\"4-6\",\"0.5\"\n").size(), 3u);
}

TEST_F(SizesFile, TakesColumnsInAnyOrderAndLeavesEmptyCellsToAllFaces) {
  const auto rules =
      read("\xEF\xBB\xBF# made by hand\n\nAngle , FACE,deflection  # a header\r\n30,1,\n,2,0.01 # fine\n");
  ASSERT_EQ(rules.size(), 2u);
  EXPECT_NEAR(rules[0].angle.value(), std::numbers::pi / 6, 1e-15);
  EXPECT_FALSE(rules[0].size || rules[0].deflection);
  EXPECT_EQ(rules[1].deflection, 0.01);
  EXPECT_FALSE(rules[1].angle);
}

TEST_F(SizesFile, NamesTheLineOfAFault) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"face,size\n\n1,nix\n", "line 3: 'nix' is no number"},
      {"face,size\n1,-2\n", "line 2: '-2' won't do"},
      {"face,size\n7,1\n", "line 2: Face7 is not there"},
      {"face,size\nBore,1\n", "line 2: no face is named 'Bore'"},
      {"face,size\n,1\n", "line 2: no face is named ''"},
      {"face,size\n1,1,1\n", "line 2: 3 cells"},
      {"face,size\n4,1\nbore,1\n", "line 3: Face4 has a rule on line 2"},
      {"face,size\n\"bore,1\n", "line 2: a quotation mark"},
      {"face,length\n", "line 1: the header has no column 'length'"},
      {"face\n", "line 1: the header needs face and a rule"},
      {"size,size\n", "line 1: the column size stands twice"},
      {"1,0.5\n", "line 1: the header has no column '1'"}};
  for (const auto& [text, message] : cases) {
    EXPECT_NE(refusal(text).find(path_ + ": " + message), std::string::npos) << text << refusal(text);
  }
  EXPECT_NE(refusal("face,size\n").find("holds no rule"), std::string::npos);
  EXPECT_NE(refusal("").find("holds no rule"), std::string::npos);
}

TEST_F(SizesFile, SaysWhereThereIsNone) {
  EXPECT_THROW(read_sizes_file(path_ + ".not", model_), Error);
  EXPECT_THROW(read_sizes_file(::testing::TempDir(), model_), Error);
}

}  // namespace
}  // namespace geovor
