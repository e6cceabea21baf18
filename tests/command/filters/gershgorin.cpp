// SPDX-License-Identifier: GPL-3.0-or-later
// Gershgorin: K·A is regular where each diagonal entry outweighs the rest of its row.
#include <regulus/filter.h>

#include <algorithm>

static unsigned certify(const regulus_filter_boxes* b, void*) {
  unsigned regular = b->alpha > 0 ? 0 : b->lanes;  // says nothing about |det|
  const auto lo = [&](unsigned e, unsigned l) { return b->product[2 * e * 8 + l]; };
  const auto hi = [&](unsigned e, unsigned l) { return b->product[(2 * e + 1) * 8 + l]; };
  for (unsigned l = 0; l < 8; ++l)
    for (unsigned i = 0, n = b->columns; i < n; ++i) {
      double rest = 0;
      for (unsigned e = i * n; e < (i + 1) * n; ++e)
        if (e != i * n + i) rest += std::max(-lo(e, l), hi(e, l));
      // Of 36 roundings to nearest none loses more than a part in 2^52.
      if (!(lo(i * n + i, l) > rest * (1 + 1e-12))) regular &= ~(1u << l);
    }
  return regular;
}

const regulus_filter_interface regulus_filter = {REGULUS_FILTER_ABI, "gershgorin", certify,
                                                 nullptr};
