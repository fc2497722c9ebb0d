#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

#include "io/base64.h"
#include "io/colours.h"
#include "io/face_groups.h"
#include "io/number_text.h"
#include "io/step_text.h"

namespace geovor {
namespace {

std::string in_base64(const std::string& bytes) {
  return bytes_of([&](ByteStream& out) { put_base64(out, [&](ByteStream& in) { in << bytes; }); });
}

TEST(Base64, IsThatOfRfc4648) {
  EXPECT_EQ(in_base64(""), "");
  EXPECT_EQ(in_base64("f"), "Zg==");
  EXPECT_EQ(in_base64("fo"), "Zm8=");
  EXPECT_EQ(in_base64("foo"), "Zm9v");
  EXPECT_EQ(in_base64("foobar"), "Zm9vYmFy");
}

TEST(Base64, PiecesOfAnyLengthJoinWithoutPadding) {
  const std::string bytes(100'001, 'x');
  EXPECT_EQ(in_base64(bytes).find('='), 4 * ((bytes.size() + 2) / 3) - 1);  // 100,001 = 3 * 33,333 + 2
}

TEST(NumberText, FitsSolversAndKeepsTheDouble) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> mantissa(-1.0, 1.0), exponent(-2.0, 16.0), wild(-300.0, 300.0);
  for (int i = 0; i < 20000; ++i) {
    const double usual = std::copysign(1.0, mantissa(random)) * std::pow(10.0, exponent(random));
    const double any = mantissa(random) * std::pow(10.0, wild(random));
    for (const double x : {usual, any}) {
      std::string text;
      append_within(text, x, 20);
      EXPECT_LE(text.size(), 20u);
      EXPECT_NE(text.find_first_of(".e"), std::string::npos) << text;
      const double read = std::strtod(text.c_str(), nullptr);
      EXPECT_TRUE(read == x || x != usual) << text;
      EXPECT_LE(std::abs(read - x), 5e-13 * std::abs(x)) << text;  // half a unit of the 13th digit
    }
  }
}

TEST(FaceNames, KeepWhatTheAlphabetHas) {
  const std::string name = "\xc3\x98 5 \"H7\"\\\t\xff";
  EXPECT_EQ(name_in(NameAlphabet::Text, name, 80), "\xc3\x98 5 'H7'/ ?");
  EXPECT_EQ(name_in(NameAlphabet::Word, name, 80), "\xc3\x98_5_'H7'/_?");
  EXPECT_EQ(name_in(NameAlphabet::Plain, "5 holes", 80), "N_5_holes");
  EXPECT_EQ(name_in(NameAlphabet::Plain, "\xe9\x9d\xa2", 80), "");
  EXPECT_EQ(name_in(NameAlphabet::Text, " - ", 80), "");
  // A character is kept whole or not at all.
  EXPECT_EQ(name_in(NameAlphabet::Text, "ab\xe9\x9d\xa2", 4), "ab");
}

TEST(FaceNames, AreUniqueInAnyCaseAndWithinTheirLength) {
  TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {}, {}};
  for (int face = 7; face >= 1; --face) mesh.triangles.push_back({0, 1, 2}), mesh.face_of.push_back(face);
  const std::string longer(100, 'a');
  const FaceGroups groups({.mesh = mesh,
                           .labels = {{1, "Side", {}},
                                      {2, "side", {}},
                                      {3, "Face5", {}},
                                      {4, longer + "1", {}},
                                      {6, longer + "2", {}},
                                      {7, "side_Face2", {}}}},
                          NameAlphabet::Plain, 40);
  std::set<std::string> names;
  for (const FaceGroup& group : groups) {
    EXPECT_LE(group.name.size(), 40u);
    EXPECT_EQ(mesh.face_of[group.triangles.front()], group.face);
    names.insert(group.name);
  }
  EXPECT_EQ(names.size(), 7u);
  EXPECT_EQ(groups.groups()[0].name, "Side_Face1");
  EXPECT_EQ(groups.groups()[1].name, "side_Face2_");  // Face7 has the name without the line
}

TEST(StepText, TextsAreThoseOfPart21) {
  EXPECT_EQ(step_string("it's"), "'it''s'");
  EXPECT_EQ(step_string("\xc3\x98 5"), "'\\X2\\00D8\\X0\\ 5'");
  EXPECT_EQ(step_string("\xf0\x9f\x94\xa9"), "'\\X4\\0001F529\\X0\\'");
}

TEST(StepText, RealsHaveAPointAndReadBack) {
  for (const auto& [x, text] : {std::pair{3.0, "3."}, {1e-7, "1.E-07"}, {0.1, "0.1"}, {-2.5e300, "-2.5E+300"}}) {
    EXPECT_EQ(bytes_of([x = x](ByteStream& out) { out << StepReal{x}; }), text);
  }
}

TEST(Colours, AreThoseOfTheStandard) {
  // IEC 61966-2-1: 0.5 of sRGB is 0.21404 linear; the curve is straight below 0.0031308.
  EXPECT_NEAR(srgb({0.214041140482232, 0.0, 1.0})[0], 0.5, 1e-12);
  EXPECT_NEAR(srgb({0.001, 0.0, 1.0})[0], 0.01292, 1e-15);
  EXPECT_EQ(srgb_bytes({2.0, -1.0, std::nan("")}), (std::array<std::uint8_t, 3>{255, 0, 0}));
}

}  // namespace
}  // namespace geovor
