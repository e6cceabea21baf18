// SPDX-License-Identifier: GPL-3.0-or-later
// All pictures of one paving. Their files are opened and gnuplot is started before the search, so
// that errors are reported at once.
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "codegen/answer/picture/box_grid.hpp"
#include "codegen/answer/picture/canvas.hpp"
#include "codegen/answer/picture/gnuplot.hpp"
#include "runtime/files/atomic_file.hpp"
#include "runtime/search/paving.hpp"

namespace regulus::detail {

class Pictures {
 public:
  /// Throws UsageError for options that no picture can have, and FileError for a file that cannot
  /// be written.
  Pictures(const PictureRequest& request, const PavingOptions& paving,
           const PreparedSearch& preparation);
  /// The same for claims about something else, a load: `subject` is for the title.
  Pictures(const PictureRequest& request, const PavingOptions& paving,
           const PreparedSearch& preparation, WordOfClaim word, std::string subject);

  /// Returns what must see each box.
  [[nodiscard]] std::vector<Observer*> observers();
  /// Throws FileError if a picture cannot be written.
  void draw(const Volumes& volumes);
  /// Returns the map in text, if it is wanted and there are one or two ranges.
  [[nodiscard]] std::string map() const;

 private:
  struct Drawing {
    std::string file;
    std::unique_ptr<Gnuplot> gnuplot;
  };
  struct GridFile {
    std::string name;
    AtomicFile file;
  };
  void open(const std::string& file);

  const PreparedSearch& preparation_;
  PictureOptions options_;
  std::vector<Drawing> drawings_;
  std::vector<GridFile> grids_;
  std::deque<Canvas> canvases_;
  std::optional<BoxGrid> boxes_;
  std::optional<Canvas> map_;
  std::size_t map_columns_;
};

}  // namespace regulus::detail
