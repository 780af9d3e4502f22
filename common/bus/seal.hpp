#pragma once
/// Who may ask a run for something: requests carry a seal that only those can make who know the key of the
/// run, which the launcher keeps where nobody but its user reads it.
///
///     seal = HMAC-SHA-256(key, "RUN.size:RUN,FROM.size:FROM,COMMAND.size:COMMAND,NUMBER")
///
/// The lengths keep two requests from having one text. A sender numbers its requests, and a number counts
/// once, so a request that somebody overheard is worth nothing.

#include <cstdint>
#include <map>
#include <set>
#include <string>

#include "common/wire/messages.hpp"

namespace fsi::bus {

/// The seal of a request, in hexadecimal digits.
std::string seal_of(const wire::Control& request, const std::string& key);

/// Makes the requests of one sender.
class Sealer {
 public:
  /// Takes a name for itself that no other sender has.
  Sealer(std::string run, std::string key);
  wire::Control request(const std::string& command);

 private:
  std::string run_, key_, from_;
  std::uint64_t number_ = 0;
};

/// Tells the requests of a run from those of strangers.
class Gatekeeper {
 public:
  /// Without a key no request is let in.
  Gatekeeper(std::string run, std::string key);
  /// Is the request for this run, sealed with its key, and new? If not, the log says so, once per sender.
  bool lets_in(const wire::Control& request);

 private:
  std::string run_, key_;
  std::map<std::string, std::uint64_t> latest_;  ///< number of the last request of each sender let in
  std::set<std::string> strangers_;              ///< those the log has named

  bool refuse(const wire::Control& request, const std::string& why);
};

}  // namespace fsi::bus
