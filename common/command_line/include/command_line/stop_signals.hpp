#pragma once

#include <csignal>

namespace pelagos {

/// Has `handler` called for each signal that asks a program to end: SIGINT, SIGTERM, and SIGHUP of a terminal that is
/// closed. A signal that the program was started to ignore (nohup) stays ignored.
inline void on_stop_signals(void (*handler)(int)) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP})
    if (std::signal(signal, handler) == SIG_IGN && signal == SIGHUP) std::signal(signal, SIG_IGN);
}

}  // namespace pelagos
