#include <algorithm>
#include <cstring>

#include "pelagos_dds/frames.hpp"
#include "wire/convert.hpp"

namespace pelagos::wire {

namespace {

/// ENU to the frame, or back.
Eigen::Vector3d turned(const Eigen::Vector3d& v, pelagos_WorldFrame frame) {
  return frame == pelagos_FRAME_NED ? swap_enu_ned(v) : v;
}
Eigen::Vector2d turned(const Eigen::Vector2d& v, pelagos_WorldFrame frame) {
  return frame == pelagos_FRAME_NED ? Eigen::Vector2d(v.y(), v.x()) : v;
}

pelagos_Vector3f narrow(const Eigen::Vector3d& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}
Eigen::Vector3d widen(const pelagos_Vector3f& v) { return Eigen::Vector3f(v.x, v.y, v.z).cast<double>(); }

pelagos_SurfaceSource to_wire(SurfaceSource source) {
  switch (source) {
    case SurfaceSource::kParticles:
      return pelagos_SURFACE_PARTICLES;
    case SurfaceSource::kBlended:
      return pelagos_SURFACE_BLENDED;
    case SurfaceSource::kWaveField:
      return pelagos_SURFACE_WAVE_FIELD;
    case SurfaceSource::kNoWater:
      break;
  }
  return pelagos_SURFACE_NO_WATER;
}

SurfaceSource from_wire(pelagos_SurfaceSource source) {
  switch (source) {
    case pelagos_SURFACE_PARTICLES:
      return SurfaceSource::kParticles;
    case pelagos_SURFACE_BLENDED:
      return SurfaceSource::kBlended;
    case pelagos_SURFACE_WAVE_FIELD:
      return SurfaceSource::kWaveField;
    default:
      return SurfaceSource::kNoWater;
  }
}

template <class Sequence, class Item>
void lend(Sequence& sequence, std::vector<Item>& items) {
  sequence._length = sequence._maximum = static_cast<std::uint32_t>(items.size());
  sequence._buffer = items.data();
}

}  // namespace

SurfaceQuerySample::SurfaceQuerySample(const SurfaceQuery& query, std::uint32_t client, std::uint64_t number,
                                       pelagos_WorldFrame frame) {
  for (const Eigen::Vector2d& place : query.places) {
    const Eigen::Vector2d at = turned(place, frame);
    places_.push_back({at.x(), at.y()});
  }
  sample_.client = client;
  sample_.query = number;
  sample_.frame = frame;
  sample_.ahead = query.ahead;
  lend(sample_.places, places_);
}

ReceivedSurfaceQuery from_wire(const pelagos_SurfaceQueryV1& wire) {
  ReceivedSurfaceQuery received;
  received.client = wire.client;
  received.number = wire.query;
  if (wire.frame == pelagos_FRAME_NED) received.frame = pelagos_FRAME_NED;
  received.query.ahead = wire.ahead;
  for (std::uint32_t k = 0; k < wire.places._length; ++k)
    received.query.places.emplace_back(wire.places._buffer[k].x, wire.places._buffer[k].y);
  if (const auto fault = find_fault(received.query)) received.fault = to_string(*fault);  // as the sender has x and y
  for (Eigen::Vector2d& place : received.query.places) place = turned(place, received.frame);
  return received;
}

SurfaceAnswerSample::SurfaceAnswerSample(const SurfaceNews& news, const ReceivedSurfaceQuery& to,
                                         std::uint64_t source) {
  sample_.source = source;
  sample_.client = to.client;
  sample_.query = to.number;
  sample_.frame = to.frame;
  sample_.ahead = to.query.ahead;
  sample_.simulation_time = news.answer.simulation_time;
  std::memcpy(sample_.fault, news.refusal.data(), std::min(news.refusal.size(), sizeof(sample_.fault) - 1));
  if (!news.refusal.empty()) return;
  for (std::size_t k = 0; k < news.answer.places.size(); ++k) {
    const SurfaceAtPlace& at = news.answer.places[k];
    const Eigen::Vector2d& place = to.query.places[k];
    const Eigen::Vector3d surface(place.x(), place.y(), at.height);
    places_.push_back({to_wire(at.source), wire::to_wire(turned(surface, to.frame)),
                       narrow(turned(at.normal, to.frame)), narrow(turned(at.velocity, to.frame))});
  }
  lend(sample_.places, places_);
}

SurfaceNews from_wire(const pelagos_SurfaceAnswerV1& wire) {
  SurfaceNews news;
  news.answer.simulation_time = wire.simulation_time;
  news.refusal = wire.fault;
  for (std::uint32_t k = 0; k < wire.places._length; ++k) {
    const pelagos_SurfaceAtPlaceV1& at = wire.places._buffer[k];
    news.answer.places.push_back({from_wire(at.source), turned(wire::from_wire(at.surface), wire.frame).z(),
                                  turned(widen(at.normal), wire.frame), turned(widen(at.velocity), wire.frame)});
  }
  return news;
}

}  // namespace pelagos::wire
