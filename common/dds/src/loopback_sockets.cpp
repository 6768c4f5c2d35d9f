#include "loopback_sockets.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace pelagos {
namespace {

thread_local SocketWatch* present_watch = nullptr;

int call_kernel(int socket, const void* address, unsigned size) {
  return static_cast<int>(::syscall(SYS_bind, socket, address, size));
}

bool is_datagram(int socket) {
  int type = 0;
  socklen_t size = sizeof type;
  return ::getsockopt(socket, SOL_SOCKET, SO_TYPE, &type, &size) == 0 && type == SOCK_DGRAM;
}

/// A socket for multicast must keep the address; it is tied to the device instead.
bool receives_multicast(int socket) {
  int reuse = 0;
  socklen_t size = sizeof reuse;
  return ::getsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &reuse, &size) == 0 && reuse != 0;
}

bool tie_to_loopback_device(int socket) {
  constexpr char kDevice[] = "lo";
  return ::setsockopt(socket, SOL_SOCKET, SO_BINDTODEVICE, kDevice, sizeof kDevice) == 0;
}

struct Host {
  bool any = false, loopback = false;
  std::string text;
};

Host host_of(const void* address, unsigned size) {
  Host host;
  char text[INET6_ADDRSTRLEN] = {};
  sockaddr_in v4{};
  sockaddr_in6 v6{};
  sa_family_t family = AF_UNSPEC;
  if (size >= sizeof family) std::memcpy(&family, address, sizeof family);
  if (family == AF_INET && size >= sizeof v4) {
    std::memcpy(&v4, address, sizeof v4);
    host.any = v4.sin_addr.s_addr == htonl(INADDR_ANY);
    host.loopback = (ntohl(v4.sin_addr.s_addr) >> 24) == 127;
    ::inet_ntop(AF_INET, &v4.sin_addr, text, sizeof text);
  } else if (family == AF_INET6 && size >= sizeof v6) {
    std::memcpy(&v6, address, sizeof v6);
    host.any = IN6_IS_ADDR_UNSPECIFIED(&v6.sin6_addr) != 0;
    host.loopback = IN6_IS_ADDR_LOOPBACK(&v6.sin6_addr) != 0;
    ::inet_ntop(AF_INET6, &v6.sin6_addr, text, sizeof text);
  }
  host.text = text;
  return host;
}

/// The same address and port, of loopback.
int bind_to_loopback(int socket, const void* address, unsigned size) {
  sa_family_t family = AF_UNSPEC;
  std::memcpy(&family, address, sizeof family);
  if (family == AF_INET6) {
    sockaddr_in6 v6{};
    std::memcpy(&v6, address, sizeof v6);
    v6.sin6_addr = in6addr_loopback;
    return call_kernel(socket, &v6, size);
  }
  sockaddr_in v4{};
  std::memcpy(&v4, address, sizeof v4);
  v4.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  return call_kernel(socket, &v4, size);
}

}  // namespace

SocketWatch::SocketWatch(bool keep_to_loopback) : keep_to_loopback_(keep_to_loopback) { present_watch = this; }
SocketWatch::~SocketWatch() { present_watch = nullptr; }

int bind_socket(int socket, const void* address, unsigned size) {
  SocketWatch* const watch = present_watch;
  if (watch == nullptr || address == nullptr || !is_datagram(socket)) return call_kernel(socket, address, size);
  const Host host = host_of(address, size);
  if (!host.any) {
    auto& known = watch->interfaces_;
    if (!host.loopback && !host.text.empty() && std::find(known.begin(), known.end(), host.text) == known.end())
      known.push_back(host.text);
    return call_kernel(socket, address, size);
  }
  if (!watch->keep_to_loopback_) {
    watch->everywhere_ = true;
    return call_kernel(socket, address, size);
  }
  if (!receives_multicast(socket)) return bind_to_loopback(socket, address, size);
  watch->everywhere_ = watch->everywhere_ || !tie_to_loopback_device(socket);
  return call_kernel(socket, address, size);
}

}  // namespace pelagos

/// In place of the C library's, for the whole process: the dynamic linker gives the DDS library this one. Without a
/// watch it is the system's call and nothing else.
extern "C" __attribute__((visibility("default"))) int bind(int socket, const sockaddr* address,
                                                           socklen_t size) noexcept {
  return pelagos::bind_socket(socket, address, size);
}
