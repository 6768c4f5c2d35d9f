#pragma once

#include <string>
#include <vector>

namespace pelagos {

/// Sockets that the DDS library has bound on this thread while this lives.
///
/// Cyclone DDS binds the sockets that it receives with to every address of the machine, whatever interface its
/// configuration names (eclipse-cyclonedds issue 2090), so a configuration of loopback alone still listens to the
/// network. While a `SocketWatch` with `keep_to_loopback` lives, such a socket is bound to 127.0.0.1 instead.
/// One at a time on a thread.
class SocketWatch {
 public:
  explicit SocketWatch(bool keep_to_loopback);
  ~SocketWatch();
  SocketWatch(const SocketWatch&) = delete;
  SocketWatch& operator=(const SocketWatch&) = delete;

  /// Whether a socket was bound to every address, and is so.
  [[nodiscard]] bool listens_everywhere() const { return everywhere_; }
  /// Addresses of its interfaces beside loopback, as the library bound its sending sockets to them; each once.
  [[nodiscard]] const std::vector<std::string>& interfaces() const { return interfaces_; }

 private:
  friend int bind_socket(int, const void*, unsigned);
  bool keep_to_loopback_;
  bool everywhere_ = false;
  std::vector<std::string> interfaces_;
};

}  // namespace pelagos
