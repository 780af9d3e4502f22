#include "common/grid/watch.hpp"

#include <utility>

namespace fsi::grid {

Watch::Watch(std::vector<WatchedQuantity> quantities, std::vector<std::string> grids)
    : quantities_(std::move(quantities)), grids_(std::move(grids)) {
  for (const WatchedQuantity& quantity : quantities_)
    components_.insert(components_.end(), quantity.components.begin(), quantity.components.end());
}

const std::string& Watch::component_of(const Finding& found) const {
  return components_[static_cast<std::size_t>(found.component)];
}

const std::string& Watch::grid_of(const Finding& found) const {
  return grids_[static_cast<std::size_t>(found.grid)];
}

void Watch::keep(const Finding& found) {
  if (!(found.size > now_.size)) return;
  now_ = found;
  if (now_.size > worst_.size) worst_ = now_;
}

void Watch::archive_findings(Archive& archive) {
  for (auto& [name, found] : {std::pair<const char*, Finding&>("now", now_), {"worst", worst_}}) {
    archive.inside(name, [&archive, &found = found] {
      archive.number("size", found.size);
      archive.number("component", found.component);
      archive.number("grid", found.grid);
      archive.number("i", found.i);
      archive.number("j", found.j);
      archive.values("place", {found.place.data(), 2});
      archive.number("t", found.t);
    });
  }
}

}  // namespace fsi::grid
