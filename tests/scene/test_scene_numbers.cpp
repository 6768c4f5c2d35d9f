// No number of a scene may be NaN or infinite: every field of the schema is tried, those to come as well.

#include <gmock/gmock.h>
#include <google/protobuf/text_format.h>

#include <functional>
#include <limits>

#include "scene.pb.h"
#include "scene_text.hpp"

namespace pelagos {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using testing::HasSubstr;

/// Visits every number of a message and of those below it; `path` names it. Of the cases of a oneof, which replace each
/// other, only the one that leads to `wanted` is entered where that is given.
void visit_numbers(Message& message, const std::string& path, const std::string& wanted,
                   const std::function<void(Message&, const FieldDescriptor&, const std::string&)>& visit) {
  const auto& descriptor = *message.GetDescriptor();
  const auto& reflection = *message.GetReflection();
  for (int k = 0; k < descriptor.field_count(); ++k) {
    const FieldDescriptor& field = *descriptor.field(k);
    const std::string here = path + "." + field.name();
    if (field.cpp_type() == FieldDescriptor::CPPTYPE_DOUBLE) visit(message, field, here);
    if (field.cpp_type() != FieldDescriptor::CPPTYPE_MESSAGE) continue;
    const bool replaces = field.real_containing_oneof() != nullptr;
    if (replaces && !wanted.empty() && wanted.rfind(here + ".", 0) != 0) continue;
    if (field.is_repeated()) {
      Message& entry = reflection.FieldSize(message, &field) > 0
                           ? *reflection.MutableRepeatedMessage(&message, &field, 0)
                           : *reflection.AddMessage(&message, &field);
      visit_numbers(entry, here, wanted, visit);
    } else {
      visit_numbers(*reflection.MutableMessage(&message, &field), here, wanted, visit);
    }
  }
}

std::string report_with(const std::string& wanted, double value) {
  proto::v1::Scene message;
  EXPECT_TRUE(google::protobuf::TextFormat::ParseFromString(test::kValid, &message));
  visit_numbers(message, "scene", wanted, [&](Message& owner, const FieldDescriptor& field, const std::string& path) {
    if (path == wanted) owner.GetReflection()->SetDouble(&owner, &field, value);
  });
  for (proto::v1::Wind* wind :
       {message.mutable_wind(), wanted == "scene.event.set_wind.wind.from_deg"
                                    ? message.mutable_event(0)->mutable_set_wind()->mutable_wind()
                                    : message.mutable_wind()}) {
    if (wanted.find("wind.from_deg") == std::string::npos) continue;
    wind->clear_velocity();  // it has a direction already
    wind->set_speed(1.0);
  }
  return read_scene_message(message.SerializeAsString(), "station").report();
}

TEST(SceneNumbers, NoneMayBeNanOrInfinite) {
  std::vector<std::string> paths;
  proto::v1::Scene all;
  visit_numbers(all, "scene", "", [&](Message&, const FieldDescriptor&, const std::string& path) {
    if (path.find(".set_effort.") == std::string::npos) paths.push_back(path);  // in no scene at all
  });
  ASSERT_GT(paths.size(), 50U);  // 60 or so; were the walk broken, there would be a handful
  for (const std::string& path : paths) {
    const std::string name = path.substr(path.rfind('.') + 1);
    EXPECT_THAT(report_with(path, std::numeric_limits<double>::quiet_NaN()), HasSubstr(name + ": nan")) << path;
    EXPECT_THAT(report_with(path, std::numeric_limits<double>::infinity()), HasSubstr(name + ": inf")) << path;
  }
}

TEST(SceneNumbers, HexadecimalOnesAreRefusedByField) {
  const std::string report =
      read_scene_text("particle_spacing: 0.1\npatch { min { x: -0X10 y: -3 } }\n", "a.scene").report();
  EXPECT_THAT(report, HasSubstr("a.scene:2:19: patch.min.x: is 0X10 (hexadecimal); allowed: a decimal number"));
}

}  // namespace
}  // namespace pelagos
