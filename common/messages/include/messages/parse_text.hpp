#pragma once

#include <string_view>

#include "messages/field_reader.hpp"

namespace pelagos {

/// What a text says beside the message that it was read into.
struct ParsedText {
  google::protobuf::TextFormat::ParseInfoTree locations;  ///< the place of each field
  bool readable = true;                                   ///< false: a syntax or type error, the only entry of faults
  TextRefusals faults;                                    ///< otherwise the unknown fields
};

/// Parses Protobuf text format into `message`. Fields that its schema does not know are skipped and noted, all of them.
/// Unlike in Protobuf, numbers with zeros in front are decimal (010 is ten), a byte order mark is skipped, and
/// characters that only look right are refused where they stand.
void parse_text(std::string_view text, google::protobuf::Message& message, ParsedText& out);

}  // namespace pelagos
