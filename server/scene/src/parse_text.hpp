#pragma once

#include <string_view>

#include "messages/field_reader.hpp"
#include "scene.pb.h"

namespace pelagos {

/// A scene's text as a message, with the place of each field.
struct ParsedText {
  proto::v1::Scene message;
  google::protobuf::TextFormat::ParseInfoTree locations;
  bool readable = true;  ///< false: a syntax or type error, the only entry of faults
  FieldFaults faults;    ///< otherwise the unknown fields
};

/// Parses Protobuf text format. Fields that the schema does not know are skipped and noted, all of them.
void parse_scene_text(std::string_view text, ParsedText& out);

}  // namespace pelagos
