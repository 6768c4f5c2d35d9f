#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "packing/particle_codec.hpp"
#include "pelagos.h"
#include "schedule/schedule.hpp"
#include "values/body.hpp"
#include "values/body_load.hpp"
#include "values/command.hpp"
#include "values/scene_info.hpp"
#include "values/slick.hpp"
#include "values/snapshot.hpp"
#include "values/status.hpp"
#include "values/surface_query.hpp"
#include "values/viewer_status.hpp"
#include "values/wind.hpp"
#include "wire/sample_fault.hpp"

// Values <-> generated types: the one place where world frames and body axes of the wire meet those of the server
// (ENU; body x forward, y port, z up). Implementation files only.
//
// A ..Sample holds a generated struct whose strings and sequences point into the sample's own storage or into the value
// that it was made from, which must outlive it. Never freed by the DDS library.

namespace pelagos::wire {

[[nodiscard]] pelagos_BodyStateV1 to_wire(const BodyState& state, pelagos_WorldFrame frame);
[[nodiscard]] BodyState from_wire(const pelagos_BodyStateV1& state);

/// It lends the reading's name, which must outlive it.
[[nodiscard]] pelagos_ProbeV1 to_wire(const ProbeReading& reading, const Snapshot& snapshot, std::uint64_t source,
                                      pelagos_WorldFrame frame);
[[nodiscard]] ProbeReading from_wire(const pelagos_ProbeV1& reading);
/// Of a reading that has air.
[[nodiscard]] pelagos_AirV1 air_to_wire(const ProbeReading& reading, const Snapshot& snapshot, std::uint64_t source,
                                        pelagos_WorldFrame frame);

/// Of a request that is not one to remove. World or body axes, as pelagos_ProbeRequestV1 says.
[[nodiscard]] ProbeSettings from_wire(const pelagos_ProbeRequestV1& request);
[[nodiscard]] pelagos_ProbeRequestV1 to_wire(const ProbeSettings& probe, std::uint32_t sender,
                                             pelagos_WorldFrame frame);

/// Places and answers are in the query's frame on the wire, in ENU as values.
class SurfaceQuerySample {
 public:
  SurfaceQuerySample(const SurfaceQuery& query, std::uint32_t client, std::uint64_t number, pelagos_WorldFrame frame);
  [[nodiscard]] const pelagos_SurfaceQueryV1& get() const { return sample_; }

 private:
  std::vector<pelagos_PlaceV1> places_;
  pelagos_SurfaceQueryV1 sample_{};
};

/// A query as it came, with what its answer must repeat.
struct ReceivedSurfaceQuery {
  std::uint32_t client = 0;
  std::uint64_t number = 0;
  pelagos_WorldFrame frame = pelagos_FRAME_ENU;
  SurfaceQuery query;
  std::string fault;  ///< the first, by the fields of the sample; empty: none
};
[[nodiscard]] ReceivedSurfaceQuery from_wire(const pelagos_SurfaceQueryV1& query);

class SurfaceAnswerSample {
 public:
  SurfaceAnswerSample(const SurfaceNews& news, const ReceivedSurfaceQuery& to, std::uint64_t source);
  [[nodiscard]] const pelagos_SurfaceAnswerV1& get() const { return sample_; }

 private:
  std::vector<pelagos_SurfaceAtPlaceV1> places_;
  pelagos_SurfaceAnswerV1 sample_{};
};
/// Does not validate: see find_fault.
[[nodiscard]] SurfaceNews from_wire(const pelagos_SurfaceAnswerV1& answer);

/// The load of a frame; `frame` says which body axes it is written in.
[[nodiscard]] pelagos_BodyLoadV1 to_wire(const BodyLoad& load, const Snapshot& snapshot, std::uint64_t source,
                                         pelagos_WorldFrame frame);
[[nodiscard]] BodyLoad from_wire(const pelagos_BodyLoadV1& load);

[[nodiscard]] pelagos_PoseV1 to_wire(const BodyPose& pose, std::uint32_t sender, pelagos_WorldFrame frame);
/// Does not validate: see PoseReceiver. An angular rate or velocity that is not finite stays so.
[[nodiscard]] BodyPose from_wire(const pelagos_PoseV1& pose);
[[nodiscard]] GeodeticPose from_wire(const pelagos_GeodeticPoseV1& pose);

[[nodiscard]] pelagos_ScheduleV1 to_wire(const SchedulePiece& piece, std::uint64_t source);
/// Does not validate: see find_fault.
[[nodiscard]] SchedulePiece from_wire(const pelagos_ScheduleV1& schedule);
[[nodiscard]] pelagos_ViewerStatusV1 to_wire(const ViewerStatus& status);
/// Does not validate: see find_fault.
[[nodiscard]] ViewerStatus from_wire(const pelagos_ViewerStatusV1& status);

[[nodiscard]] pelagos_WindSettingsV1 to_wire(const std::optional<WindSettings>& wind);
[[nodiscard]] WindSettings from_wire(const pelagos_WindSettingsV1& wind);

[[nodiscard]] pelagos_EventV1 to_wire(const Event& event, std::uint64_t source);
[[nodiscard]] Event from_wire(const pelagos_EventV1& event);

class SceneInfoSample {
 public:
  SceneInfoSample(const SceneInfo& info, std::uint64_t source);
  [[nodiscard]] const pelagos_SceneInfoV1& get() const { return sample_; }

