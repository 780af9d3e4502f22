/// Preloaded into mpirun, which listens for mpiruns of other machines on every network and cannot be told otherwise: all
/// that listens there by TCP is on the loopback interface.

#include <dlfcn.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <cerrno>
#include <cstring>

namespace {

using Bind = int(int, const sockaddr*, socklen_t) noexcept;

bool is_tcp(int socket) {
  int type = 0;
  socklen_t size = sizeof type;
  return getsockopt(socket, SOL_SOCKET, SO_TYPE, &type, &size) == 0 && type == SOCK_STREAM;
}

}  // namespace

extern "C" int bind(int socket, const sockaddr* address, socklen_t size) noexcept {
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): that is what dlsym gives
  const auto next = reinterpret_cast<Bind*>(dlsym(RTLD_NEXT, "bind"));
  if (next == nullptr) {
    errno = ENOSYS;
    return -1;
  }
  sockaddr_storage here{};
  if (address == nullptr || size > sizeof here || !is_tcp(socket)) return next(socket, address, size);
  std::memcpy(&here, address, size);
  // NOLINTBEGIN(cppcoreguidelines-pro-type-reinterpret-cast): addresses are so
  if (here.ss_family == AF_INET)
    reinterpret_cast<sockaddr_in*>(&here)->sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  else if (here.ss_family == AF_INET6)
    reinterpret_cast<sockaddr_in6*>(&here)->sin6_addr = in6addr_loopback;
  return next(socket, reinterpret_cast<const sockaddr*>(&here), size);
  // NOLINTEND(cppcoreguidelines-pro-type-reinterpret-cast)
}
