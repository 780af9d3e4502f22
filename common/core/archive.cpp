#include "common/core/archive.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "common/core/failure.hpp"

namespace fsi {

const std::vector<double>& Archive::take(const std::string& name) {
  const auto found = entries_.find(prefix_ + name);
  if (found == entries_.end())
    throw UserMistake(
        fmt::format("the checkpoint does not know '{}{}': it is of another program", prefix_, name));
  ++loaded_;
  return found->second;
}

void Archive::values(const std::string& name, std::span<double> values) {
  if (!loading_) {
    if (!entries_.try_emplace(prefix_ + name, values.begin(), values.end()).second)
      throw std::logic_error(fmt::format("two parts of a checkpoint are called '{}{}'", prefix_, name));
    return;
  }
  const std::vector<double>& saved = take(name);
  if (saved.size() != values.size()) {
    throw UserMistake(
        fmt::format("the checkpoint holds {} numbers of '{}{}', this run needs {}: it is of another case",
                    saved.size(), prefix_, name, values.size()));
  }
  std::ranges::copy(saved, values.begin());
}

void Archive::list(const std::string& name, std::vector<double>& list) {
  if (loading_) {
    list = take(name);
  } else {
    values(name, list);
  }
}

void Archive::check_all_loaded() const {
  if (loaded_ == entries_.size()) return;
  throw UserMistake(
      fmt::format("the checkpoint holds {} parts, this program knows {}: it is of another program",
                  entries_.size(), loaded_));
}

}  // namespace fsi
