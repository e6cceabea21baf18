// SPDX-License-Identifier: GPL-3.0-or-later
// Gershgorin: K·A is regular if each diagonal entry is larger than the sum of its row's rest.
#include <regulus/filter.h>

#include <algorithm>

static unsigned certify(const regulus_filter_boxes* b, void*) {
  unsigned regular = b->alpha > 0 ? 0 : b->lanes;  // makes no claim about |det|
  const auto lo = [&](unsigned e, unsigned l) { return b->product[2 * e * 8 + l]; };
  const auto hi = [&](unsigned e, unsigned l) { return b->product[(2 * e + 1) * 8 + l]; };
  for (unsigned l = 0; l < 8; ++l)
    for (unsigned i = 0, n = b->columns; i < n; ++i) {
      double rest = 0;
      for (unsigned e = i * n; e < (i + 1) * n; ++e)
        if (e != i * n + i) rest += std::max(-lo(e, l), hi(e, l));
      // None of 36 roundings to nearest loses more than a part in 2^52.
      if (!(lo(i * n + i, l) > rest * (1 + 1e-12))) regular &= ~(1u << l);
    }
  return regular;
}

const regulus_filter_interface regulus_filter = {REGULUS_FILTER_ABI, "gershgorin", certify,
                                                 nullptr};
