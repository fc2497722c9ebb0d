// Collects what is measured for one claim of a certificate.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "numeric/worst_of.h"
#include "voronoi/certificate.h"

namespace geovor {

/// Keeps the largest value, NaN being larger than any, and the first that breaks the bound.
class Claim {
 public:
  using Offender = CertificateClaim::Offender;

  Claim(const char* name, const char* statement, double bound) {
    claim_.name = name, claim_.statement = statement, claim_.bound = bound;
    claim_.holds = true;
    claim_.measured = -std::numeric_limits<double>::infinity();
  }

  void measure(double value, Offender kind, int id, Uv uv, const char* why) {
    claim_.measured = larger_of(claim_.measured, value);
    if (value <= claim_.bound || !claim_.holds) return;
    claim_.holds = false;
    claim_.offender = kind, claim_.id = id, claim_.uv = uv, claim_.why = why;
  }

  CertificateClaim done() const {
    CertificateClaim claim = claim_;
    if (std::isinf(claim.measured) && claim.holds) claim.measured = std::min(0.0, claim.bound);  // nothing to check
    return claim;
  }

 private:
  CertificateClaim claim_;
};

}  // namespace geovor
