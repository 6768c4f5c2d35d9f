#pragma once

#include "pelagos_dds/entities.hpp"

// The table of topics: idl/pelagos.idl explains each. Implementation files only.

namespace pelagos::topics {

[[nodiscard]] TopicSpec ocean_frame();
[[nodiscard]] TopicSpec schedule();
[[nodiscard]] TopicSpec scene_info();
[[nodiscard]] TopicSpec sea();
[[nodiscard]] TopicSpec body_shape();
[[nodiscard]] TopicSpec status();
[[nodiscard]] TopicSpec wind();
[[nodiscard]] TopicSpec slick();
[[nodiscard]] TopicSpec oil_budget();
[[nodiscard]] TopicSpec body_load();
[[nodiscard]] TopicSpec probe();
[[nodiscard]] TopicSpec air();
[[nodiscard]] TopicSpec probe_request();
[[nodiscard]] TopicSpec surface_query();
[[nodiscard]] TopicSpec surface_answer();
[[nodiscard]] TopicSpec clock_request();
[[nodiscard]] TopicSpec clock_answer();
[[nodiscard]] TopicSpec viewer_status();
[[nodiscard]] TopicSpec event();
[[nodiscard]] TopicSpec own_ship_pose();
[[nodiscard]] TopicSpec body_pose();
[[nodiscard]] TopicSpec geodetic_pose();

}  // namespace pelagos::topics
