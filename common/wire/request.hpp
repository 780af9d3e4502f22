#pragma once
/// What may be asked of a run from outside, with the one table of its words.

#include <array>
#include <string_view>

#include "common/core/choices.hpp"

namespace fsi {

enum class Request {
  pause,
  resume,
  checkpoint,  ///< of the step that is next
  stop         ///< a checkpoint, then a graceful end
};

template <>
inline constexpr std::array names_of<Request>{
    Named<Request>{Request::pause, "pause"},
    Named<Request>{Request::resume, "resume"},
    Named<Request>{Request::checkpoint, "checkpoint"},
    Named<Request>{Request::stop, "stop"},
};

/// A solver's own word, before its name, when it was asked to end.
inline constexpr std::string_view terminate_word = "terminate ";

}  // namespace fsi
