#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "pelagos.h"
#include "text/refusal.hpp"

// What a viewer takes from strangers: every number in it is bounded, so that no sample can make it crash, hang or fill
// the memory. docs/wire.md, "What is refused", lists the limits. Implementation files only.

namespace pelagos::wire {

/// Limits of what a viewer takes, each far beyond what a server sends.
inline constexpr std::uint32_t kMostBodies = 64;      ///< of a scene, and of a frame
inline constexpr std::uint32_t kMostSeaWaves = 4096;  ///< of the far sea, all layers together
inline constexpr std::uint32_t kMostParticles = 4'000'000;
inline constexpr std::uint32_t kMostSlickElements = 200'000;
inline constexpr std::size_t kLongestName = 256;      ///< bytes: of scene, build and body
inline constexpr std::size_t kLongestMeshFile = 260;  ///< bytes: "y-up:" and the longest name that a file can have

/// Why a sample is refused: the first fault in it, e.g. {"bodies[3].mesh_scale", "is -1; allowed: above 0 and at most
/// 1e6"}. Nothing if a viewer can compute with everything in the sample, and the payload holds `count` whole records.
[[nodiscard]] std::optional<Refusal> find_fault(const pelagos_OceanFrameV1& frame);
[[nodiscard]] std::optional<Refusal> find_fault(const pelagos_ScheduleV1& schedule);
[[nodiscard]] std::optional<Refusal> find_fault(const pelagos_ClockAnswerV1& answer);
[[nodiscard]] std::optional<Refusal> find_fault(const pelagos_ViewerStatusV1& status);
[[nodiscard]] std::optional<Refusal> find_fault(const pelagos_SceneInfoV1& info);
[[nodiscard]] std::optional<Refusal> find_fault(const pelagos_SeaV1& sea);
[[nodiscard]] std::optional<Refusal> find_fault(const pelagos_BodyShapeV1& shape);
[[nodiscard]] std::optional<Refusal> find_fault(const pelagos_StatusV2& status);
[[nodiscard]] std::optional<Refusal> find_fault(const pelagos_WindV1& wind);
[[nodiscard]] std::optional<Refusal> find_fault(const pelagos_SlickV1& slick);
[[nodiscard]] std::optional<Refusal> find_fault(const pelagos_SurfaceAnswerV1& answer);
/// Texts of events are cut, not refused: what they tell must not be lost.
[[nodiscard]] std::optional<Refusal> find_fault(const pelagos_EventV1& event);

}  // namespace pelagos::wire
