// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/picture/pictures.hpp"

#include <system_error>
#include <utility>

#include "codegen/answer/picture/picture.hpp"
#include "codegen/answer/picture/text_map.hpp"
#include "codegen/support/errors.hpp"

namespace regulus::detail {
namespace {

/// Does a step with a file; its error becomes one of ours.
template <class Step>
auto with_file(const std::string& name, Step step) {
  try {
    return step();
  } catch (const std::system_error& error) {
    throw FileError(name + " cannot " + error.what());
  }
}

}  // namespace

Pictures::Pictures(const PictureRequest& request, const PavingOptions& paving,
                   const PreparedSearch& preparation)
    : Pictures(request, paving, preparation, regulus::name, "") {}

Pictures::Pictures(const PictureRequest& request, const PavingOptions& paving,
                   const PreparedSearch& preparation, WordOfClaim word, std::string subject)

    : preparation_(preparation),
      options_(resolve_pictures(request, paving, preparation)),
      map_columns_(request.map_columns) {
  options_.word = word;
  options_.subject = std::move(subject);
  for (const std::string& file : request.files) open(file);
  if (!grids_.empty()) boxes_.emplace(preparation, options_);
  const std::size_t ranges = paving.axes.size();
  if (map_columns_ > 0 && (ranges == 1 || ranges == 2)) map_.emplace(preparation, options_);
  if (drawings_.empty()) return;
  if (options_.slices.empty()) canvases_.emplace_back(preparation, options_);
  for (const Slice& slice : options_.slices) canvases_.emplace_back(preparation, options_, slice);
}

void Pictures::open(const std::string& file) {
  if (is_grid_file(file))
    grids_.push_back({file, with_file(file, [&] { return AtomicFile(file); })});
  else
    drawings_.push_back({file, std::make_unique<Gnuplot>(file)});
}

std::vector<Observer*> Pictures::observers() {
  std::vector<Observer*> observers;
  for (Canvas& canvas : canvases_) observers.push_back(&canvas);
  if (boxes_) observers.push_back(&*boxes_);
  if (map_) observers.push_back(&*map_);
  return observers;
}

void Pictures::draw(const Volumes& volumes) {
  for (Drawing& drawing : drawings_)
    drawing.gnuplot->draw(
        picture_commands(drawing.file, preparation_, options_, volumes, canvases_),
        picture_title(preparation_, options_));
  const std::string text = boxes_ ? boxes_->text() : "";
  for (GridFile& grid : grids_)
    with_file(grid.name, [&] {
      grid.file.write(text);
      grid.file.put_in_place();
    });
}

std::string Pictures::map() const {
  return map_ ? text_map(preparation_, options_, *map_, map_columns_) : "";
}

}  // namespace regulus::detail
