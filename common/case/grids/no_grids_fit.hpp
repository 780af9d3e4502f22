#pragma once
/// A case whose grids do not fit: what is wrong, and what else its file could say.

#include <string>
#include <utility>
#include <vector>

#include "common/core/failure.hpp"

namespace fsi {

/// Another thing that a case file could say.
struct OtherChoice {
  std::string words;                                              ///< "write `radius: 0.1`"
  std::vector<std::pair<std::string, std::string>> written = {};  ///< dotted keys and their values
  std::vector<std::string> left_out = {};                         ///< dotted keys
};

/// The user's mistake, to which `load_case` adds a remedy: the first choice with which the case is valid.
class NoGridsFit : public UserMistake {
 public:
  struct Parts {
    std::string place = {}, key = {};  ///< as for config::fail
    std::string cause = {};            ///< what is wrong
    std::string otherwise = {};        ///< what to do where no choice is valid
    std::string owner = {};            ///< section of the grids: "fluid", "fluids.left", "solids.disk"
    std::vector<OtherChoice> choices =
        {};  ///< to be tried before those that there are for all grids of the owner
  };
  explicit NoGridsFit(Parts parts);

  const Parts& parts() const { return parts_; }

 private:
  Parts parts_;
};

}  // namespace fsi
