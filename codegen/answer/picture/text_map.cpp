// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/picture/text_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "codegen/answer/picture/axis.hpp"

namespace regulus::detail {
namespace {

constexpr std::size_t kMostMapRows = 32;

struct Sign {
  Claim claim;
  char character;
};
/// The claim that a place has is the first of those that are seen there.
constexpr std::array kSigns = {Sign{Claim::kSingular, '#'}, Sign{Claim::kUndecided, '?'},
                               Sign{Claim::kFree, '.'}, Sign{Claim::kOutside, ' '},
                               Sign{Claim::kUnreachable, '-'}};

/// The two ends of an axis, in the numbers of its label.
struct Ends {
  std::string low, high;
};

Ends ends_of(const Axis& axis) {
  const std::string both = axis.ends(axis.range());
  const std::size_t space = both.find(' ');
  return {both.substr(0, space), both.substr(space + 1)};
}

/// The characters of a map: each stands for `wide` columns and `high` rows of tiles.
class Characters {
 public:
  Characters(const Canvas& canvas, std::size_t most_columns)
      : canvas_(canvas),
        wide_(tiles_together(canvas.columns(), most_columns)),
        high_(tiles_together(canvas.rows(), kMostMapRows)) {}

  [[nodiscard]] std::size_t columns() const noexcept { return canvas_.columns() / wide_; }
  [[nodiscard]] std::size_t rows() const noexcept { return canvas_.rows() / high_; }

  [[nodiscard]] std::string row(std::size_t row) const {
    std::string text;
    for (std::size_t column = 0; column < columns(); ++column) text += sign(column, row).character;
    return text;
  }

  /// "# singular, . free"
  [[nodiscard]] std::string legend(WordOfClaim word) const {
    std::string text;
    for (const Sign& sign : kSigns)
      if (has(sign.claim) && sign.character != ' ')
        text += fmt::format("{}{} {}", text.empty() ? "" : ", ", sign.character, word(sign.claim));
    return text;
  }

 private:
  /// The numbers of tiles are powers of two.
  static std::size_t tiles_together(std::size_t tiles, std::size_t most) {
    std::size_t together = 1;
    while (tiles / together > std::max<std::size_t>(most, 1)) together *= 2;
    return together;
  }

  [[nodiscard]] Sign sign(std::size_t column, std::size_t row) const {
    std::size_t first = kSigns.size();
    for (std::size_t up = row * high_; up < (row + 1) * high_; ++up)
      for (std::size_t along = column * wide_; along < (column + 1) * wide_; ++along)
        first = std::min(first, place_of(canvas_.claim(along, up)));
    return kSigns[first];
  }

  static std::size_t place_of(Claim claim) {
    return std::size_t(std::ranges::find(kSigns, claim, &Sign::claim) - kSigns.begin());
  }

  [[nodiscard]] bool has(Claim claim) const {
    for (std::size_t up = 0; up < rows(); ++up)
      for (std::size_t along = 0; along < columns(); ++along)
        if (sign(along, up).claim == claim) return true;
    return false;
  }

  const Canvas& canvas_;
  std::size_t wide_, high_;
};

}  // namespace

std::string text_map(const SearchSubject& subject, const PictureOptions& options,
                     const Canvas& canvas, std::size_t columns) {
  const Axis across = axis_of(subject, options.drawn[0]);
  const Ends along = ends_of(across);
  std::string label = across.label();
  Ends up;
  if (!canvas.is_flat()) {
    const Axis upward = axis_of(subject, options.drawn[1]);
    up = ends_of(upward);
    label = fmt::format("{} to the right, {} upward", label, upward.label());
  }
  const std::size_t margin = std::max(up.low.size(), up.high.size());
  const Characters map(canvas, columns > margin + 1 ? columns - margin - 1 : 1);
  std::string text = fmt::format("{}: {}\n", label, map.legend(options.word));
  for (std::size_t row = map.rows(); row-- > 0;)
    text += fmt::format("{:>{}} {}\n",
                        row + 1 == map.rows() ? up.high
                        : row == 0            ? up.low
                                              : "",
                        margin, map.row(row));
  const std::size_t gap = map.columns() - std::min(map.columns(), along.high.size());
  text += fmt::format("{:{}} {:<{}}{}", "", margin, along.low, gap, along.high);
  return text;
}

}  // namespace regulus::detail
