#pragma once

#include <string>

#include "control.pb.h"
#include "values/air_reading.hpp"
#include "values/command.hpp"
#include "values/status.hpp"

namespace pelagos {

[[nodiscard]] proto::v1::Status to_message(const ServerStatus& status, std::size_t stations);
[[nodiscard]] proto::v1::ServerMessage to_message(const Event& event);
void fill(const ScheduledCommand& from, proto::v1::ScheduledCommand& to);
[[nodiscard]] proto::v1::WindReading to_message(const AirReading& reading);
[[nodiscard]] proto::v1::SurfaceAnswer to_message(const SurfaceAnswer& answer);
[[nodiscard]] proto::v1::ServerMessage error_message(std::uint64_t id, proto::v1::Error::Code code, std::string text,
                                                     const std::string& field = "");

/// A message as it goes over the wire: 4 bytes of length, big-endian, then the message.
[[nodiscard]] std::string frame_message(const google::protobuf::MessageLite& message);

/// Text from elsewhere made fit for one line of a log or an answer: control characters replaced, at most max_length.
[[nodiscard]] std::string printable(const std::string& text, std::size_t max_length = 200);

}  // namespace pelagos
