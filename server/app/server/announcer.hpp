#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "pelagos_dds/log_sink.hpp"
#include "values/command.hpp"

namespace pelagos {

class ControlServer;
class FramePublisher;

/// Tells what happens: to the log, to stations that subscribed and over DDS, under one number. On the thread that
/// advances the world.
class Announcer {
 public:
  /// Both must outlive it.
  Announcer(ControlServer& control, FramePublisher& publisher) : control_(control), publisher_(publisher) {}

  /// Where the run is: events carry it.
  void set_moment(std::uint64_t step, double time) {
    step_ = step;
    time_ = time;
  }
  /// @param source  who caused it  @param text  one line for people
  void announce(const std::string& kind, const std::string& source, const std::string& text);
  [[nodiscard]] std::uint64_t count() const { return events_; }  ///< of events so far

 private:
  void log(const Event& event);

  ControlServer& control_;
  FramePublisher& publisher_;
  std::map<std::string, RateLimitedLog> logs_;  ///< by kind: a flood of one does not hide another
  std::uint64_t events_ = 0, step_ = 0;
  double time_ = 0.0;
};

}  // namespace pelagos
