#pragma once
/// Numbers that break on one rank break on all: the others would go on, and wait for it.

#include <optional>

#include "common/core/failure.hpp"
#include "common/ranks/ranks.hpp"

namespace fsi {

/// What ranks do each on its part, up to where they agree that it went well.
class Together {
 public:
  explicit Together(Ranks& ranks) : ranks_(&ranks) {}

  /// Does it. On several ranks numbers that break are kept for `agree`, and nothing more is done until then.
  template <class Action>
  void attempt(const Action& action) {
    if (ranks_->alone()) return action();
    if (failure_) return;
    try {
      action();
    } catch (const Diverged& failure) {
      failure_ = failure;
    }
  }
  /// All ranks come here. @throws Diverged on all of them, as it was thrown on the first rank where it was
  void agree();

 private:
  Ranks* ranks_;
  std::optional<Diverged> failure_;
};

}  // namespace fsi