 private:
  std::vector<pelagos_WaveComponentV1> waves_;
  std::vector<pelagos_BodyInfoV1> bodies_;
  pelagos_SceneInfoV1 sample_{};
};
[[nodiscard]] SceneInfo from_wire(const pelagos_SceneInfoV1& info);

class SeaSample {
 public:
  SeaSample(const WaveField& sea, std::uint64_t source);
  [[nodiscard]] const pelagos_SeaV1& get() const { return sample_; }

 private:
  std::vector<std::vector<pelagos_WaveComponentV1>> waves_;
  std::vector<pelagos_SeaLayerV1> layers_;
  pelagos_SeaV1 sample_{};
};
/// Does not validate: see find_fault.
[[nodiscard]] WaveField from_wire(const pelagos_SeaV1& sea);

class BodyShapeSample {
 public:
  BodyShapeSample(const BodySurface& surface, std::uint32_t body, std::uint64_t source);
  [[nodiscard]] const pelagos_BodyShapeV1& get() const { return sample_; }

 private:
  std::vector<float> vertices_;
  std::vector<std::uint32_t> corners_;
  pelagos_BodyShapeV1 sample_{};
};
/// Does not validate: see find_fault.
[[nodiscard]] BodySurface from_wire(const pelagos_BodyShapeV1& shape);

/// Lends the strings of `status`, which must outlive the sample.
class StatusSample {
 public:
  StatusSample(const ServerStatus& status, std::uint64_t source, pelagos_WorldFrame bodies_frame);
  [[nodiscard]] const pelagos_StatusV2& get() const { return sample_; }

 private:
  std::vector<pelagos_BodyStateV1> bodies_;
  pelagos_StatusV2 sample_{};
};
[[nodiscard]] ServerStatus from_wire(const pelagos_StatusV2& status);

/// Reused from frame to frame, so that its buffers are.
class OceanFrameSample {
 public:
  /// Packs. Returns the particles that were refused.
  std::uint32_t fill(const Snapshot& snapshot, double particle_spacing, std::uint64_t source,
                     pelagos_WorldFrame bodies_frame);
  [[nodiscard]] const pelagos_OceanFrameV1& get() const { return sample_; }

 private:
  std::vector<std::uint8_t> payload_;
  std::vector<pelagos_BodyStateV1> bodies_;
  pelagos_OceanFrameV1 sample_{};
};

/// The oil of a frame; it lends the strings of `oil`, which must outlive the sample.
class OilSample {
 public:
  OilSample(const Snapshot& snapshot, const OilSnapshot& oil, std::uint64_t source);
  [[nodiscard]] const pelagos_SlickV1& slick() const { return slick_; }
  [[nodiscard]] const pelagos_OilBudgetV1& budget() const { return budget_; }

 private:
  std::vector<pelagos_SlickElementV1> elements_;
  std::vector<pelagos_SkimmerV1> skimmers_;
  pelagos_SlickV1 slick_{};
  pelagos_OilBudgetV1 budget_{};
};

/// An element of a slick; its place stays relative to SlickV1.origin. Does not validate.
[[nodiscard]] SlickDisc from_wire(const pelagos_SlickElementV1& element);

[[nodiscard]] PackingScales scales_of(const pelagos_OceanFrameV1& frame);

[[nodiscard]] inline Eigen::Vector3d from_wire(const pelagos_Vector3& v) { return {v.x, v.y, v.z}; }
[[nodiscard]] inline pelagos_Vector3 to_wire(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace pelagos::wire
