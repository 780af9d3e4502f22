/// fsi_credentials RUN ROLE DIR: writes the credentials of one participant into files, for programs that do
/// not use common/bus. The key of the run comes from the environment's AMP_FSI_KEY.

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>

#include "common/bus/peers/credentials.hpp"
#include "common/core/failure.hpp"

namespace {

using namespace fsi;

/// Only its user may read it.
void write_file(const std::string& path, const std::string& text) {
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW, 0600);
  const bool written = file >= 0 && fchmod(file, 0600) == 0 &&
                       write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  const bool closed = file < 0 || close(file) == 0;
  if (!written || !closed) throw OutputFailed("cannot write " + path);
}

int write_credentials(const std::string& run, const std::string& role, const std::string& folder) {
  const char* text = std::getenv("AMP_FSI_KEY");  // NOLINT(concurrency-mt-unsafe): no other thread
  const bus::RunKey key = bus::parse_key(text == nullptr ? "" : text);
  if (key.protection == bus::Protection::off)
    throw Failure(ExitCode::user_mistake,
                  "AMP_FSI_KEY is not set: the run is not protected, or this is not its user");
  const bus::Credentials own = bus::make_credentials(key, run, role);
  for (const auto& [name, content] :
       {std::pair{"authority.pem", own.authority}, std::pair{"certificate.pem", own.certificate},
        std::pair{"private_key.pem", own.private_key}, std::pair{"governance.p7s", own.governance},
        std::pair{"permissions.p7s", own.permissions}})
    write_file(folder + "/" + name, content);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    fmt::print(stderr, "usage: fsi_credentials RUN ROLE DIR, with the run's key in AMP_FSI_KEY\n");
    return static_cast<int>(ExitCode::user_mistake);
  }
  try {
    return write_credentials(argv[1], argv[2], argv[3]);
  } catch (const Failure& failure) {
    fmt::print(stderr, "fsi_credentials: {}\n", failure.what());
    return static_cast<int>(failure.code());
  }
}
