#include "certificate_report.h"

#include <fmt/format.h>

#include <algorithm>

namespace geovor {

std::string certificate_text(const Certificate& certificate) {
  std::string text;
  for (const CertificateClaim& claim : certificate.claims) {
    text += fmt::format("{:<17} {}: {} ({:.3g}, bound {:.3g})\n", "claim", claim.name, claim.holds ? "holds" : "fails",
                        claim.measured, claim.bound);
  }
  return text + fmt::format("{:<17} {}\n", "certificate", certificate.result);
}

std::optional<std::string> failed_claim(const Certificate& certificate) {
  const auto failed = std::find_if(certificate.claims.begin(), certificate.claims.end(),
                                   [](const CertificateClaim& claim) { return !claim.holds; });
  if (failed == certificate.claims.end()) return std::nullopt;
  return fmt::format("the claim '{}' of the certificate fails near u = {:.6g}, v = {:.6g}: {}", failed->name,
                     failed->uv.u, failed->uv.v, failed->why);
}

}  // namespace geovor
