// SPDX-License-Identifier: Apache-2.0
#include "runtime/proof/tree_kept.hpp"

#include <new>

namespace regulus::detail {

void TreeKept::keep(const Event& event) noexcept try {
  events_.push_back(event);
} catch (const std::bad_alloc&) {
  is_whole_ = false;
}

void TreeKept::split(const Split& split) noexcept {
  keep({split.parent, split.at, split.variable, Rule::kBlocked});
}

void TreeKept::leaf(BoxId box, Rule rule) noexcept { keep({box, 0, kNone, rule}); }

void TreeKept::clear() noexcept {
  events_.clear();
  is_whole_ = true;
}

void TreeKept::write_to(ProofFile& file, LeafWord word) const {
  if (!is_whole_) throw std::bad_alloc();
  for (const Event& event : events_)
    if (event.variable == kNone)
      file.leaf(event.box, word(event.rule));
    else
      file.split({event.box, event.variable, event.at, 0});
}

}  // namespace regulus::detail
