// What the program says of a certificate that was broken by hand.
#include "certificate_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace geovor {
namespace {

using testing::HasSubstr;

/// The claims "areas", which holds, and "stars", which may fail at edge 7.
Certificate certificate(bool stars_hold) {
  Certificate c;
  c.claims.push_back({"areas", "they add up", true, 1e-9, 1e-6, CertificateClaim::Offender::None, -1, {}, ""});
  c.claims.push_back(
      {"stars", "angles grow", stars_hold, 0.5, 1e-9, CertificateClaim::Offender::Edge, 7, {0.25, 0.5}, "turns back"});
  c.result = "so much for that";
  return c;
}

TEST(CertificateReport, NamesTheClaimThatFailsWithItsPlace) {
  EXPECT_EQ(failed_claim(certificate(false)),
            "the claim 'stars' of the certificate fails near u = 0.25, v = 0.5: turns back");
  EXPECT_FALSE(failed_claim(certificate(true)));
}

TEST(CertificateReport, HasALineForEachClaimAndTheResult) {
  const std::string text = certificate_text(certificate(false));
  EXPECT_THAT(text, HasSubstr("areas: holds (1e-09, bound 1e-06)\n"));
  EXPECT_THAT(text, HasSubstr("stars: fails (0.5, bound 1e-09)\n"));
  EXPECT_THAT(text, HasSubstr("so much for that\n"));
}

TEST(CertificateReport, FailsWhereTheCertificateDoes) {
  for (bool holds : {true, false}) {
    EXPECT_EQ(certificate(holds).holds(), !failed_claim(certificate(holds)));
  }
}

}  // namespace
}  // namespace geovor
